#include "recording/match.h"

#include <cmath>
#include <numbers>

#include "motion/kinematic.h"
#include "motion/noisy_model.h"
#include "world/noise.h"

namespace mrose {
namespace {

ShapePart box(double leastX, double leastY, double mostX, double mostY, const Colour& colour = {120, 120, 120}) {
    ShapePart part;
    part.polygon = {{leastX, leastY}, {mostX, leastY}, {mostX, mostY}, {leastX, mostY}};
    part.colour = colour;
    return part;
}

ShapePart disc(double radius, const Colour& colour) {
    ShapePart part;
    part.radius = radius;
    part.colour = colour;
    return part;
}

std::shared_ptr<const Shape> shapeOf(const char* name, ShapePart part) {
    return std::make_shared<const Shape>(Shape::fromParts(name, {std::move(part)}));
}

Environment field(double width, double height) {
    constexpr double t = 0.2;
    Environment environment;
    environment.name = "field";
    const auto wall = [&](const char* name, ShapePart part) {
        environment.obstacles.push_back({name, Shape::fromParts(name, {std::move(part)}), {0.2, 0.3}});
    };
    wall("south", box(-t, -t, width + t, 0));
    wall("north", box(-t, height, width + t, height + t));
    wall("west", box(-t, -t, 0, height + t));
    wall("east", box(width, -t, width + t, height + t));
    Marking circle;
    circle.centre = {width / 2, height / 2};
    circle.radius = 1;
    Marking line;
    line.points = {{width / 2, 0}, {width / 2, height}};
    environment.markings = {circle, line};
    environment.goals = {{"left", {{0, height / 3}, {0.5, height / 3}, {0.5, 2 * height / 3}, {0, 2 * height / 3}}},
                         {"", {{width - 0.5, height / 3}, {width, height / 3}, {width, 2 * height / 3}}}};
    return environment;
}

RobotType robotType(const char* name, ShapePart part, bool lively) {
    RobotType type;
    type.name = name;
    type.shape = shapeOf(name, std::move(part));
    type.manipulators.resize(1);
    type.manipulators[0].name = "kicker";
    type.manipulators[0].position = {0.22, 0};
    type.manipulators[0].deadTime = 60'000'000;
    if (!lively) return type;
    type.perception.self = {{0.03, 0.03, 0.02}, {0.05, 0.05, 0.03}, 1.5, 100'000'000, 0.05, 0.001, 0.5};
    type.perception.objects.bearingNoise = type.perception.objects.bearingBias = 0.02;
    type.perception.objects.latency = 60'000'000;
    type.perception.robots.dropOut = 0.1;
    return type;
}

std::shared_ptr<const MotionModel> motionModel(bool lively) {
    KinematicParameters parameters;
    parameters.v = {lively ? 0.13 : 0, lively ? 0.1 : 0, 1, 0, 2, 0};
    parameters.w = {lively ? 0.09 : 0, lively ? 0.05 : 0, 1, 0, 5, 0};
    return withNoise(std::make_shared<const KinematicModel>(parameters),
                     lively ? MotionNoise{0.02, 0.02, 0.02} : MotionNoise{});
}

}  // namespace

void Rover::decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const {
    auto& own = as<Memory>(memory);
    ++own.decisions;
    if (asked_ != nullptr) ++*asked_;
    const NoisePair u = uniformPair({5, own.decisions, observation.robot, 0});
    double turn = 0.5 * own.lastTurn + 3 * (2 * u.second - 1);
    for (const SeenBody& seen : observation.objects())
        if (seen.index == 0 && length(seen.position_B) < 2.5 && own.decisions % 8 != 0)
            turn = 3 * std::clamp(seen.position_B.y, -1.0, 1.0);
    own.lastTurn = turn;
    if (variant_ != 0 && observation.time >= from_) turn += 1e-3 * variant_;
    if (own.decisions % 5 == 0) decision.earlier.push_back({observation.time - 30'000'000, {0.3, turn}});
    if (own.decisions % 4 != 0) decision.command = Command{1.2 * u.first, turn};
    if (own.decisions % 11 == 0) decision.kicks.push_back({0, u.first});
}

ScenarioParts matchParts(const MatchOptions& options) {
    const double height = std::sqrt(options.robots * 6.25 / 2), width = 2 * height;
    ScenarioParts parts;
    parts.name = "match";
    parts.seed = 77;
    Scene& scene = parts.scene;
    scene.environment = field(width, height);
    if (options.lively) scene.randomFactor = 0.2;
    scene.robotTypes = {robotType("square", box(-0.225, -0.225, 0.225, 0.225, {180, 30, 30}), options.lively),
                        robotType("disc", disc(0.225, {30, 30, 180}), options.lively)};
    scene.models = {motionModel(options.lively)};
    ObjectType ball, crate;
    ball.name = "ball";
    ball.shape = shapeOf("ball", disc(0.11, {255, 120, 0}));
    crate.name = "crate";
    crate.shape = shapeOf("crate", box(-0.15, -0.15, 0.15, 0.15));
    crate.rolls = false;
    crate.mass = 3;
    scene.objectTypes = {ball, crate};
    scene.objects = {{"ball", 0, {width / 2, height / 2, 0}, {1, 0.5, 0}},
                     {"crate", 1, {width / 3, height / 2, 1}, {}}};
    const auto columns = static_cast<std::uint32_t>(std::ceil(std::sqrt(2.0 * options.robots)));
    const std::uint32_t rows = (options.robots + columns - 1) / columns;
    for (std::uint32_t i = 0; i < options.robots; ++i) {
        SceneRobot robot;
        robot.name = "rover " + std::to_string(i + 1);
        robot.type = i % 2;
        robot.phase = i % 5;
        robot.start = {width * (i % columns + 0.5) / columns, height * (i / columns + 0.5) / rows,
                       std::numbers::pi * (2 * uniformNoise({7, 0, i, 0}) - 1)};
        scene.robots.push_back(robot);
        parts.controllers.push_back(options.controller);
    }
    return parts;
}

StraightRun runMatch(const Scenario& scenario, const WorldState& start, std::int64_t ticks,
                     const OutsideDecisions& outside) {
    StraightRun run{{start}, {}};
    StepBuffers buffers;
    for (std::int64_t i = 0; i < ticks; ++i) {
        WorldState state = run.states.back();
        std::vector<RobotDecision> given;
        if (outside) given = outside(state.tick);
        run.traces.emplace_back();
        step(scenario, state, buffers, {given, true}, &run.traces.back());
        run.states.push_back(std::move(state));
    }
    return run;
}

}  // namespace mrose
