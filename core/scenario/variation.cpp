#include "scenario/variation.h"

#include <optional>
#include <vector>

#include "behaviour/floor_plan.h"
#include "scenario/saved_state.h"
#include "scenario/start_check.h"
#include "world/noise.h"
#include "world/noise_channel.h"

namespace mrose {
namespace {

constexpr int mostDraws = 100;

/// Draws of one trial, each in its turn.
class Draws {
public:
    Draws(std::uint32_t trial, int attempt) : key_{0x6d726f7365, attempt, trial, 0} {}

    /// Uniform in +-`half`.
    double within(double half) {
        key_.channel = channelOf(NoiseChannel::trial, next_++);
        return half * (2 * uniformNoise(key_) - 1);
    }
    /// Other draws in the same turn.
    Draws again(int times) const {
        Draws others = *this;
        others.key_.tick += static_cast<std::int64_t>(times) * mostDraws;
        return others;
    }
    void passOver(int count) { next_ += static_cast<std::uint32_t>(count); }

private:
    NoiseKey key_;
    std::uint32_t next_ = 0;
};

/// Whether a wall bars the straight way: a body that is moved so begins on the wall's other side.
bool isBarred(const FloorPlan& walls, const Pose& from, const Pose& to) {
    const Point way = position(to) - position(from);
    const double far = length(way);
    return far > 0 && walls.freeWay(position(from), (1 / far) * way, 0, far) < far;
}

/// False: walls bar the way to wherever it was drawn.
bool move(Pose& pose, double position, double heading, const FloorPlan& walls, Draws& draws) {
    for (int times = 0; times < mostDraws; ++times) {
        Draws turn = draws.again(times);
        Pose moved = pose;
        moved.x += turn.within(position);
        moved.y += turn.within(position);
        moved.heading += turn.within(heading);
        if (isBarred(walls, pose, moved)) continue;
        pose = moved;
        draws.passOver(3);
        return true;
    }
    return false;
}

std::optional<Scene> moved(Scene scene, const Variation& variation, const FloorPlan& walls, Draws draws) {
    for (SceneRobot& robot : scene.robots)
        if (!move(robot.start, variation.robotPosition, variation.robotHeading, walls, draws)) return std::nullopt;
    for (SceneObject& object : scene.objects)
        if (!move(object.start, variation.objectPosition, 0, walls, draws)) return std::nullopt;
    const double friction = 1 + draws.within(variation.frictionShare);
    scene.environment.floor.slidingFriction *= friction;
    scene.environment.floor.rollingDeceleration *= friction;
    const double mass = 1 + draws.within(variation.massShare);
    for (ObjectType& type : scene.objectTypes) type.mass *= mass;
    return scene;
}

Value poseValue(const Pose& pose) {
    return Value::Table{{"x_m", pose.x}, {"y_m", pose.y}, {"heading_rad", pose.heading}};
}

/// What a trial draws, written into the value of the scenario that it was drawn from.
class Drawn {
public:
    explicit Drawn(const ScenarioValue& value) : value_(value) {}

    void set(const std::string& path, Value value) {
        if (!value_) return;
        auto changed = value_->with(path, std::move(value));
        value_ = std::move(changed);
    }
    std::string body(const std::string& name) const { return value_ ? value_->bodyPath(name) : ""; }
    Expected<ScenarioValue>& value() { return value_; }

private:
    Expected<ScenarioValue> value_;
};

/// The value with what differs between the parts that were made of it and those of a trial.
Expected<ScenarioValue> withParts(const ScenarioValue& value, const ScenarioParts& from, const ScenarioParts& to) {
    Drawn drawn(value);
    if (to.saved) {
        // Where bodies are in a saved state that state says.
        const Scenario scenario(to);
        const std::string name = value.name() + "#state";
        drawn.set("initial_state", std::make_shared<const DescriptionFile>(DescriptionFile{
                                       name, name, savedStateText(savedState(scenario, scenario.initialState()))}));
    } else {
        for (const SceneRobot& robot : to.scene.robots)
            drawn.set(drawn.body(robot.name) + ".start", poseValue(robot.start));
        for (const SceneObject& object : to.scene.objects)
            drawn.set(drawn.body(object.name) + ".start", poseValue(object.start));
    }
    const FloorSurface &floor = to.scene.environment.floor, &before = from.scene.environment.floor;
    if (floor.slidingFriction != before.slidingFriction)
        drawn.set("environment.floor.sliding_friction", floor.slidingFriction);
    if (floor.rollingDeceleration != before.rollingDeceleration)
        drawn.set("environment.floor.rolling_deceleration_mps2", floor.rollingDeceleration);
    for (std::size_t i = 0; i < to.scene.objects.size(); ++i)
        if (const double mass = to.scene.typeOfObject(i).mass; mass != from.scene.typeOfObject(i).mass)
            drawn.set(drawn.body(to.scene.objects[i].name) + ".mass_kg", mass);
    return std::move(drawn.value());
}

FloorPlan wallsOf(const Environment& environment) {
    std::vector<ConvexPiece> pieces;
    for (const Obstacle& obstacle : environment.obstacles)
        if (obstacle.wall) pieces.insert(pieces.end(), obstacle.shape.pieces.begin(), obstacle.shape.pieces.end());
    return FloorPlan(std::move(pieces));
}

}  // namespace

Expected<ScenarioParts> varied(const ScenarioParts& parts, std::uint32_t trial) {
    if (trial == 0) return parts;
    const FloorPlan walls = wallsOf(parts.scene.environment);
    // Bodies of a saved state may press on each other.
    const double tolerance = parts.saved ? 0.01 : 1e-4;
    for (int attempt = 0; attempt < mostDraws; ++attempt) {
        std::optional<Scene> scene = moved(parts.scene, parts.variation, walls, Draws(trial, attempt));
        if (!scene || findStartOverlap(*scene, tolerance)) continue;
        ScenarioParts result = parts;
        result.scene = std::move(*scene);
        return result;
    }
    return fail(parts.name,
                "in a hundred draws of trial " + std::to_string(trial) +
                    " bodies have overlapped or begun behind a wall; expected less variation, or more room");
}

Expected<LoadedScenario> varied(const LoadedScenario& loaded, std::uint32_t trial) {
    if (trial == 0) return loaded;
    auto parts = varied(loaded.parts, trial);
    if (!parts) return tl::unexpected(parts.error());
    auto value = withParts(loaded.value, loaded.parts, *parts);
    if (!value) return tl::unexpected(value.error());
    return LoadedScenario{std::move(*value), std::move(*parts)};
}

}  // namespace mrose
