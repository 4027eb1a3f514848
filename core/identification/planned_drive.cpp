#include "identification/planned_drive.h"

#include <algorithm>
#include <cmath>

#include "geometry/elementary.h"
#include "world/noise.h"

namespace mrose {

Command commandAt(const DrivePiece& manoeuvre, double time) {
    switch (manoeuvre.kind) {
        case DrivePiece::Kind::ramp: {
            const double share = std::min(1.0, time / manoeuvre.duration);
            return {manoeuvre.from.v + share * (manoeuvre.to.v - manoeuvre.from.v),
                    manoeuvre.from.w + share * (manoeuvre.to.w - manoeuvre.from.w)};
        }
        case DrivePiece::Kind::toAndFro:
            return static_cast<std::int64_t>(time / manoeuvre.swing + 1e-6) % 2 == 0 ? manoeuvre.to : manoeuvre.from;
        case DrivePiece::Kind::hold:
            break;
    }
    return manoeuvre.to;
}

namespace {

/// As people write it: to thousandths.
double shortNumber(double number) { return std::trunc(1000 * number) / 1000; }

/// Robots drive forward more than backward, and turn gently more than hard.
Command drawnCommand(const CommandLimits& limits, const NoiseKey& key) {
    const UniformDraws draws(key);
    const bool backward = limits.leastV < 0 && draws[0] < 0.25;
    const double v = shortNumber(draws[1] * (backward ? limits.leastV : limits.mostV));
    const double w = limits.mostW * (2 * draws[2] - 1);
    if (draws[3] < 0.08) return {};
    if (draws[3] < 0.2) return {v, 0};
    if (draws[3] < 0.28) return {0, shortNumber(w)};
    return {v, shortNumber(w * draws[4])};
}

}  // namespace

DrivePiece drawnManoeuvre(const CommandLimits& limits, const Command& before, std::uint64_t seed, std::int64_t number) {
    const UniformDraws draws({seed, number, 0, 0});
    DrivePiece manoeuvre;
    manoeuvre.duration = std::floor(4 * power(7.5, draws[0]) + 0.5) / 10;  // 0.4 to 3 s
    manoeuvre.to = drawnCommand(limits, {seed, number, 1, 0});
    manoeuvre.from = drawnCommand(limits, {seed, number, 2, 0});
    if (draws[1] < 0.6) return manoeuvre;
    if (draws[1] < 0.85) {
        manoeuvre.kind = DrivePiece::Kind::ramp;
        manoeuvre.from = before;
        return manoeuvre;
    }
    manoeuvre.kind = DrivePiece::Kind::toAndFro;
    manoeuvre.swing = std::floor(2 + 5 * draws[0]) / 10;  // 0.2 to 0.6 s
    manoeuvre.duration = 4 * manoeuvre.swing;
    return manoeuvre;
}

void PlannedDrive::step() {
    MotionInput input = now_.input();
    input.memory = memory_;
    MotionStep step;
    const int robot = -1;
    motion_->predict({&input, 1}, {&robot, 1}, {&step, 1});
    pose_ = pose_ * step.increment;
    now_.velocity = step.velocity;
    now_.start += motion_->network().period;
}

double disagreement(const LearnedMotion& motion, const MotionInput& input) {
    const std::size_t count = motion.memberCount();
    if (count < 2) return 0;
    MotionStep mean;
    std::vector<MotionStep> members(count);
    const int robot = -1;
    motion.predictMembers({&input, 1}, {&robot, 1}, {&mean, 1}, members);
    const std::vector<NetworkOutput>& outputs = motion.network().outputs;
    double sum = 0;
    for (const MotionStep& member : members) {
        const double x = (member.increment.x - mean.increment.x) / outputs[0].scale,
                     y = (member.increment.y - mean.increment.y) / outputs[1].scale,
                     heading = (member.increment.heading - mean.increment.heading) / outputs[2].scale;
        sum += x * x + y * y + heading * heading;
    }
    return std::sqrt(sum / double(count - 1));
}

}  // namespace mrose
