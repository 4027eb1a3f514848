// Learned cameras in robot files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "motion/network_fixture.h"
#include "scenario/descriptions.h"
#include "sensing/camera_network.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

using testing::HasSubstr;

std::map<std::string, std::string> cameraWorld(const std::string& sensor, const std::string& network) {
    auto texts = changedWorld("learned.toml", "[motion]", "[[sensor]]\nkind = \"learned\"\n" + sensor + "[motion]");
    texts["c.net"] = network;
    texts["e.toml"].replace(texts["e.toml"].find("name = \"post\""), 13, "name = \"post\"\nlandmark = \"7\"");
    return texts;
}

TEST(LearnedCameraFile, IsAskedForInARobotFile) {
    const std::string named = "name = \"camera\"\nnetwork = \"c.net\"\n";
    const SensorNetwork network = cameraNetwork({0.8, 0.01, 0.1, 0.02, 0.05});
    const auto loaded = loadFrom(cameraWorld(named, sensorText(network)));
    ASSERT_TRUE(loaded) << loaded.error().message();
    const Scenario scenario(loaded->parts);
    const Sensor& camera = *scenario.sensors(1)[3];
    EXPECT_EQ(camera.name(), "camera");
    EXPECT_EQ(camera.period(), 236'000'000);
    EXPECT_EQ(camera.latency(), 40'000'000);
    EXPECT_EQ(scenario.scene().robots[1].motionRobot, "b");
    EXPECT_EQ(scenario.obstacles().landmarks()[0].name, "7");

    const auto again = loadScenario(loaded->value);
    ASSERT_TRUE(again) << "without any file: " << again.error().message();
    EXPECT_EQ(hashOf(stateAfter(again->parts, 100)), hashOf(stateAfter(loaded->parts, 100)));

    const auto other =
        loadFrom(cameraWorld(named + "period_s = 0.5\nlatency_s = 0.1\nrobot = \"a\"\n", sensorText(network)));
    ASSERT_TRUE(other) << other.error().message();
    EXPECT_EQ(Scenario(other->parts).sensors(1)[3]->period(), 500'000'000);
    EXPECT_EQ(Scenario(other->parts).sensors(1)[3]->latency(), 100'000'000);
}

TEST(LearnedCameraFile, ALocalisationHasTheKeysOfACamera) {
    const std::string named = "name = \"place\"\nnetwork = \"p.net\"\n";
    auto texts = cameraWorld(named, "");
    texts["p.net"] = sensorText(test::constantLocalisation({}));
    const auto loaded = loadFrom(texts);
    ASSERT_TRUE(loaded) << loaded.error().message();
    EXPECT_EQ(Scenario(loaded->parts).sensors(1)[3]->period(), 236'000'000);
    EXPECT_EQ(Scenario(loaded->parts).sensors(1)[3]->latency(), 40'000'000);
    auto changed = cameraWorld(named + "period_s = 0.5\nlatency_s = 0.1\nrobot = \"1\"\n", "");
    changed["p.net"] = texts["p.net"];
    const auto other = loadFrom(changed);
    ASSERT_TRUE(other) << other.error().message();
    EXPECT_EQ(Scenario(other->parts).sensors(1)[3]->period(), 500'000'000);
    EXPECT_EQ(Scenario(other->parts).sensors(1)[3]->latency(), 100'000'000);
}

TEST(LearnedCameraFile, MistakesAreNamed) {
    const std::string named = "name = \"camera\"\nnetwork = \"c.net\"\n";
    const std::string text = sensorText(cameraNetwork());
    const auto errorOf = [](const std::string& sensor, const std::string& network) {
        const auto loaded = loadFrom(cameraWorld(sensor, network));
        return loaded ? "" : loaded.error().message();
    };
    EXPECT_EQ(errorOf("name = \"camera\"\n", text), "learned.toml:6:1: sensor[\"camera\"].network: is missing");
    EXPECT_EQ(errorOf("name = \"camera\"\nnetwork = \"no.net\"\n", text),
              "learned.toml:9:11: sensor[\"camera\"].network: \"no.net\" was not found; expected no.net or "
              "mrose:nets/no.net");
    EXPECT_THAT(
        errorOf(named + "robot = \"z\"\n", text),
        HasSubstr("learned.toml:10:9: sensor[\"camera\"].robot: is none of the network's robots: \"a\", \"b\""));
    EXPECT_THAT(errorOf("name = \"a_name_of_22_letters__\"\nnetwork = \"c.net\"\n", text),
                HasSubstr("learned.toml:8:8: sensor[\"a_name_of_22_letters__\"].name: expected at most 21 characters"));
    EXPECT_THAT(errorOf(named + "range_m = 3\n", text), HasSubstr("sensor[\"camera\"].range_m: is not a known key"));
    EXPECT_THAT(errorOf(named, networkText(arbitraryNetwork(MotionNetwork::Form::state))),
                HasSubstr("c.net:4:8: kind: is a network of another kind, \"motion\"; expected \"sensor\""));
    const SensorNetwork poses = test::constantLocalisation({});
    EXPECT_THAT(errorOf(named + "latency_s = -0.1\n", sensorText(poses)), HasSubstr("sensor[\"camera\"].latency_s: "));
    EXPECT_THAT(errorOf(named + "range_m = 3\n", sensorText(poses)), HasSubstr("range_m: is not a known key"));
}

}  // namespace
}  // namespace mrose
