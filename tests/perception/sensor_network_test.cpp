#include "perception/sensor_network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "perception/sensor_inputs.h"
#include "perception/some_sensor.h"

namespace mrose {
namespace {

using testing::HasSubstr;

/// What is said of a file in which one thing was replaced.
std::string errorOf(const std::string& from, const std::string& to) {
    std::string text = sensorText(test::someCamera());
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from << " in\n" << text;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    const auto network = parseSensor(text, "c.net");
    return network ? "no error" : network.error().message();
}

TEST(SensorFiles, AreReadBackToTheBit) {
    SensorNetwork network = test::someCamera();
    const auto again = parseSensor(sensorText(network), "c.net");
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_TRUE(*again == network);
    EXPECT_EQ(sensorText(*again), sensorText(network));
    network.landmarks = false;
    const auto other = parseSensor(sensorText(network), "c.net");
    ASSERT_TRUE(other) << other.error().message();
    EXPECT_TRUE(*other == network);
}

TEST(SensorFiles, FromBeforeTheNearEdgeAreOfSensorsThatSeeAllThatIsNear) {
    SensorNetwork network = test::someCamera();
    std::string text = sensorText(network);
    const std::string line = "nearest_m = 0.75\n";
    ASSERT_NE(text.find(line), std::string::npos);
    text.erase(text.find(line), line.size());
    const auto old = parseSensor(text, "c.net");
    ASSERT_TRUE(old) << old.error().message();
    network.view.nearest = 0;
    EXPECT_TRUE(*old == network);
}

TEST(SensorFiles, OfOwnPosesAreReadBackToo) {
    SensorNetwork network = test::constantLocalisation({0.3, 0.01, -0.02, 0.03, -3, -4, -5});
    const SensorNetwork camera = test::someCamera();
    network.gross = {camera.gross.share, {2.5, 0.15, 3}};
    network.noise = camera.noise;
    network.noise[3] = {0.2, 0.3, 4, 0, 1};
    network.constant = camera.constant;
    network.heldOut = camera.heldOut;
    const auto again = parseSensor(sensorText(network), "c.net");
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_TRUE(*again == network);
    EXPECT_EQ(network.learned.outputs[3].name, "heading_error");
}

TEST(SensorFiles, ThatDoNotFitAreRefused) {
    EXPECT_THAT(errorOf("kind = \"sensor\"", "kind = \"motion\""), HasSubstr("another kind"));
    EXPECT_THAT(errorOf("measures = \"subjects\"", "measures = \"smell\""), HasSubstr("measures: "));
    EXPECT_THAT(errorOf("[\"landmarks\", \"robots\"]", "[\"cats\"]"), HasSubstr("found \"cats\""));
    EXPECT_THAT(errorOf("name = \"clearance\", unit = \"m\"", "name = \"clearance\", unit = \"cm\""),
                HasSubstr("\"clearance\" in cm; expected m"));
    EXPECT_THAT(errorOf("name = \"clearance\"", "name = \"smell\""), HasSubstr("\"smell\" that no sensor has"));
    EXPECT_THAT(errorOf("robots = [\"1\", \"2\"]", "robots = [\"1\"]"), HasSubstr("\"robot 2\""));
    EXPECT_THAT(errorOf("name = \"range_error_2\"", "name = \"range_mistake\""), HasSubstr("components: "));
    EXPECT_THAT(errorOf("components = 2", "components = 3"), HasSubstr("components: "));
    EXPECT_THAT(errorOf("components = 2", "components = 9"), HasSubstr("components: "));
    EXPECT_THAT(errorOf("look = 0.1, slow = 0.2", "look = 0.5, slow = 0.4"), HasSubstr("at most 1 together"));
    EXPECT_THAT(errorOf("range_m = 7.5", "range_m = -1"), HasSubstr("c.net:"));
    EXPECT_THAT(errorOf("nearest_m = 0.75", "nearest_m = 8"), HasSubstr("nearest_m: "));
    EXPECT_THAT(errorOf("field_of_view_rad", "field_of_view_deg"), HasSubstr("field_of_view_rad"));
}

TEST(SensorInputs, AreTheQuantitiesByTheirNames) {
    const std::vector<std::string> robots{"1", "2"};
    const std::vector<NetworkVariable> inputs{{"range", "m", 1, 2},
                                              {"bearing_size", "rad"},
                                              {"rotation", "rad/s"},
                                              {"is_robot", "1"},
                                              {"robot 2", "1", 0.25, 0.5}};
    ASSERT_EQ(SensorInputs::objection(inputs, robots), "");
    const SensorInputs reader(inputs, robots);
    SensedState state;
    state.range = 4;
    state.bearing = -0.5;
    state.velocity = {0.1, 0.75};
    state.subject = SubjectKind::robot;
    std::array<float, 5> row;
    reader.read(state, 1, row.data());
    EXPECT_EQ(row, (std::array<float, 5>{1.5f, 0.5f, 0.75f, 1, 1.5f}));
    reader.read(state, 0, row.data());
    EXPECT_EQ(row[4], -0.5f);
    reader.read(state, -1, row.data());
    EXPECT_EQ(row[4], 0) << "an unknown robot is like the mean of the known ones";
}

}  // namespace
}  // namespace mrose
