#pragma once

#include <optional>
#include <vector>

#include "geometry/point.h"

namespace mrose {

/// Where a disc is at which time: on straight ways at constant speed from point to point, before the first and after
/// the last one at rest.
struct TimedPath {
    struct Instant {
        Point place;
        double time = 0;  ///< s
    };
    std::vector<Instant> instants;  ///< one at least, in order of time

    Point at(double time) const;
    double arrival() const { return instants.back().time; }
};

/// How a robot drives a path: it turns on the spot at corners.
struct DriveTimes {
    double heading = 0;   ///< rad, at the start
    double speed = 0.4;   ///< m/s
    double rotation = 1;  ///< rad/s
    double begin = 0;     ///< s
};

/// A stop on the way.
struct Hold {
    double at = 0;        ///< m, along the path
    double duration = 0;  ///< s
};

/// A path of straight ways through points (one at least) in time.
TimedPath timedPath(const std::vector<Point>& points, const DriveTimes& drive, const Hold& hold = {});

/// Two discs on their paths come too near to each other.
struct Conflict {
    double begin = 0, end = 0;  ///< s; infinite: they stay so
    Point mine, other;          ///< where they are when it begins
};
/// The first time that they are nearer than `separation` (m, between their centres) while they approach each other.
/// Exact. Who parts from another one is in no conflict with it.
std::optional<Conflict> firstConflict(const TimedPath& mine, const TimedPath& other, double separation);

/// How near two discs come on their paths: m, between their centres. Exact.
double leastDistance(const TimedPath& one, const TimedPath& other);

}  // namespace mrose
