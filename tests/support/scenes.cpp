#include "support/scenes.h"

#include <cmath>
#include <numbers>

#include "motion/learned_model.h"
#include "motion/noisy_model.h"
#include "world/noise.h"

namespace mrose {
namespace {

ShapePart box(double least_x, double least_y, double most_x, double most_y) {
    ShapePart part;
    part.polygon = {{least_x, least_y}, {most_x, least_y}, {most_x, most_y}, {least_x, most_y}};
    return part;
}

ShapePart disc(double radius) {
    ShapePart part;
    part.radius = radius;
    return part;
}

std::shared_ptr<const Shape> shapeOf(const char* name, ShapePart part) {
    return std::make_shared<const Shape>(Shape::fromParts(name, {std::move(part)}));
}

}  // namespace

void RandomCommands::decide(const Observation& observation, std::span<std::byte> /*memory*/, Decision& decision) const {
    const NoisePair u = uniformPair({1, observation.time, observation.robot, 0});
    decision.command = Command{least_ + (most_ - least_) * u.first, turning_ * (2 * u.second - 1)};
}

std::shared_ptr<const MotionModel> paperFormModel(double deadTime, double lag) {
    MotionNetwork network;
    network.robotType = "bench";
    network.robots = {"1"};
    const double period = toSeconds(network.period), approach = 1 - std::exp(-period / lag);
    using Quantity = NetworkInput::Quantity;
    network.inputs = {{Quantity::velocityV},
                      {Quantity::velocityW},
                      {Quantity::commandV, deadTime, deadTime + 0.05},
                      {Quantity::commandW, deadTime, deadTime + 0.05}};
    network.outputs.resize(5);
    const int inputs = 4, hidden = 24, outputs = 5;
    network.mlp.shape = {inputs, hidden, outputs};
    std::vector<float>& p = network.mlp.parameters;
    p.resize(network.mlp.shape.parameterCount());
    // Hidden unit i carries input i in the straight part of its tanh.
    constexpr float gain = 1e-2F;
    for (int i = 0; i < inputs; ++i) p[static_cast<std::size_t>(i * inputs + i)] = gain;
    const auto output = [&](int row, int input, double factor) {
        p[static_cast<std::size_t>(hidden * (inputs + 1) + row * hidden + input)] = static_cast<float>(factor) / gain;
    };
    for (int channel = 0; channel < 2; ++channel) {
        output(3 + channel, channel, 1 - approach);
        output(3 + channel, 2 + channel, approach);
        const int moved = channel == 0 ? 0 : 2;
        output(moved, channel, period * (1 - approach / 2));
        output(moved, 2 + channel, period * approach / 2);
    }
    return std::make_shared<const LearnedModel>(std::make_shared<const LearnedMotion>(std::move(network)), "1");
}

Environment walledField(double width, double height, const Surface& surface) {
    constexpr double t = 0.2;
    Environment environment;
    environment.name = "field";
    const auto wall = [&](const char* name, ShapePart part) {
        environment.obstacles.push_back({name, Shape::fromParts(name, {std::move(part)}), surface});
    };
    wall("south", box(-t, -t, width + t, 0));
    wall("north", box(-t, height, width + t, height + t));
    wall("west", box(-t, -t, 0, height + t));
    wall("east", box(width, -t, width + t, height + t));
    return environment;
}

RobotType squareRobot(double side, double mass) {
    RobotType type;
    type.name = "square";
    type.shape = shapeOf("square", box(-side / 2, -side / 2, side / 2, side / 2));
    type.mass = mass;
    type.surface = {0.3, 0.1};
    type.perception.robots.present = type.perception.objects.present = false;
    return type;
}

RobotType discRobot(double radius, double mass) {
    RobotType type = squareRobot(2 * radius, mass);
    type.name = "disc";
    type.shape = shapeOf("disc", disc(radius));
    return type;
}

ObjectType ballType() {
    ObjectType type;
    type.name = "ball";
    type.shape = shapeOf("ball", disc(0.11));
    return type;
}

ObjectType boxType(double side, double mass) {
    ObjectType type;
    type.name = "box";
    type.shape = shapeOf("box", box(-side / 2, -side / 2, side / 2, side / 2));
    type.mass = mass;
    type.surface = {0.3, 0.2};
    type.rolls = false;
    return type;
}

Perception noisyPerception() {
    Perception perception;
    perception.self = {{0.08, 0.08, 0.05}, {0.05, 0.05, 0.03}, 1.5, 100'000'000, 0.05, 0.001, 0.5};
    perception.objects.bearingNoise = 0.017;
    perception.objects.rangeNoise = 0.03;
    perception.objects.rangeNoiseSlope = 0.02;
    perception.robots = perception.objects;
    return perception;
}

Perception cameraPerception(double range) {
    constexpr double degree = std::numbers::pi / 180;
    Perception perception;
    perception.self = {{0.04, 0.04, 1.5 * degree}, {0.06, 0.06, 2 * degree}, 1.5, 100'000'000, 0.05, 0.001, 0.5};
    perception.objects = {.bearingNoise = degree,
                          .rangeNoise = 0.03,
                          .rangeNoiseSlope = 0.02,
                          .fieldOfView = 90 * degree,
                          .range = range,
                          .latency = 100'000'000,
                          .dropOut = 0.05,
                          .occlusion = true};
    perception.robots = perception.objects;
    perception.robots.bearingNoise = 1.5 * degree;
    perception.robots.rangeNoise = 0.05;
    perception.velocityNoise = 0.01;
    perception.rotationNoise = degree;
    return perception;
}

Scenario fieldScenario(const FieldOptions& options) {
    constexpr double areaPerRobot = 6.25;
    const double height = std::sqrt(options.robots * areaPerRobot / 2), width = 2 * height;
    ScenarioParts parts;
    parts.name = "field";
    Scene& scene = parts.scene;
    scene.environment = walledField(width, height);
    RobotType type = squareRobot();
    if (options.perception) type.perception = *options.perception;
    scene.robotTypes = {type};
    scene.models = {withNoise(options.model, options.motionNoise ? MotionNoise{0.02, 0.02, 0.02} : MotionNoise{})};
    scene.objectTypes = {ballType()};
    scene.objects = {{"ball", 0, {width / 2, height / 2, 0}, {}}};
    const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(2.0 * options.robots)));
    const std::uint32_t rows = (options.robots + columns - 1) / columns;
    const auto commands = std::make_shared<const RandomCommands>(options.heavy ? 0 : -options.share, options.share,
                                                                 (options.heavy ? 4 : 2) * options.share);
    const std::int64_t period = options.model->period() / scene.tickLength;
    for (std::uint32_t i = 0; i < options.robots; ++i) {
        SceneRobot robot;
        robot.name = std::to_string(i + 1);
        robot.phase = i % period;
        robot.start = {width * (i % columns + 0.5) / columns, height * (i / columns + 0.5) / rows,
                       std::numbers::pi * (2 * uniformNoise({7, 0, i, 0}) - 1)};
        scene.robots.push_back(robot);
        parts.controllers.push_back(commands);
    }
    return Scenario(std::move(parts));
}

}  // namespace mrose
