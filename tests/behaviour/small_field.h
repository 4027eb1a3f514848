#pragma once

#include "behaviour/floor_plan.h"
#include "motion/noisy_model.h"
#include "simulation/small_world.h"
#include "world/noise.h"
#include "world/noise_channel.h"

namespace mrose {

constexpr int ticksPerSecond = 50;

/// A drive that answers 0.3 s late, then by a lag and within its acceleration.
inline std::shared_ptr<const MotionModel> lateDrive() {
    KinematicParameters parameters;
    parameters.v = {.deadTime = 0.3, .lag = 0.1, .limit = 0.5, .acceleration = 0.5};
    parameters.w = {.deadTime = 0.3, .lag = 0.1, .limit = 2, .acceleration = 5};
    return std::make_shared<const KinematicModel>(parameters);
}

/// The same with noise.
inline std::shared_ptr<const MotionModel> noisyDrive() { return withNoise(lateDrive(), {0.03, 0.03, 0.02}); }

/// Cameras that know the own pose to a decimetre, drifting, and see the half-plane's middle: all late, with drop-outs.
inline Perception cameras() {
    Perception perception;
    perception.self = {{0.08, 0.08, 0.05}, {0.05, 0.05, 0.03}, 1.5, 100'000'000, 0.05, 0.001, 0.5};
    BodySight sight;
    sight.bearingNoise = 0.0175;
    sight.rangeNoise = 0.03;
    sight.rangeNoiseSlope = 0.02;
    sight.bearingBias = 0.01;
    sight.fieldOfView = 1.5708;
    sight.latency = 100'000'000;
    sight.dropOut = 0.05;
    sight.occlusion = true;
    perception.objects = perception.robots = sight;
    perception.velocityNoise = 0.01;
    perception.rotationNoise = 0.02;
    return perception;
}

inline RobotType perceivingRobot(const Perception& perception) {
    RobotType type = discRobot(0.2);
    type.perception = perception;
    return type;
}

/// The outline of a Pioneer 1 with its ball guide, in octagon and horns.
inline RobotType guideRobot(const Perception& perception) {
    const auto part = [](Polygon polygon) {
        ShapePart result;
        result.polygon = std::move(polygon);
        return result;
    };
    RobotType type = discRobot(0.2, 7.5);
    type.name = "guide";
    type.shape = std::make_shared<const Shape>(
        Shape::fromParts("guide", {part({{0.17, -0.14},
                                         {0.17, 0.14},
                                         {0.1, 0.19},
                                         {-0.2, 0.19},
                                         {-0.28, 0.12},
                                         {-0.28, -0.12},
                                         {-0.2, -0.19},
                                         {0.1, -0.19}}),
                                   part({{0.15, 0.15}, {0.24, 0.17}, {0.24, 0.19}, {0.1, 0.19}}),
                                   part({{0.1, -0.19}, {0.24, -0.19}, {0.24, -0.17}, {0.15, -0.15}})}));
    type.perception = perception;
    return type;
}

/// A place's obstacles, for robots that know them.
inline std::shared_ptr<const FloorPlan> floorPlanOf(const Environment& environment) {
    std::vector<ConvexPiece> pieces;
    for (const Obstacle& obstacle : environment.obstacles)
        pieces.insert(pieces.end(), obstacle.shape.pieces.begin(), obstacle.shape.pieces.end());
    return std::make_shared<const FloorPlan>(std::move(pieces));
}

inline double draw(std::uint64_t seed, std::int64_t which, std::uint32_t part, double least, double most) {
    return least + (most - least) * uniformNoise({seed, which, part, channelOf(NoiseChannel::trial)});
}

/// A pose somewhere in a field of this size whose lower left corner is the origin, a metre from its walls.
inline Pose somewhere(std::uint64_t seed, std::int64_t which, double width, double height) {
    return {draw(seed, which, 0, 1, width - 1), draw(seed, which, 1, 1, height - 1), draw(seed, which, 2, -3.14, 3.14)};
}

}  // namespace mrose
