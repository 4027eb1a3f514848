#include "scenario/robot_file.h"

#include <numbers>

#include <gtest/gtest.h>

#include "motion/network_fixture.h"
#include "scenario/descriptions.h"
#include "support/units.h"
#include "synthetic/reference_model.h"

namespace mrose {
namespace {

Expected<RobotDescription> load(std::map<std::string, std::string> texts, const std::string& name) {
    KeptDescriptions source(std::move(texts));
    DescriptionLibrary library(source);
    const auto file = library.file(name, {});
    if (!file) return tl::unexpected(file.error());
    return readRobot(*file, library);
}

/// The refusal of a learned robot whose [motion] holds more than the network, and whose file begins with `root`.
std::string motionRefusal(const std::string& motion, const std::string& root = "") {
    auto texts = changedWorld("learned.toml", "network = \"n.net\"\n", "network = \"n.net\"\n" + motion);
    texts["learned.toml"].insert(texts["learned.toml"].find("[motion]"), root);
    const auto robot = load(texts, "learned.toml");
    return robot ? "" : robot.error().message();
}

TEST(RobotFile, GivesWhatTheFileHoldsInRadians) {
    const auto robot = load(smallWorld(), "r.toml");
    ASSERT_TRUE(robot) << robot.error().message();
    const RobotType& type = robot->type;
    EXPECT_EQ(type.name, "kinematic");
    EXPECT_EQ(type.shape->name, "disc");
    EXPECT_EQ(type.mass, 12.5);
    EXPECT_EQ(type.surface, (Surface{0.7, 0.2}));
    EXPECT_EQ(robot->motionNoise, (MotionNoise{0.01, 0.02, 9 * degree}));
    ASSERT_EQ(type.manipulators.size(), 2u);
    EXPECT_EQ(type.manipulators[0],
              (Manipulator{"kicker", {0.2, 0.05}, 30 * degree, 2.5, 0.04, 0.18, 1'500'000'000, 200'000'000}))
        << "without a dead time of its own it has the one of the speed";
    EXPECT_EQ(type.manipulators[1].deadTime, 400'000'000);
    const auto* kinematic = dynamic_cast<const KinematicModel*>(robot->model.get());
    ASSERT_TRUE(kinematic);
    EXPECT_FALSE(robot->motion);
    EXPECT_EQ(robot->controlPeriod(), 100'000'000);
    const KinematicParameters expected{
        {0.2, 0.1, 0.9, 0.01, 0.5, 0.4}, {0.3, 0, 1, 1.8 * degree, 90 * degree, 180 * degree}, 0.02};
    EXPECT_EQ(kinematic->parameters(), expected);
}

TEST(RobotFile, GivesPerceptionWhole) {
    const auto robot = load(smallWorld(), "r.toml");
    ASSERT_TRUE(robot) << robot.error().message();
    const Perception& seen = robot->type.perception;
    EXPECT_EQ(seen.velocityNoise, 0.01);
    EXPECT_EQ(seen.rotationNoise, 18 * degree);
    EXPECT_EQ(seen.self, (SelfLocalisation{
                             {0.05, 0.06, 1.8 * degree}, {0.02, 0.03, 3.6 * degree}, 2, 80'000'000, 0.05, 0.001, 0.4}));
    EXPECT_EQ(seen.objects, (BodySight{true, 0.9 * degree, 0.03, 0.02, 1.8 * degree, std::numbers::pi / 2, 0, 6,
                                       100'000'000, 0.1, true}));
    BodySight blind;
    blind.present = false;
    EXPECT_EQ(seen.robots, blind);
    const auto aside = load(changedWorld("r.toml", "field_of_view_deg = 90", "direction_deg = -30"), "r.toml");
    ASSERT_TRUE(aside) << aside.error().message();
    EXPECT_EQ(aside->type.perception.objects.direction, -30 * degree);
    const auto learned = load(smallWorld(), "learned.toml");
    ASSERT_TRUE(learned) << learned.error().message();
    EXPECT_EQ(learned->type.perception, Perception{}) << "without a word a robot sees everything exactly";
}

TEST(RobotFile, LearnedRobotMovesAsItsNetworkSays) {
    const auto robot = load(changedWorld("learned.toml", "\"n.net\"", "\"n.net\"\nrobot = \"b\""), "learned.toml");
    ASSERT_TRUE(robot) << robot.error().message();
    EXPECT_EQ(robot->motion->network(), arbitraryNetwork(MotionNetwork::Form::state));
    EXPECT_EQ(robot->motionRobot, "b");
    EXPECT_EQ(robot->controlPeriod(), 100'000'000);
}

TEST(RobotFile, ManipulatorOfALearnedRobotHasTheDeadTimeThatWasIdentified) {
    auto texts = smallWorld();
    texts["learned.toml"] += "robot = \"b\"\n[[manipulator]]\nname = \"k\"\nposition_m = [0, 0]\nspeed_mps = 1\n";
    const auto robot = load(texts, "learned.toml");
    ASSERT_TRUE(robot) << robot.error().message();
    EXPECT_EQ(robot->type.manipulators.at(0).deadTime, 200'000'000) << "the fixture's robot b: v 0.2 s";
}

/// A later dead time is the same motion of commands that came as much earlier.
TEST(RobotFile, OverriddenDeadTimeShiftsTheCommandsThatTheNetworkReads) {
    // The fixture's robot b: v 0.2 s, w 0.15 s. Its wheels' inputs read both, so both shift alike.
    const auto own = load(smallWorld(), "learned.toml");
    const auto late = load(
        changedWorld("learned.toml", "\"n.net\"", "\"n.net\"\ndead_time = { v_s = 0.35, w_s = 0.3, override = true }"),
        "learned.toml");
    ASSERT_TRUE(own && late) << late.error().message();
    const LearnedModel ownModel(own->motion, "b"), lateModel(late->motion, "b");
    CommandHistory commands, earlier;
    for (int i = 0; i < 40; ++i) {
        const Command command{0.02 * i, 0.5 - 0.03 * i};
        commands.issue(i * Nanoseconds{37'000'000}, command);
        earlier.issue(i * Nanoseconds{37'000'000} - 150'000'000, command);
    }
    for (const Nanoseconds start : {Nanoseconds{600'000'000}, Nanoseconds{1'234'567'890}}) {
        const MotionStep a = ownModel.predictOne({&commands, start, {0.1, 0.2}});
        const MotionStep b = lateModel.predictOne({&earlier, start, {0.1, 0.2}});
        // float inputs, whose ages are sums in another order
        EXPECT_NEAR(a.increment.x, b.increment.x, 1e-5);
        EXPECT_NEAR(a.increment.heading, b.increment.heading, 1e-5);
        EXPECT_NEAR(a.velocity.w, b.velocity.w, 1e-5);
        const MotionStep unshifted = lateModel.predictOne({&commands, start, {0.1, 0.2}});
        EXPECT_GT(std::abs(a.increment.x - unshifted.increment.x), 1e-4);
    }
}

TEST(RobotFile, DeadTimeBelongsToTheNetworkUnlessOverridden) {
    EXPECT_EQ(motionRefusal("dead_time = { v_s = 0.2, w_s = 0.15 }"),
              "learned.toml:8:13: motion.dead_time.override: is not true; the network has its own dead time, and only "
              "`override = true` beside another one replaces it");
    EXPECT_EQ(motionRefusal("dead_time = { v_s = 0.2, w_s = 0.15, override = false }").substr(0, 50),
              "learned.toml:8:49: motion.dead_time.override: is n");
    EXPECT_EQ(motionRefusal("dead_time = { v_s = 0.2, w_s = 0.15, override = true }"), "");
    EXPECT_EQ(motionRefusal("dead_time = { v_s = 0.1, w_s = 0.05, override = true }"),
              "learned.toml:8:13: motion.dead_time: the network's is 0.2 and 0.15; its inputs cannot be shifted by the "
              "differences to this one")
        << "its newest input reads the present: earlier would be the future";
    EXPECT_NE(motionRefusal("dead_time = { v_s = 0.4, w_s = 0.15, override = true }"), "") << "its wheels read both";
    EXPECT_EQ(motionRefusal("dead_time_s = 0.2"),
              "learned.toml:8:15: motion.dead_time_s: is not a known key; did you mean dead_time?");
}

/// The robot whose [motion] is this, in a file that begins with `root`.
Expected<RobotDescription> movedByReference(const std::string& motion, const std::string& root = "") {
    auto texts = changedWorld("learned.toml", "network = \"n.net\"\n", motion);
    texts["learned.toml"].insert(texts["learned.toml"].find("[motion]"), root);
    return load(texts, "learned.toml");
}

TEST(RobotFile, MayNameTheReferenceRobotAsItsMotion) {
    const auto robot = movedByReference("model = \"reference\"\n");
    ASSERT_TRUE(robot) << robot.error().message();
    EXPECT_FALSE(robot->motion);
    EXPECT_TRUE(robot->model->sameAs(ReferenceModel(100'000'000)));
    EXPECT_EQ(robot->deadTime, 0.315) << "of the link, and half a period of its controller";
    EXPECT_EQ(movedByReference("model = \"reference\"\n", "control_period_s = 0.04\n")->controlPeriod(), 40'000'000);
    const auto named = movedByReference("model = \"network\"\nnetwork = \"n.net\"\n");
    ASSERT_TRUE(named) << named.error().message();
    EXPECT_TRUE(named->motion);
}

TEST(RobotFile, WhatTheReferenceRobotIsNotNamesItsPlace) {
    const auto refused = [](const std::string& motion, const std::string& root = "") {
        const auto robot = movedByReference(motion, root);
        return robot ? "" : robot.error().message();
    };
    EXPECT_EQ(refused("model = \"referenz\"\n"),
              "learned.toml:7:9: motion.model: is \"referenz\"; expected one of \"network\", \"reference\"");
    EXPECT_EQ(refused("model = \"reference\"\nnetwork = \"n.net\"\n"),
              "learned.toml:8:11: motion.network: is not a known key; expected one of model");
    EXPECT_EQ(refused("model = \"reference\"\n", "control_period_s = 0.3\n"),
              "learned.toml:6:20: control_period_s: is 0.3; expected 0.002 to 0.2");
    EXPECT_EQ(refused("model = \"reference\"\n", "control_period_s = 0.0975\n"),
              "learned.toml:6:20: control_period_s: expected a multiple of the reference robot's step of 0.002 s");
}

/// The perception of a robot whose [perception] is this.
Expected<RobotDescription> perceivingBy(const std::string& perception) {
    auto texts = smallWorld();
    texts["learned.toml"] += perception;
    return load(texts, "learned.toml");
}

TEST(RobotFile, MayPerceiveByTheReferenceCameras) {
    const auto robot = perceivingBy(
        "[perception]\nmodel = \"reference\"\nerror_scale = 0.5\n[perception.objects]\nfield_of_view_deg = 90\n"
        "latency_s = 0.06\nocclusion = true\n");
    ASSERT_TRUE(robot) << robot.error().message();
    const Perception& seen = robot->type.perception;
    EXPECT_EQ(seen.model, Perception::Model::reference);
    EXPECT_EQ(seen.errorScale, 0.5);
    EXPECT_EQ(seen.self.latency, 100'000'000) << "the localiser's own";
    EXPECT_EQ(seen.objects.latency, 60'000'000);
    EXPECT_TRUE(seen.objects.occlusion);
    EXPECT_EQ(perceivingBy("[perception]\nmodel = \"noise\"\n")->type.perception, Perception{});
}

TEST(RobotFile, WhatTheReferenceCamerasAreNotNamesItsPlace) {
    const auto refused = [](const std::string& perception) {
        const auto robot = perceivingBy("[perception]\n" + perception);
        return robot ? "" : robot.error().message();
    };
    EXPECT_EQ(refused("model = \"real\"\n"),
              "learned.toml:9:9: perception.model: is \"real\"; expected one of \"noise\", \"reference\"");
    EXPECT_EQ(refused("model = \"reference\"\nerror_scale = -1\n"),
              "learned.toml:10:15: perception.error_scale: is -1.0; expected 0.0 to 10.0");
    EXPECT_EQ(refused("error_scale = 1\n").substr(0, 63),
              "learned.toml:9:15: perception.error_scale: is not a known key; ");
    EXPECT_EQ(refused("model = \"reference\"\n[perception.self]\nnoise = { x_m = 0.1 }\n"),
              "learned.toml:11:9: perception.self.noise: is not a known key; expected one of latency_s");
    EXPECT_EQ(refused("model = \"reference\"\n[perception.objects]\ndrop_out = 0.1\n").substr(0, 68),
              "learned.toml:11:12: perception.objects.drop_out: is not a known key;");
}

TEST(RobotFile, NetworkMustBeThereAndFit) {
    EXPECT_EQ(motionRefusal("", "control_period_s = 0.05\n"),
              "learned.toml:6:20: control_period_s: is 0.05; the network was learned for 0.1");
    EXPECT_EQ(motionRefusal("", "control_period_s = 0.1\n"), "");
    EXPECT_EQ(motionRefusal("robot = \"r2d2\""),
              "learned.toml:8:9: motion.robot: is none of the network's robots: \"a\", \"b\"");
    EXPECT_EQ(refusal("learned.toml", "n.net", "no.net"),
              "learned.toml:7:11: motion.network: \"no.net\" was not found; expected no.net or mrose:nets/no.net");
    EXPECT_EQ(refusal("n.net", "form = \"state\"", "form = \"else\""),
              "n.net:39:8: motion.form: is \"else\"; expected one of \"state\", \"history\"");
    EXPECT_EQ(refusal("learned.toml", "disc.toml", "../none.toml"),
              "learned.toml:4:9: shape: \"../none.toml\" was not found; expected ../none.toml or mrose:none.toml");
    EXPECT_EQ(refusal("disc.toml", "radius_m = 0.2", "radius_m = 0"),
              "disc.toml:7:23: part[\"body\"].circle.radius_m: is 0.0; expected 0.001 to 20.0");
}

TEST(RobotFile, EveryOtherMistakeNamesItsPlace) {
    const std::tuple<const char*, const char*, const char*> cases[] = {
        {"mass_kg = 12.5", "mass_kg = 0", "r.toml:5:11: mass_kg: is 0.0; expected 0.001 to 100000.0"},
        {"mass_kg = 12.5", "mass_kg = \"12\"", "r.toml:5:11: mass_kg: expected a finite number"},
        {"mass_kg = 12.5\n", "", "r.toml:1:1: mass_kg: is missing"},
        {"control_period_s = 0.1\n", "", "r.toml:1:1: control_period_s: is missing"},
        {"control_period_s = 0.1", "control_period_s = 0",
         "r.toml:6:20: control_period_s: is 0.0; expected 0.001 to 10.0"},
        {"[kinematics]", "[motion]\nnetwork = \"n.net\"\n[kinematics]",
         "r.toml:10:1: kinematics: expected either [motion] or [kinematics]"},
        {"[kinematics]", "[kinematix]", "r.toml:8:1: kinematix: is not a known key; did you mean kinematics?"},
        {"lag_s = 0.1,", "lag_s = -0.1,", "r.toml:9:34: kinematics.v.lag_s: is -0.1; expected 0.0 to 10.0"},
        {"limit_mps = 0.5", "limit_degps = 5",
         "r.toml:9:82: kinematics.v.limit_degps: is not a known key; did you mean limit_mps?"},
        {"distance_per_distance = 0.01", "distance_per_distance = 2",
         "r.toml:13:25: motion_noise.distance_per_distance: is 2.0; expected 0.0 to 1.0"},
        {"direction_deg = 30", "direction_deg = 400",
         "r.toml:19:17: manipulator[\"kicker\"].direction_deg: is 400.0; expected -360.0 to 360.0"},
        {"\"slow kicker\"", "\"kicker\"",
         "r.toml:25:8: manipulator[\"kicker\"].name: \"kicker\" is the name of another manipulator too"},
        {"dead_time_s = 0.4", "dead_time_s = 3",
         "r.toml:28:15: manipulator[\"slow kicker\"].dead_time_s: is 3.0; expected 0.0 to 2.0"},
        {"drop_out = 0.05", "drop_out = 1.5", "r.toml:37:12: perception.self.drop_out: is 1.5; expected 0.0 to 1.0"},
        {"latency_s = 0.08", "latency_s = 8", "r.toml:36:13: perception.self.latency_s: is 8.0; expected 0.0 to 1.0"},
        {"field_of_view_deg = 90", "field_of_view_deg = 0",
         "r.toml:45:21: perception.objects.field_of_view_deg: is 0.0; expected 1.0 to 360.0"},
        {"occlusion = true", "occlusion = 1", "r.toml:49:13: perception.objects.occlusion: expected true or false"},
        {"present = false", "presence = false",
         "r.toml:51:12: perception.robots.presence: is not a known key; did you mean present?"},
        {"mass_kg", "colour = \"#102030\"\nmass_kg",
         "r.toml:5:10: colour: is not a known key; expected one of control_period_s, format, kind, kinematics, "
         "manipulator, "
         "mass_kg, motion, motion_noise, name, perception, sensor, shape, surface, version"},
    };
    for (const auto& [from, to, message] : cases) EXPECT_EQ(refusal("r.toml", from, to), message);
    std::string many;
    for (char c = 'a'; c < 'd'; ++c)
        many += std::string("[[manipulator]]\nname = \"") + c + "\"\nposition_m = [0, 0]\nspeed_mps = 1\n";
    EXPECT_EQ(refusal("r.toml", "[perception]", many + "[perception]"),
              "r.toml:16:1: manipulator: has 5; expected at most 4");
}

}  // namespace
}  // namespace mrose
