// What robots' sensors gave, as other programs see it in a recording.
#include <cstring>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/base64.h"
#include "io/file.h"
#include "recording/mcap_walk.h"
#include "recording/recording_writer.h"
#include "sensing/bumpers.h"
#include "sensing/infrared_ring.h"
#include "sensing/laser.h"
#include "sensing/ranging.h"
#include "sensing/sonar_ring.h"
#include "support/temporary_folder.h"

namespace mrose {
namespace {

using TopicJson = nlohmann::json;

/// A robot with all of them that drives into a wall, and one that a laser sees.
class ReadingTopicsTest : public testing::Test {
protected:
    static ScenarioParts parts() {
        RobotType type = discRobot(0.2);
        Laser::Options fan;
        fan.mount = {0.1, 0.05, 0.2};
        fan.first = -1;
        fan.beams = 5;
        fan.step = 0.5;
        fan.errors.range = 6;
        SonarRing::Options sonars;
        sonars.sonars = {{0.2, 0, 0}, {0, 0.2, 1.5}};
        sonars.cone = 0.3;
        sonars.reflection = 0.4;
        sonars.errors.range = 5;
        InfraredRing::Options infrared;
        infrared.elements = {{0.2, 0, 0}, {0, -0.2, -1.5}};
        infrared.range = 1;
        infrared.beam = 0.2;
        infrared.reference = 0.2;
        type.sensors = {
            std::make_shared<const Laser>(SensorTraits{"laser", 0}, fan),
            std::make_shared<const SonarRing>(SensorTraits{"sonar", 0}, sonars),
            std::make_shared<const InfraredRing>(SensorTraits{"ir", 0}, infrared),
            std::make_shared<const Bumpers>(SensorTraits{"bumper", 0}, std::vector<Bumpers::Segment>{{-1, 2}, {1, 4}})};
        SmallWorld world(wallAhead(3, 2));
        world.robot(type, {0.5, 0, 0}, std::make_shared<const Told>(Command{0.8, 0}), ideal());
        return world.parts();
    }
    void SetUp() override {
        WorldState state = scenario.initialState();
        auto writer = RecordingWriter::create(path, scenario, state);
        ASSERT_TRUE(writer) << writer.error().message();
        StepBuffers buffers;
        for (int k = 0; k < 200; ++k) {
            StepTrace& trace = traces.emplace_back();
            trace.asksUnread = true;
            step(scenario, state, buffers, {}, &trace);
            writer->add(state, trace);
        }
        ASSERT_TRUE(writer->close());
        for (const WalkedMessage& message : walkMessages(*readFile(path)))
            messages[message.topic].emplace_back(message.time, TopicJson::parse(message.json));
    }
    /// The observation of the tick that a message is of.
    const Observation& seen(std::int64_t time) const {
        return traces[static_cast<std::size_t>(time / scenario.scene().tickLength - 1)].robots[0].observation;
    }
    static double secondsOf(const TopicJson& stamp) {
        return stamp["sec"].get<double>() + 1e-9 * stamp["nsec"].get<double>();
    }
    /// x, y, z and the last number of each point.
    static std::vector<std::array<float, 4>> pointsOf(const TopicJson& cloud) {
        EXPECT_EQ(cloud["point_stride"], 16);
        const std::string bytes = *fromBase64(cloud["data"].get<std::string>());
        std::vector<std::array<float, 4>> points(bytes.size() / 16);
        EXPECT_EQ(bytes.size() % 16, 0u);
        std::memcpy(points.data(), bytes.data(), bytes.size());
        return points;
    }

    const Scenario scenario{parts()};
    TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "sensors.mcap";
    std::vector<StepTrace> traces;
    std::map<std::string, std::vector<std::pair<std::int64_t, TopicJson>>> messages;
};

TEST_F(ReadingTopicsTest, LasersAreFoxglovesScans) {
    const auto& scans = messages["/1/laser"];
    const auto periods = 200 * scenario.scene().tickLength / 100'000'000;
    EXPECT_GE(static_cast<std::int64_t>(scans.size()), periods - 1);
    EXPECT_LE(static_cast<std::int64_t>(scans.size()), periods + 1);
    int hits = 0, misses = 0;
    for (const auto& [time, scan] : scans) {
        EXPECT_EQ(scan["frame_id"], "1");
        EXPECT_EQ(scan["pose"]["position"]["x"], 0.1);
        EXPECT_EQ(scan["pose"]["position"]["y"], 0.05);
        EXPECT_EQ(scan["pose"]["orientation"]["w"], 1);
        EXPECT_NEAR(scan["start_angle"], -0.8, 1e-6);
        EXPECT_NEAR(scan["end_angle"], 1.2, 1e-6);
        const Reading* const reading = seen(time).find("laser");
        ASSERT_NE(reading, nullptr);
        EXPECT_NEAR(secondsOf(scan["timestamp"]), toSeconds(reading->measured), 1e-9);
        const auto echoes = seen(time).records<RangeEcho>(reading);
        ASSERT_EQ(scan["ranges"].size(), echoes.size());
        for (std::size_t i = 0; i < echoes.size(); ++i) {
            const bool hit = std::isfinite(echoes[i].range);
            EXPECT_NEAR(scan["ranges"][i], hit ? echoes[i].range : 0, 5.1e-4);
            ++(hit ? hits : misses);
        }
    }
    EXPECT_GT(hits, 10);
    EXPECT_GT(misses, 10);
}

TEST_F(ReadingTopicsTest, EchoesAndIntensitiesArePoints) {
    for (const auto& [time, cloud] : messages["/1/sonar"]) {
        EXPECT_EQ(cloud["fields"][3]["name"], "range");
        const auto echoes = seen(time).records<RangeEcho>("sonar");
        const auto points = pointsOf(cloud);
        ASSERT_EQ(points.size(), std::isfinite(echoes[0].range) ? 1u : 0u) << "nothing is at its side";
        if (points.empty()) continue;
        EXPECT_NEAR(points[0][0], 0.2 + echoes[0].range, 1e-5);
        EXPECT_NEAR(points[0][1], 0, 1e-6);
        EXPECT_NEAR(points[0][3], echoes[0].range, 1e-5);
    }
    EXPECT_GT(messages["/1/sonar"].size(), 10u);
    for (const auto& [time, cloud] : messages["/1/ir"]) {
        EXPECT_EQ(cloud["fields"][3]["name"], "intensity");
        const auto echoes = seen(time).records<InfraredEcho>("ir");
        const auto points = pointsOf(cloud);
        ASSERT_EQ(points.size(), 2u);
        EXPECT_FLOAT_EQ(points[1][1], -0.2F);
        for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(points[i][3], echoes[i].intensity, 1e-6);
    }
    EXPECT_GT(messages["/1/ir"].size(), 10u);
}

TEST_F(ReadingTopicsTest, OthersAreTheNumbersOfTheirRecords) {
    int pressed = 0;
    for (const auto& [time, reading] : messages["/1/bumper"]) {
        const auto contacts = seen(time).records<BumperContact>("bumper");
        ASSERT_EQ(reading["records"].size(), contacts.size());
        for (std::size_t i = 0; i < contacts.size(); ++i) {
            EXPECT_NEAR(reading["records"][i]["bearing"], contacts[i].bearing, 5.1e-5);
            EXPECT_EQ(reading["records"][i]["pressed"], contacts[i].pressed);
            EXPECT_EQ(reading["records"][i]["touches"], contacts[i].touches);
            pressed += static_cast<int>(contacts[i].pressed);
        }
    }
    EXPECT_GT(pressed, 0) << "it drove into the wall";
}

}  // namespace
}  // namespace mrose
