#include "behaviour/back_off.h"

#include <algorithm>
#include <cmath>

#include "behaviour/dice.h"

namespace mrose {
namespace {

constexpr double patience = 0.8;      // s
constexpr double hardly = 0.25;       // share of what it is commanded
constexpr double leastEffort = 0.05;  // m/s
constexpr Nanoseconds soon = 6 * nanosecondsPerSecond;
constexpr std::int64_t mostFarther = 4;
constexpr double turningRadius = 0.2;  // m, turns rotation rates into speeds

double speedOf(double v, double w) { return std::abs(v) + turningRadius * std::abs(w); }

}  // namespace

void BackOff::begin(const Observation& observation, const Command& commanded, const Options& options) {
    Dice dice(observation.noise);
    hardlyMoving = 0;
    ++times;
    inSuccession = times > 1 && observation.time - until < soon ? std::min(inSuccession + 1, mostFarther) : 0;
    const double rotation = std::max(1e-3, 0.7 * options.rotation);
    v = std::copysign(0.6 * options.speed, -commanded.v);
    w = dice.between(-1, 1) < 0 ? -rotation : rotation;
    turnAt = observation.time + fromSeconds(dice.between(0.8, 1.6) * (1 + 0.5 * static_cast<double>(inSuccession)));
    until = turnAt + fromSeconds(dice.between(0.5, 1.5) * options.turn / rotation);
}

std::optional<Command> BackOff::update(const Observation& observation, const MotionMemory& motion,
                                       const Options& options) {
    const Command commanded = motion.commandAt(observation.time - fromSeconds(options.deadTime));
    const double effort = speedOf(commanded.v, commanded.w);
    const bool moves = speedOf(observation.velocity().v, observation.velocity().w) >= hardly * effort;
    const double since = toSeconds(motion.sinceLast());
    hardlyMoving = moves || effort < leastEffort ? std::max(0.0, hardlyMoving - 2 * since) : hardlyMoving + since;
    if (hardlyMoving >= patience) begin(observation, commanded, options);
    if (observation.time >= until) return std::nullopt;
    return observation.time < turnAt ? Command{v, 0} : Command{0, w};
}

}  // namespace mrose
