#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "motion/driving_reader.h"
#include "motion/learned_model.h"

namespace mrose {

/// What a robot may be commanded: forward speeds from least to most, m/s, and rotation rates up to mostW either way,
/// rad/s.
struct CommandLimits {
    double leastV = 0, mostV = 0, mostW = 0;
    bool operator==(const CommandLimits&) const = default;
};

/// A piece of a drive.
struct DrivePiece {
    enum class Kind {
        hold,     ///< `to`, in one step
        ramp,     ///< evenly from what was commanded before to `to`
        toAndFro  ///< between `to` and `from`, a step each `swing`
    };
    Kind kind = Kind::hold;
    double duration = 0;  ///< s
    Command to, from;     ///< `from`: of Kind::toAndFro, and of ramps where they begin
    double swing = 0;     ///< s
};
Command commandAt(const DrivePiece& manoeuvre, double time);

/// One of all manoeuvres within limits, by a number: speeds and turns evenly over the limits, standing, straight, on
/// the spot and in arcs, for 0.4 to 3 s.
DrivePiece drawnManoeuvre(const CommandLimits& limits, const Command& before, std::uint64_t seed, std::int64_t number);

/// What a network predicts of a robot period by period, by commands issued at the periods' starts.
class PlannedDrive {
public:
    explicit PlannedDrive(const LearnedMotion& motion) : motion_(&motion) {}

    struct Period {
        MotionInput input() const { return {&commands, start, velocity, {}, {}}; }
        CommandHistory commands;
        Nanoseconds start = 0;
        Velocity velocity;  ///< at the start
    };
    /// Drives it; `each` sees the periods before they are predicted, as a network does that remembers nothing of them.
    template <class Each>
    void drive(const DrivePiece& manoeuvre, Each each) {
        const double period = toSeconds(motion_->network().period);
        const int periods = std::max(1, static_cast<int>(std::lround(manoeuvre.duration / period)));
        for (int i = 0; i < periods; ++i) {
            now_.commands.issue(now_.start, commandAt(manoeuvre, i * period));
            each(now_);
            step();
        }
    }

    const Pose& pose() const { return pose_; }  ///< from where it began, at rest
    double seconds() const { return toSeconds(now_.start); }
    Command command() const { return now_.commands.at(now_.start); }

private:
    void step();

    const LearnedMotion* motion_;
    Period now_;
    Pose pose_;
    alignas(LearnedMotion::Memory) std::array<std::byte, LearnedMotion::largestOfMean> memory_{};
};

/// How much the members disagree on a period's increment: the root of the summed squares of the spreads forward, left
/// and in heading, each over the scale of the network's output. 0 where they are not known.
double disagreement(const LearnedMotion& motion, const MotionInput& input);

}  // namespace mrose
