#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "scenario/scenario.h"

namespace mrose {

/// Forward and turning speeds drawn anew at every control instant: v in `least` ... `most`, w within +-`turning`.
class RandomCommands final : public Controller {
public:
    RandomCommands(double least, double most, double turning) : least_(least), most_(most), turning_(turning) {}
    void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const override;

private:
    double least_, most_, turning_;
};

/// A motion network of the paper's form, 4-24-5, whose weights make it (nearly) a lag of `lag` seconds behind dead
/// time.
std::shared_ptr<const MotionModel> paperFormModel(double deadTime = 0.1, double lag = 0.1);

/// A field of the given size in metres, its lower left corner at the origin, in walls 0.2 m thick.
Environment walledField(double width, double height, const Surface& surface = {0.2, 0});

RobotType squareRobot(double side = 0.45, double mass = 20);
RobotType discRobot(double radius = 0.225, double mass = 20);
ObjectType ballType();
ObjectType boxType(double side = 0.3, double mass = 2);

/// All round, late about itself alone, through everything.
Perception noisyPerception();
/// One camera on a robot that sees as far as `range` m, 0 for without end: as the shipped nomad200.toml.
Perception cameraPerception(double range);

/// The benchmarks' scene: `robots` square robots on 6.25 m2 each in a walled field twice as wide as high, and a ball.
/// Heavy: v in 0 ... 1 m/s, w within +-4 rad/s, so that they travel and collide; light: v within +-1, w within +-2.
struct FieldOptions {
    std::uint32_t robots = 8;
    bool heavy = true;
    double share = 1;  ///< of those speeds, for slower robots
    bool motionNoise = true;
    std::optional<Perception> perception = {};  ///< nullopt: it sees no bodies
    std::shared_ptr<const MotionModel> model = paperFormModel();
};
Scenario fieldScenario(const FieldOptions& options);

}  // namespace mrose
