#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "sensing/perceiving.h"
#include "sensing/sensor_view.h"
#include "world/noise.h"
#include "world/state_bytes.h"
#include "world/state_hash.h"

namespace mrose {

/// What a ray meets, by solving for each part of each outline: independent of pieces, grids and fans.
struct RayHit {
    double range = std::numeric_limits<double>::infinity();
    double incidence = 0;                                 ///< cosine of the angle to the normal
    std::optional<std::size_t> obstacle = {}, body = {};  ///< whose outline, the first's of some that lie there
};

/// `from`, `along`: in the world; `robot` is not met.
inline RayHit solvedRay(const Scenario& scenario, const WorldState& state, std::size_t robot, const Point& from,
                        const Point& along) {
    RayHit hit, owner;
    const auto meet = [&](double range, const Point& normal) {
        const double facing = -dot(along, normal);
        if (!(range >= 0 && facing > 0 && range < hit.range)) return;
        if (range < hit.range - 1e-9) hit.obstacle = owner.obstacle, hit.body = owner.body;
        hit.range = range;
        hit.incidence = facing;
    };
    const auto meetShape = [&](const Shape& shape, const Pose& pose) {
        const Placement frame(pose);
        for (const ShapePart& part : shape.parts) {
            if (part.polygon.empty()) {
                const Point centre = frame.place(part.centre), to = centre - from;
                const double ahead = dot(to, along), root = part.radius * part.radius - dot(to, to) + ahead * ahead;
                if (root < 0) continue;
                const double range = ahead - std::sqrt(root);
                meet(range, (1 / part.radius) * (from + range * along - centre));
                continue;
            }
            for (std::size_t i = 0; i < part.polygon.size(); ++i) {
                const Point a = frame.place(part.polygon[i]),
                            b = frame.place(part.polygon[(i + 1) % part.polygon.size()]);
                const Point edge = b - a;
                const double across = cross(along, edge);
                if (across == 0) continue;
                const double share = cross(a - from, along) / across;
                if (share < 0 || share > 1) continue;
                meet(cross(a - from, edge) / across, (1 / length(edge)) * Point{edge.y, -edge.x});
            }
        }
    };
    const std::vector<Obstacle>& obstacles = scenario.scene().environment.obstacles;
    for (std::size_t i = 0; i < obstacles.size(); ++i) {
        owner.obstacle = i;
        meetShape(obstacles[i].shape, {});
    }
    owner.obstacle.reset();
    for (std::size_t body = 0; body < scenario.scene().bodyCount(); ++body) {
        owner.body = body;
        if (body != robot) meetShape(scenario.scene().shapeOf(body), poseOf(state, body));
    }
    return hit;
}

/// Robots, boxes and balls that do not overlap, anywhere in a walled field of `width` by `width` m; the first robot has
/// the sensor.
inline Scenario randomScene(const SensorPointer& sensor, std::uint32_t seed, std::uint32_t bodies, double width) {
    SmallWorld world(walledField(width, width));
    std::vector<Point> places;
    std::uint32_t draw = 0;
    const auto uniform = [&] { return uniformNoise({seed, 0, 0, draw++}); };
    const auto place = [&](double reach) {
        while (true) {
            const Point spot{reach + (width - 2 * reach) * uniform(), reach + (width - 2 * reach) * uniform()};
            bool free = true;
            for (const Point& other : places) free = free && distance(spot, other) > 0.8;
            if (!free) continue;
            places.push_back(spot);
            return Pose{spot.x, spot.y, 7 * uniform() - 3.5};
        }
    };
    RobotType type = squareRobot(0.45);
    type.sensors = {sensor};
    world.robot(type, place(0.4), still(), ideal());
    for (std::uint32_t i = 1; i < bodies; ++i) {
        const double kind = uniform();
        if (kind < 0.4)
            world.robot(squareRobot(0.2 + 0.3 * uniform()), place(0.4), still(), ideal());
        else if (kind < 0.7)
            world.robot(discRobot(0.1 + 0.2 * uniform()), place(0.4), still(), ideal());
        else if (kind < 0.85)
            world.object(ballType(), place(0.4));
        else
            world.object(boxType(0.2 + 0.3 * uniform()), place(0.4));
    }
    return world.scenario();
}

/// The readings of a robot's sensors, at the state's control instant.
template <class Record>
std::vector<Record> recordsNow(const Scenario& scenario, WorldState& state, const ReadingName& name,
                               std::size_t robot = 0) {
    Observation out;
    perceive(scenario, state, robot, out);
    const auto records = out.records<Record>(out.newest(name));
    return {records.begin(), records.end()};
}

/// A robot with a sensor at the origin, facing along x, and what else there is.
inline SmallWorld sensing(const SensorPointer& sensor, Environment environment = {}, const Pose& start = {}) {
    RobotType type = discRobot(0.2);
    type.sensors = {sensor};
    SmallWorld world(std::move(environment));
    world.robot(type, start, still(), ideal());
    return world;
}

/// A box with one side on x = `near`, `height` m high about y = `middle`.
inline Environment wallAhead(double near, double height = 20, double middle = 0) {
    ShapePart part;
    part.polygon = {{near, middle - height / 2},
                    {near + 0.2, middle - height / 2},
                    {near + 0.2, middle + height / 2},
                    {near, middle + height / 2}};
    Environment environment;
    environment.obstacles.push_back({"wall", Shape::fromParts("wall", {part}), {}});
    return environment;
}

/// From every tick a saved state goes on to the same state and the same observations.
inline void expectSameFromEveryTick(const Scenario& scenario, int ticks) {
    WorldState state = scenario.initialState();
    StepBuffers buffers, others;
    StepTrace trace, again;
    for (int k = 0; k < ticks; ++k) {
        auto restored = parseState(stateBytes(state), "saved");
        ASSERT_TRUE(restored);
        step(scenario, state, buffers, {}, &trace);
        step(scenario, *restored, others, {}, &again);
        ASSERT_EQ(hashOf(state), hashOf(*restored)) << k;
        for (std::size_t i = 0; i < state.robots.size(); ++i) {
            if (!trace.robots[i].observed) continue;
            ASSERT_EQ(trace.robots[i].observation, again.robots[i].observation) << k;
        }
    }
}

}  // namespace mrose
