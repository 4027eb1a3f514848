#include "behaviour/steering.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/point.h"

namespace mrose {
namespace {

constexpr double approachGain = 0.8;    // 1/s
constexpr double alignWithin = 1;       // m
constexpr double clearance = 0.65;      // m, between reference points that pass each other
constexpr double nearlyStraight = 0.1;  // m: bodies up to so far on the right are passed on their left
constexpr double touching = 0.45;       // m
constexpr double evadeWithin = 1.5;     // m

/// Slower where the limit of rotation would not let it turn as it must.
Command limited(double v, double w, const DriveLimits& limits) {
    const double excess = std::max(1.0, std::abs(w) / std::max(1e-9, limits.rotation));
    return {std::clamp(v, -limits.speed, limits.speed) / excess, std::clamp(w, -limits.rotation, limits.rotation)};
}

}  // namespace

Command driveTowards(const Point& target_B, const DriveLimits& limits) {
    const double aside = direction(target_B);
    const double ahead = target_B.x > 0 ? target_B.x / length(target_B) : 0;
    return limited(limits.speed * ahead * ahead, turnGain * aside, limits);
}

Command driveToPose(const Pose& from, const Pose& goal, const DriveLimits& limits, bool backwards) {
    const double about = backwards ? std::numbers::pi : 0;
    const Point line = position(goal) - position(from);
    const double distance = length(line), sight = direction(line);
    // Goal's and own heading as seen along the line of sight: theta and delta of the paper.
    const double goalAngle = wrapAngle(goal.heading + about - sight), angle = wrapAngle(from.heading + about - sight);
    const double share = std::min(1.0, alignWithin / std::max(1e-6, distance));
    const double off = wrapAngle(angle + share * direction({1, goalAngle}));
    const double cosine = Placement({0, 0, off}).cosine, sine = Placement({0, 0, angle}).sine;
    const double v = std::min(limits.speed, approachGain * distance) * std::max(0.0, cosine);
    const double bend = distance > 1e-6 ? v / distance * (1 + share / (1 + goalAngle * goalAngle)) * sine : 0;
    const Command forward = limited(v, -turnGain * off - bend, limits);
    return {backwards ? -forward.v : forward.v, forward.w};
}

double clearHeading(double wanted, double far, const std::function<double(double)>& freeWay) {
    constexpr int steps = 9;
    constexpr double step = std::numbers::pi / 12, clearlyFarther = 0.01;
    double best = wanted, farthest = -1;
    for (int i = 0; i <= steps; ++i)
        for (const int side : {-1, 1}) {
            const double heading = wanted + side * i * step, way = freeWay(heading);
            if (way >= far) return heading;
            if (way <= farthest + clearlyFarther) continue;
            farthest = way;
            best = heading;
        }
    return best;
}

Evasion evade(std::span<const SeenBody> bodies, const MotionMemory& motion, double deadTime) {
    Evasion evasion;
    double nearest = evadeWithin;
    for (const SeenBody& body : bodies) {
        const Placement frame(motion.motionSince(body.measured) * motion.motionDuring(deadTime));
        const Point at = frame.placeBack(body.position_B);
        const double far = length(at);
        if (at.x <= 0 || std::abs(at.y) > clearance || far >= nearest) continue;
        nearest = far;
        const double bearing = direction(at);
        const double passing = direction({std::sqrt(std::max(0.0, far * far - clearance * clearance)), clearance});
        evasion.turn = at.y > -nearlyStraight ? bearing - passing : bearing + passing;
        evasion.share = std::clamp((far - touching) / touching, 0.2, 1.0);
    }
    return evasion;
}

Command evading(const Command& intended, const Evasion& evasion, const DriveLimits& limits) {
    if (intended.v <= 0 || evasion.turn == 0) return intended;
    const double turn = turnGain * evasion.turn;
    const double w = turn > 0 ? std::max(turn, intended.w) : std::min(turn, intended.w);
    return {intended.v * evasion.share, std::clamp(w, -limits.rotation, limits.rotation)};
}

}  // namespace mrose
