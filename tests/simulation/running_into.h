#pragma once

#include <cmath>

#include "simulation/small_world.h"

namespace mrose {

/// The world a moment after a ball and a robot have met one of its pieces, wherever that is.
inline WorldState afterRunningInto(SmallWorld world, const ConvexPiece& piece, int ticks) {
    const Point edge =
        piece.isCircle() ? piece.centre + Point{piece.radius, 0} : 0.5 * (piece.corners[0] + piece.corners[1]);
    const Point out = piece.isCircle() ? Point{1, 0} : piece.normals[0];
    const Point ball = edge + 0.2 * out, robot = edge + 0.9 * out;
    world.object(ballType(), {ball.x, ball.y, 0}, {-2 * out.x, -2 * out.y, 0});
    world.robot(discRobot(), {robot.x, robot.y, std::atan2(-out.y, -out.x)},
                std::make_shared<const Told>(Command{1, 0}), ideal());
    const Scenario scenario = world.scenario();
    WorldState state = scenario.initialState();
    run(scenario, state, ticks);
    return state;
}

inline bool finite(const WorldState& state) {
    for (const RobotState& r : state.robots)
        if (!std::isfinite(r.pose.x + r.pose.y + r.pose.heading)) return false;
    for (const ObjectState& o : state.objects)
        if (!std::isfinite(o.pose.x + o.pose.y + o.pose.heading)) return false;
    return true;
}

}  // namespace mrose
