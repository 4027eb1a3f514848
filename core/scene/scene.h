#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/tracker_offset.h"
#include "motion/motion_model.h"
#include "scene/environment.h"
#include "scene/floor_motion.h"
#include "scene/radio.h"
#include "scene/robot_type.h"

namespace mrose {

/// A kind of body that no controller moves.
struct ObjectType {
    std::string name;
    std::shared_ptr<const Shape> shape;
    double mass = 0.43;  ///< kg
    Surface surface{0.2, 0.6};
    bool rolls = true;           ///< a ball; otherwise it slides, like a box
    double inertia = 2.0 / 3.0;  ///< of a ball, over m r2: hollow 2/3, solid 2/5
    std::shared_ptr<const ObjectModel> motion = floorMotion();
};

/// One robot of a scene: constants and where it starts.
struct SceneRobot {
    std::string name;
    std::uint32_t type = 0;   ///< in Scene::robotTypes
    std::uint32_t model = 0;  ///< in Scene::models
    std::int64_t phase = 0;   ///< tick of its first control instant
    Pose start;
    Velocity velocity = {};        ///< at the start, as its model reads it
    TrackerEvidence tracked = {};  ///< what was seen of a real one before, beyond its model: MotionModel::adapt
    /// What a real one was sent before, at times up to 0, that of the start: MotionModel::recall.
    std::vector<StampedCommand> sent = {};
    /// Where others were left out: its place among all, by which people, colours and conditions know it.
    std::optional<std::uint32_t> place = {};
    std::string motionRobot = {};  ///< which of the robots of its networks it is; "": none of them
    std::string team = {};         ///< "": none
};

struct SceneObject {
    std::string name;
    std::uint32_t type = 0;  ///< in Scene::objectTypes
    Pose start;
    Twist velocity_W;  ///< at the start
};

/// Place, bodies and their motion: what is constant about them in a run. Bodies are numbered robots first, then
/// objects.
struct Scene {
    Nanoseconds tickLength = 20'000'000;
    /// Share by which restitution and friction vary at random from tick to tick, 0 ... 1: the paper's random factor.
    double randomFactor = 0;
    Radio radio;
    Environment environment;
    std::vector<RobotType> robotTypes;
    std::vector<std::shared_ptr<const MotionModel>> models;
    std::vector<SceneRobot> robots;
    std::vector<ObjectType> objectTypes;
    std::vector<SceneObject> objects;

    const RobotType& typeOf(std::size_t robot) const { return robotTypes[robots[robot].type]; }
    const ObjectType& typeOfObject(std::size_t object) const { return objectTypes[objects[object].type]; }
    const MotionModel& modelOf(std::size_t robot) const { return *models[robots[robot].model]; }
    std::int64_t periodTicks(std::size_t robot) const { return modelOf(robot).period() / tickLength; }
    std::size_t placeOf(std::size_t robot) const { return robots[robot].place.value_or(robot); }
    std::size_t bodyCount() const { return robots.size() + objects.size(); }
    const Shape& shapeOf(std::size_t body) const {
        return body < robots.size() ? *typeOf(body).shape : *typeOfObject(body - robots.size()).shape;
    }
    /// m, of the farthest point of any body from its reference point.
    double widestReach() const {
        double widest = 0;
        for (const RobotType& type : robotTypes) widest = std::max(widest, type.shape->reach);
        for (const ObjectType& type : objectTypes) widest = std::max(widest, type.shape->reach);
        return widest;
    }
    Nanoseconds timeOf(std::int64_t tick) const { return tick * tickLength; }
    /// The nearest number of ticks.
    std::int64_t ticksOf(Nanoseconds duration) const { return (duration + tickLength / 2) / tickLength; }
};

}  // namespace mrose
