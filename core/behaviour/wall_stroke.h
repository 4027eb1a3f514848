#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "behaviour/floor_plan.h"
#include "geometry/pose.h"
#include "world/command.h"
#include "world/time.h"

namespace mrose {

/// How a robot with a ball guide gets a ball off the wall that it lies at (Buck, Beetz, Schmitt 2002): approach, stop
/// before it, turn fast towards the field's centre, so that the horn at the wall strikes it. Part of a controller's
/// memory; all zero it is not at it.
struct WallStroke {
    struct Options {
        // Of the robot and the ball.
        double reach = 0.31;       ///< m, from the reference point to the outermost point: room to turn on the spot
        double ballRadius = 0.11;  ///< m
        double speed = 0.4;        ///< m/s, of the approach
        double rotation = 1.484;   ///< rad/s, likewise
        double within = 0.1;       ///< m, between wall and ball: it lies there
        // Where it stops: seen along the wall, with the ball ahead.
        double standOff = 0.335;      ///< m, from the wall to the reference point
        double stopDistance = 0.388;  ///< m, from there along the wall to the ball's centre
        double approach = 0.876;      ///< rad, how far it heads into the wall
        double tolerance = 0.1;       ///< m, beside that place
        // The stroke.
        double lead = 0.541;            ///< s, forward before it turns ...
        double leadSpeed = 0.194;       ///< m/s, so fast
        double turnSpeed = 0.237;       ///< m/s, forward while it turns
        double strokeRotation = 1.745;  ///< rad/s
        double turn = 2.822;            ///< rad, how far
        double follow = 0.774;          ///< s, forward afterwards, at `speed`
    };
    /// What it goes by: poses and places in the world's frame, when the command takes effect.
    struct Situation {
        Nanoseconds time;
        Pose robot;
        Point ball;     ///< believed to lie still
        Point towards;  ///< where the ball should rather go
        const FloorPlan& walls;
    };

    std::int64_t phase;
    double side;           ///< 1: it turns to the left, the wall being on its right; -1: the other way round
    Point away;            ///< from the wall, length 1
    Point lies;            ///< where the ball lies, smoothed
    double closer;         ///< m, than the stop distance, where there is no room
    double heading;        ///< rad, at the stroke's begin
    Nanoseconds until;     ///< of the phase, where it has an end by time
    std::int64_t strokes;  ///< how many there were

    /// What to do, or nullopt: the ball lies at no wall, or where it cannot be reached so.
    std::optional<Command> update(const Situation& seen, const Options& options);
    /// It is under way and must not be disturbed: the robot turns, or goes after the ball.
    bool strikes() const;
    void stop() { phase = 0; }
    std::string_view doing() const;
    /// Where it stops before the ball.
    Pose stance(const Point& ball, const Options& options) const;

private:
    bool choose(const Situation& now, const Options& options);
    Command approach(const Situation& now, const Options& options);
    std::optional<Command> align(const Pose& goal, const Situation& now, const Options& options);
    std::optional<Command> strike(const Situation& now, const Options& options);
    void begin(std::int64_t next, const Situation& now, double seconds);
};
static_assert(sizeof(WallStroke) == 10 * 8, "without padding");

}  // namespace mrose
