#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sensing/camera_network.h"
#include "sensing/perceiving.h"

namespace mrose {

inline constexpr Nanoseconds millisecond = 1'000'000;
inline constexpr ReadingName landmarksName = "camera.landmarks", robotsName = "camera.robots";

inline RobotType filming(const SensorPointer& camera, RobotType type = discRobot(0.17)) {
    type.sensors = {camera};
    return type;
}

inline Obstacle post(const std::string& landmark, const Point& place, double radius = 0.05) {
    ShapePart part;
    part.centre = place;
    part.radius = radius;
    return {"post", Shape::fromParts("post", {part}), {}, false, landmark};
}

inline Obstacle slab(const Point& least, const Point& most, bool wall) {
    ShapePart part;
    part.polygon = {least, {most.x, least.y}, most, {least.x, most.y}};
    return {"slab", Shape::fromParts("slab", {part}), {}, wall};
}

/// A robot at the origin that looks along x, others, and what stands.
inline SmallWorld filmed(const SensorPointer& camera, std::vector<Obstacle> obstacles,
                         const std::vector<Pose>& others = {}) {
    Environment environment;
    environment.obstacles = std::move(obstacles);
    SmallWorld world(std::move(environment));
    world.robot(filming(camera), {}, still(), ideal());
    for (const Pose& other : others) world.robot(discRobot(0.17), other, still(), ideal());
    return world;
}

struct CameraLook {
    Nanoseconds measured = 0;
    std::vector<SeenBody> landmarks, robots;
};

/// The looks that arrive at one observation.
inline std::vector<CameraLook> looksOf(const Observation& observation) {
    std::vector<CameraLook> looks;
    for (const Reading& reading : observation.readings()) {
        const auto seen = observation.records<SeenBody>(&reading);
        if (reading.name == landmarksName) looks.push_back({reading.measured, {seen.begin(), seen.end()}, {}});
        if (reading.name == robotsName) looks.back().robots.assign(seen.begin(), seen.end());
    }
    return looks;
}

/// All looks of a robot whose world stands still.
inline std::vector<CameraLook> looks(const Scenario& scenario, int count, std::uint64_t seed = 1) {
    std::vector<CameraLook> all;
    SensorWatch watch(scenario, seed);
    while (static_cast<int>(all.size()) < count)
        for (CameraLook& look : looksOf(watch.next())) all.push_back(std::move(look));
    return all;
}

}  // namespace mrose
