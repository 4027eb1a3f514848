#pragma once

#include <array>
#include <initializer_list>
#include <span>

#include "behaviour/floor_plan.h"
#include "geometry/point.h"
#include "geometry/pose.h"
#include "world/command.h"

namespace mrose {

/// The way of a robot to where it can push the ball, in numbers that do not change where field and robot are moved,
/// turned or mirrored: what the time that it takes is learned from. It is mirrored so that the ball is to be passed on
/// its left.
struct WayToBall {
    struct Situation {
        Pose robot;
        Velocity velocity;  ///< own, m/s and rad/s
        Point ball, rolls;  ///< where it is, m, and how it rolls, m/s
        Point onwards;      ///< length 1: the way that it is to be pushed
        double behind = 0;  ///< m, from the ball to where the robot pushes it from
        bool cornered = false;
        const FloorPlan* walls = nullptr;  ///< none: there are no walls
        double ballRadius = 0.11;
        double stuck = 0;               ///< s, for how long the robot has hardly moved, or backs off
        std::span<const Point> bodies;  ///< others on the floor
    };
    /// Walls and bodies beyond are of no interest, m; so long it is stuck at most, s.
    static constexpr double farRoom = 0.6, lane = 0.7, farOther = 2, longStuck = 2;

    double distance = 0;  ///< m, to the ball
    double round = 0;     ///< rad, 0 to pi: how far it must go round the ball
    double bearing = 0;   ///< rad, of the ball from its heading; positive on the side to which it goes round
    double bearingCosine = 1;
    double speed = 0, turning = 0;         ///< m/s, rad/s, positive to the same side as the bearing
    double rollsAway = 0, rollsAside = 0;  ///< m/s: of the ball along the line of sight, and across, likewise
    double rest = 0;                       ///< m, to where the ball comes to rest, or to a wall
    double room = farRoom;                 ///< m, from the ball's centre to the nearest wall
    double cornered = 0;                   ///< 1: walls let it go no way
    double blocked = 0;                    ///< m: by how much bodies reach into the lane to the ball, at most 2
    double crowded = 0;                    ///< m: likewise into the place behind the ball
    double other = farOther;               ///< m, from the ball to the nearest body
    double stuck = 0;                      ///< s

    WayToBall() = default;
    explicit WayToBall(const Situation& situation);

    static constexpr std::size_t count = 15;
    std::array<double, count> numbers() const {
        return {distance, round, bearing,  bearingCosine, speed,   turning, rollsAway, rollsAside,
                rest,     room,  cornered, blocked,       crowded, other,   stuck};
    }
};
static_assert(sizeof(WayToBall) == WayToBall::count * 8, "without padding");

/// What its numbers are called, in their order: the inputs of a network of the time.
inline constexpr std::initializer_list<const char*> wayToBallNames{
    "distance", "round", "bearing",  "bearing_cosine", "speed",   "turning", "rolls_away", "rolls_aside",
    "rest",     "room",  "cornered", "blocked",        "crowded", "other",   "stuck"};

}  // namespace mrose
