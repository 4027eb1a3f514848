#include "scenario/scenario_file.h"

#include <set>

#include <gtest/gtest.h>

#include "motion/learned_model.h"
#include "motion/network_fixture.h"
#include "motion/noisy_model.h"
#include "scenario/descriptions.h"
#include "simulation/step.h"
#include "support/units.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

TEST(ScenarioFile, GivesWhatTheFilesHold) {
    const auto loaded = loadFrom(smallWorld());
    ASSERT_TRUE(loaded) << loaded.error().message();
    const ScenarioParts& parts = loaded->parts;
    EXPECT_EQ(parts.name, "small");
    EXPECT_EQ(parts.seed, 7u);
    EXPECT_EQ(parts.duration, 12'500'000'000);
    EXPECT_FALSE(parts.kickOff);
    const Scene& scene = parts.scene;
    EXPECT_EQ(scene.tickLength, 20'000'000);
    EXPECT_EQ(scene.randomFactor, 0.2);
    EXPECT_EQ(scene.environment.name, "yard");
    ASSERT_EQ(scene.robots.size(), 3u);
    ASSERT_EQ(parts.controllers.size(), 3u);
    EXPECT_EQ(scene.robots[0].name, "one");
    EXPECT_EQ(scene.robots[0].start, (Pose{-1, 0.5, 90 * degree}));
    EXPECT_EQ(scene.robots[0].phase, 2) << "0.04 s of ticks of 0.02 s";
    EXPECT_EQ(scene.robots[1].phase, 2) << "half of five ticks, rounded down";
    EXPECT_EQ(scene.typeOf(0).name, "kinematic");
    EXPECT_EQ(scene.typeOf(1).name, "learned");
    EXPECT_FALSE(scene.typeOf(0).person);
    EXPECT_TRUE(scene.typeOf(2).person);
    EXPECT_EQ(scene.typeOf(2).shape, scene.typeOf(0).shape) << "shapes are shared";
    EXPECT_EQ(scene.robots[2].model, scene.robots[0].model) << "and so are models";
}

TEST(ScenarioFile, VariationIsReadInSiUnits) {
    const auto plain = loadFrom(smallWorld());
    ASSERT_TRUE(plain) << plain.error().message();
    EXPECT_EQ(plain->parts.variation, Variation{});
    const auto varied = loadFrom(changedWorld("s.toml", "kick_off = false",
                                              "variation = { robot_position_m = 0.3, robot_heading_deg = 30, "
                                              "object_position_m = 0.2, friction_share = 0.25, mass_share = 0.125 }"));
    ASSERT_TRUE(varied) << varied.error().message();
    EXPECT_EQ(varied->parts.variation, (Variation{0.3, 30 * degree, 0.2, 0.25, 0.125}));
}

TEST(ScenarioFile, BallComesFirstAmongObjects) {
    const auto loaded = loadFrom(smallWorld());
    ASSERT_TRUE(loaded) << loaded.error().message();
    const Scene& scene = loaded->parts.scene;
    ASSERT_EQ(scene.objects.size(), 2u);
    EXPECT_EQ(scene.objects[0].name, "ball");
    EXPECT_EQ(scene.objects[0].velocity_W, (Twist{1, -0.5, 180 * degree}));
    const ObjectType& ball = scene.typeOfObject(0);
    EXPECT_TRUE(ball.rolls);
    EXPECT_EQ(ball.mass, 0.4);
    EXPECT_EQ(ball.inertia, 0.4);
    EXPECT_EQ(ball.surface, ObjectType{}.surface);
    const ObjectType& crate = scene.typeOfObject(1);
    EXPECT_FALSE(crate.rolls);
    EXPECT_EQ(crate.surface, (Surface{0.5, 0}));
    EXPECT_EQ(scene.objects[1].start, (Pose{-2, -1, 10 * degree}));
}

TEST(ScenarioFile, RobotsOfOneNetworkShareIt) {
    auto texts = smallWorld();
    for (const auto& [name, which] :
         {std::pair("x", "motion_robot = \"b\""), std::pair("y", "motion_robot = \"a\""), std::pair("z", "")})
        texts["s.toml"] += std::string("[[robot]]\nname = \"") + name + "\"\ntype = \"learned.toml\"\n" + which +
                           "\nstart = { x_m = 4, y_m = " + std::to_string(*name - 'y') + " }\n";
    const auto loaded = loadFrom(texts);
    ASSERT_TRUE(loaded) << loaded.error().message();
    const Scene& scene = loaded->parts.scene;
    // In order: one, two (b), x (b), y (a), z (the mean), three, who is a person and comes last.
    ASSERT_EQ(scene.robots.size(), 6u);
    EXPECT_EQ(scene.models.size(), 4u);
    EXPECT_EQ(scene.robots[2].model, scene.robots[1].model);
    EXPECT_NE(scene.robots[3].model, scene.robots[1].model);
    EXPECT_NE(scene.robots[4].model, scene.robots[3].model);
    EXPECT_EQ(scene.robotTypes.size(), 3u);
    // Each moves as its own robot of the network does.
    const auto motion = std::make_shared<const LearnedMotion>(arbitraryNetwork(MotionNetwork::Form::state));
    CommandHistory history;
    history.issue(0, {0.2, 0.1});
    const MotionInput input{&history, 300'000'000, {0.1, 0.1}};
    for (const auto& [robot, name] : {std::pair(1, "b"), std::pair(3, "a"), std::pair(4, "")})
        EXPECT_EQ(scene.modelOf(static_cast<std::size_t>(robot)).predictOne(input).increment,
                  LearnedModel(motion, name).predictOne(input).increment);
}

/// Drawn is what the robot file says: the network's noise, or a constant one in its place. A robot's own key decides
/// between the network's and none.
TEST(ScenarioFile, ARobotMovesByTheNoiseThatItsFileOrItsOwnKeySays) {
    MotionNetwork network = arbitraryNetwork(MotionNetwork::Form::state);
    network.noise = ResidualNoise{};
    network.noise->processes = {{ResidualNoise::Axis::forward, 0.5, {{NoiseTrait::moving, 1e-3}}}};
    const MotionNoise constant{0.1, 0.2, 0};
    const MotionDraw mean = MotionDraw::mean, noisy = MotionDraw::noisy;
    struct Case {
        const char *file, *key;
        MotionDraw draw;
        MotionNoise noise;
    };
    const char* const ofFile = "[motion_noise]\ndistance_per_distance = 0.1\nrotation_per_rotation = 0.2\n";
    for (const Case& one :
         {Case{"", "", noisy, {}}, Case{"", "learned_noise = false\n", mean, {}}, Case{ofFile, "", mean, constant},
          Case{ofFile, "learned_noise = true\n", noisy, {}}, Case{ofFile, "learned_noise = false\n", mean, {}}}) {
        auto texts = changedWorld("s.toml", "motion_robot = \"b\"\n", std::string("motion_robot = \"b\"\n") + one.key);
        texts["n.net"] = networkText(network);
        texts["learned.toml"] += one.file;
        const auto loaded = loadFrom(texts);
        ASSERT_TRUE(loaded) << loaded.error().message();
        const MotionModel& model = loaded->parts.scene.modelOf(1);
        ASSERT_NE(learnedModel(model), nullptr);
        EXPECT_EQ(learnedModel(model)->draw(), one.draw) << one.file << one.key;
        EXPECT_EQ(noiseOf(model), one.noise) << one.file << one.key;
    }
}

TEST(ScenarioFile, PhasesSpreadByThemselves) {
    auto texts = smallWorld();
    for (int i = 0; i < 10; ++i)
        texts["s.toml"] += "[[robot]]\nname = \"extra " + std::to_string(i) +
                           "\"\ntype = \"r.toml\"\nstart = { x_m = " + std::to_string(0.45 * i - 2) +
                           ", y_m = -2.5 }\n";
    const auto loaded = loadFrom(texts);
    ASSERT_TRUE(loaded) << loaded.error().message();
    std::array<int, 5> robots{};
    for (const SceneRobot& robot : loaded->parts.scene.robots) ++robots.at(static_cast<std::size_t>(robot.phase));
    for (const int count : robots) EXPECT_GE(count, 2) << "13 robots over the 5 ticks of a period";
}

TEST(ScenarioFile, ItsValueLoadsTheSameScenarioAgain) {
    const auto first = loadFrom(smallWorld());
    ASSERT_TRUE(first) << first.error().message();
    std::set<std::string> names, files;
    for (const auto& [name, text] : smallWorld()) names.insert(name);
    for (const Value::File& file : first->value.files()) files.insert(file->name);
    EXPECT_EQ(files, names) << "all files were read, and nothing else was kept";
    const auto value = ScenarioValue::parse(first->value.bytes());
    ASSERT_TRUE(value);
    EXPECT_EQ(*value, first->value);
    EXPECT_EQ(value->hash(), first->value.hash());
    const auto second = loadScenario(*value);
    ASSERT_TRUE(second) << second.error().message();
    EXPECT_EQ(second->value, first->value);
    const StateHash run = hashOf(stateAfter(first->parts, 300));
    EXPECT_EQ(run, hashOf(stateAfter(second->parts, 300)));
    EXPECT_NE(run, hashOf(stateAfter(first->parts, 299))) << "they move at all";
}

TEST(ScenarioFile, VelocityScriptIssuesItsCommandsAtTheirTimes) {
    const auto loaded = loadFrom(smallWorld());
    ASSERT_TRUE(loaded) << loaded.error().message();
    const Scenario scenario(loaded->parts);
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    for (int i = 0; i < 60; ++i) step(scenario, state, buffers);
    const CommandView commands = scenario.commandsOf(state, 0);
    EXPECT_EQ(commands.at(1'049'999'999), (Command{0.3, 0}));
    EXPECT_EQ(commands.at(1'050'000'000), (Command{0, 90 * degree})) << "between two control instants";
}

TEST(ScenarioFile, FilesAreFoundBesideTheOneThatNamesThemThenWhereTheyShip) {
    std::map<std::string, std::string> texts;
    const auto world = smallWorld();
    texts["here/there/s.toml"] = world.at("s.toml");
    texts["mrose:resources/environments/e.toml"] = world.at("e.toml");
    texts["here/there/r.toml"] = world.at("r.toml");
    texts["mrose:resources/robots/r.toml"] = "never read";
    texts["mrose:resources/robots/learned.toml"] = world.at("learned.toml");
    texts["mrose:shapes/disc.toml"] = world.at("disc.toml");
    texts["here/ball.toml"] = world.at("ball.toml");
    texts["mrose:nets/n.net"] = world.at("n.net");
    texts["here/there/s.toml"].replace(texts["here/there/s.toml"].find("\"ball.toml\""), 11, "\"../ball.toml\"");
    const auto loaded = loadFrom(texts, "here/there/s.toml");
    ASSERT_TRUE(loaded) << loaded.error().message();
    texts.erase("mrose:resources/robots/r.toml");
    std::set<std::string> names, files;
    for (const auto& [name, text] : texts) names.insert(name);
    for (const Value::File& file : loaded->value.files()) files.insert(file->name);
    EXPECT_EQ(files, names);
    texts["mrose:resources/scenarios/s.toml"] = world.at("s.toml");
    texts["mrose:shapes/ball.toml"] = world.at("ball.toml");
    EXPECT_EQ(loadFrom(texts, "s.toml").error().message(),
              "mrose:resources/scenarios/s.toml:12:8: robot[\"one\"].type: \"r.toml\" was not found; expected "
              "mrose:resources/scenarios/r.toml or mrose:resources/robots/r.toml");
    EXPECT_EQ(loadFrom(texts, "none.toml").error().message(),
              "none.toml: does not exist, nor does mrose:none.toml or mrose:resources/scenarios/none.toml");
}

TEST(ScenarioFile, RobotAndItsShapeMayHaveOneFileName) {
    std::map<std::string, std::string> texts = smallWorld();
    texts["mrose:shapes/r.toml"] = texts["disc.toml"];
    texts["r.toml"].replace(texts["r.toml"].find("\"disc.toml\""), 11, "\"r.toml\"");
    const auto loaded = loadFrom(texts);
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_EQ(loaded->parts.scene.typeOf(0).shape->name, "disc");
}

}  // namespace
}  // namespace mrose
