#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "planning/planner.h"
#include "planning/timed_path.h"

namespace mrose {

/// What one robot does about its path where it conflicts in time with those of others, to which it gives way.
enum class Repair { none, wait, temporaryTarget, imaginedObstacle, replan };
constexpr std::array<std::string_view, 5> repairNames{"none", "wait", "temporary_target", "imagined_obstacle",
                                                      "replan"};

/// A path through points, maybe with a stop on the way.
struct Plan {
    Path::Outcome outcome = Path::Outcome::noWay;
    std::vector<Point> points;  ///< from start to goal
    Hold hold;
    bool clear = true;  ///< of conflicts with the others

    bool found() const { return outcome == Path::Outcome::found; }
    TimedPath timed(const DriveTimes& drive) const { return timedPath(points, drive, hold); }
};

/// What is asked of a planner and a repair.
struct PlanRequest {
    const PathFinder& finder;
    Repair repair = Repair::wait;
    Point start, goal;
    DriveTimes drive;
    std::span<const TimedPath> others;  ///< to which it gives way
    double separation = 0.6;            ///< m, between its centre and theirs
};

/// A way by the planner. Where it conflicts with others':
/// - `wait`: it stops for the least time that lets them pass, as late on its path as that does;
/// - `temporaryTarget`: it goes to a place beside its path, stops there till they have passed, and goes on;
/// - `imaginedObstacle`: where the other is during the conflict is an obstacle, and the way is planned anew, up to four
/// times;
/// - `replan`: where the other is now is an obstacle, and the way is planned anew; who plans again and again gets round
/// it;
/// - `none`: nothing.
/// Where a repair finds nothing the path stays as it was, not clear.
Plan repairedPlan(const PlanRequest& request);

/// The first of its conflicts with any of the others.
std::optional<Conflict> firstConflict(const TimedPath& mine, std::span<const TimedPath> others, double separation,
                                      std::size_t* with = nullptr);

}  // namespace mrose
