#include "experiment/variation.h"

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

private:
    NoiseKey key_;
    std::uint32_t next_ = 0;
};

void move(Pose& pose, double position, double heading, Draws& draws) {
    pose.x += draws.within(position);
    pose.y += draws.within(position);
    pose.heading += draws.within(heading);
}

Scene moved(Scene scene, const Variation& variation, Draws draws) {
    for (SceneRobot& robot : scene.robots) move(robot.start, variation.robotPosition, variation.robotHeading, draws);
    for (SceneObject& object : scene.objects) move(object.start, variation.objectPosition, 0, draws);
    const double friction = 1 + draws.within(variation.frictionShare);
    scene.environment.floor.slidingFriction *= friction;
    scene.environment.floor.rollingDeceleration *= friction;
    const double mass = 1 + draws.within(variation.massShare);
    for (ObjectType& type : scene.objectTypes) type.mass *= mass;
    return scene;
}

}  // namespace

Expected<ScenarioParts> varied(const ScenarioParts& parts, std::uint32_t trial) {
    if (trial == 0) return parts;
    for (int attempt = 0; attempt < mostDraws; ++attempt) {
        Scene scene = moved(parts.scene, parts.variation, Draws(trial, attempt));
        if (findStartOverlap(scene)) continue;
        ScenarioParts result = parts;
        result.scene = std::move(scene);
        return result;
    }
    return fail(parts.name, "in a hundred draws of trial " + std::to_string(trial) +
                                " bodies have overlapped; expected less variation, or more room");
}

}  // namespace mrose
