// What other programs see of a recording.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/file.h"
#include "recording/body_names.h"
#include "recording/json_text.h"
#include "recording/mcap_walk.h"
#include "recording/recording_fixture.h"

namespace mrose {
namespace {

using Json = nlohmann::json;

/// What of `value` is not as `schema` says, or empty; keys that it does not name count as wrong.
std::string objection(const Json& value, const Json& schema, const std::string& path) {
    if (schema.contains("oneOf")) {
        for (const Json& choice : schema["oneOf"])
            if (choice["const"] == value) return "";
        return path + " is none of the choices";
    }
    const std::string type = schema["type"];
    const bool fits = type == "object"    ? value.is_object()
                      : type == "array"   ? value.is_array()
                      : type == "string"  ? value.is_string()
                      : type == "boolean" ? value.is_boolean()
                      : type == "integer" ? value.is_number_integer()
                                          : type == "number" && value.is_number();
    if (!fits) return path + " is no " + type;
    if (type == "array")
        for (std::size_t i = 0; i < value.size(); ++i)
            if (std::string wrong = objection(value[i], schema["items"], path + '/' + std::to_string(i));
                !wrong.empty())
                return wrong;
    if (type != "object") return "";
    for (const auto& [key, member] : value.items()) {
        if (!schema["properties"].contains(key)) return path + " has an unknown key " + key;
        if (std::string wrong = objection(member, schema["properties"][key], path + '/' + key); !wrong.empty())
            return wrong;
    }
    for (const auto& [key, member] : schema["properties"].items())
        if (!value.contains(key)) return path + " lacks " + key;
    return "";
}

TEST_F(RecordingFile, EveryMessageIsAsItsSchemaSays) {
    const std::string file = *readFile(record());
    const std::map<std::string, Json> schemas = walkSchemas(file);
    std::map<std::string, int> seen;
    for (const WalkedMessage& message : walkMessages(file)) {
        ASSERT_TRUE(schemas.count(message.topic)) << message.topic;
        const Json& schema = schemas.at(message.topic);
        ++seen[schema["title"]];
        const std::string wrong = objection(Json::parse(message.json), schema, message.topic);
        ASSERT_EQ(wrong, "") << message.json;
    }
    EXPECT_EQ(seen.size(), 4u);
}

TEST_F(RecordingFile, OtherProgramsSeeWhereBodiesAre) {
    const std::string file = *readFile(record());
    std::size_t samples = 0;
    for (const WalkedMessage& message : walkMessages(file)) {
        const auto json = nlohmann::json::parse(message.json);
        const bool branch = message.topic.starts_with("/branch_1/");
        if (message.topic != "/tf" && message.topic != "/branch_1/tf") continue;
        ++samples;
        const std::int64_t tick = message.time / 20'000'000;
        const WorldState& state =
            branch ? branchRun.states[static_cast<std::size_t>(tick - 90)] : run.states[static_cast<std::size_t>(tick)];
        ASSERT_EQ(json["transforms"].size(), 10u);
        for (std::size_t body = 0; body < 10; ++body) {
            const auto& transform = json["transforms"][body];
            const Pose& pose = Scenario::poseOf(state, body);
            EXPECT_NEAR(transform["translation"]["x"], pose.x, 5.1e-4);
            EXPECT_NEAR(transform["translation"]["y"], pose.y, 5.1e-4);
            const double heading =
                2 * std::atan2(transform["rotation"]["z"].get<double>(), transform["rotation"]["w"].get<double>());
            EXPECT_NEAR(std::remainder(heading - pose.heading, 2 * std::acos(-1.0)), 0, 1.42e-3);
            EXPECT_EQ(transform["parent_frame_id"], "world");
            const std::string frame = body < 8 ? "rover_" + std::to_string(body + 1) : body == 8 ? "ball" : "crate";
            EXPECT_EQ(transform["child_frame_id"], (branch ? "branch_1/" : "") + frame);
            EXPECT_EQ(transform["timestamp"]["sec"], message.time / 1'000'000'000);
            EXPECT_EQ(transform["timestamp"]["nsec"], message.time % 1'000'000'000);
        }
    }
    EXPECT_EQ(samples, ticks / 5 + 1 + 60 / 5 + 1);
}

TEST_F(RecordingFile, OtherProgramsSeeCommandsContactsAndScene) {
    double pressed = 0, told = 0, onRobots = 0, onRobotsReported = 0;
    std::size_t contacts = 0;
    for (std::size_t i = 0; i < 5 * (ticks / 5); ++i)
        for (const ContactReport& contact : run.traces[i].contacts) {
            pressed += contact.impulse;
            onRobots += contact.impulse * ((contact.bodyA < 8) + (contact.bodyB < 8));
        }
    std::size_t kicks = 0, kicksReported = 0, scenes = 0;
    for (const StepTrace& trace : run.traces) kicks += trace.kicks.size();
    ASSERT_GT(pressed, 0);
    for (const WalkedMessage& message : walkMessages(*readFile(record()))) {
        const auto json = nlohmann::json::parse(message.json);
        if (message.topic == "/contacts") {
            const auto& entity = json["entities"].at(0);
            EXPECT_EQ(entity["metadata"].size(), entity["spheres"].size());
            for (const auto& pair : entity["metadata"]) told += std::stod(pair["value"].get<std::string>());
            contacts += entity["spheres"].size();
        }
        if (message.topic == "/bodies") {
            const std::int64_t tick = message.time / 20'000'000;
            const WorldState& state = run.states[static_cast<std::size_t>(tick)];
            for (int i = 1; i <= 8; ++i)
                onRobotsReported += json["rover_" + std::to_string(i)]["pressed"].get<double>();
            const auto& third = json["rover_3"];
            EXPECT_NEAR(third["v"], state.robots[2].velocity_B.x, 5.1e-4);
            EXPECT_NEAR(third["w"], state.robots[2].velocity_B.rotation, 5.1e-4);
            EXPECT_NEAR(third["heading"], wrapAngle(state.robots[2].pose.heading), 5.1e-4);
            EXPECT_NEAR(third["command_w"], scenario.commandsOf(state, 2).at(message.time).w, 5.1e-4);
        }
        if (message.topic == "/log")
            kicksReported += json["message"].get<std::string>().find("kicks") != std::string::npos;
        if (message.topic == "/scene") {
            ++scenes;
            ASSERT_EQ(json["entities"].size(), 11u);
            EXPECT_EQ(json["entities"][0]["frame_id"], "world");
            EXPECT_EQ(json["entities"][0]["lines"].size(), 4u);
            EXPECT_EQ(json["entities"][1]["frame_id"], "rover_1");
            EXPECT_EQ(json["entities"][1]["triangles"].size(), 1u);
            EXPECT_EQ(json["entities"][2]["cylinders"][0]["size"]["x"], 0.45);
            EXPECT_EQ(json["entities"][9]["spheres"][0]["size"]["z"], 0.22);
        }
    }
    EXPECT_NEAR(told, pressed, 5.1e-2 * static_cast<double>(contacts));
    EXPECT_NEAR(onRobotsReported, onRobots, 5.1e-2 * 8 * ticks / 5);
    EXPECT_EQ(kicksReported, kicks);
    EXPECT_EQ(scenes, 1u);
}

/// Told are samples with contacts, and the one after them, so that their marks go.
TEST_F(RecordingFile, MarksOfContactsGoWhenTheyAreOver) {
    std::map<std::int64_t, std::size_t> expected{{0, 0}};
    bool before = false;
    for (std::size_t sample = 1; sample <= ticks / 5; ++sample) {
        std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> pairs;
        for (std::size_t i = 5 * (sample - 1); i < 5 * sample; ++i)
            for (const ContactReport& c : run.traces[i].contacts) pairs.emplace(c.bodyA, c.bodyB, c.obstacle);
        if (!pairs.empty() || before) expected[static_cast<std::int64_t>(sample) * 100'000'000] = pairs.size();
        before = !pairs.empty();
    }
    std::map<std::int64_t, std::size_t> told;
    for (const WalkedMessage& message : walkMessages(*readFile(record())))
        if (message.topic == "/contacts")
            told[message.time] = Json::parse(message.json)["entities"].at(0)["spheres"].size();
    EXPECT_EQ(told, expected);
    EXPECT_GT(std::count_if(told.begin(), told.end(), [](const auto& t) { return t.second == 0; }), 1);
}

TEST(JsonText, NumbersAreRoundedAndKeepTheirWidth) {
    const auto fixed = [](double value, int decimals) {
        std::string json;
        appendFixed(json, value, decimals);
        return json;
    };
    EXPECT_EQ(fixed(0, 4), "0.0000");
    EXPECT_EQ(fixed(-0.00004, 4), "0.0000");
    EXPECT_EQ(fixed(-0.00006, 4), "-0.0001");
    EXPECT_EQ(fixed(12.3456, 2), "12.35");
    EXPECT_EQ(fixed(-12.5, 3), "-12.500");
    EXPECT_EQ(fixed(100, 3), "100.000");
    EXPECT_EQ(fixed(0.05, 3), "0.050");
    EXPECT_EQ(fixed(7.9, 0), "8");
    EXPECT_EQ(fixed(std::nan(""), 3), "null");
    EXPECT_EQ(fixed(-INFINITY, 3), "null");
    EXPECT_EQ(std::stod(fixed(1e300, 3)), 1e300);
    for (int i = -4000; i < 4000; ++i) {
        const double value = i * 0.37;
        EXPECT_NEAR(std::stod(fixed(value, 3)), value, 5.0001e-4);
    }
}

TEST(JsonText, AnyTextIsJson) {
    const auto quoted = [](std::string_view text) {
        std::string json;
        appendQuoted(json, text);
        return Json::parse(json).get<std::string>();
    };
    EXPECT_EQ(quoted("a\"b\\c\n\x01/"), "a\"b\\c\n\x01/");
    EXPECT_EQ(quoted("\xc3\xa4 \xe2\x82\xac \xf0\x9f\xa4\x96"), "\xc3\xa4 \xe2\x82\xac \xf0\x9f\xa4\x96");
    EXPECT_EQ(quoted("\xff\xc3 a \xed\xa0\x80\xc0\x80"), "?? a ?????");
    for (int a = 0; a < 256; ++a)
        for (int b = 0; b < 256; ++b) quoted(std::string{static_cast<char>(a), static_cast<char>(b), 'x'});
}

TEST(BodyNames, AreUniqueAndPlain) {
    Scene scene;
    scene.robots.resize(5);
    scene.objects.resize(2);
    scene.robots[0].name = "left wing/1";
    scene.robots[1].name = "left_wing 1";
    scene.robots[3].name = "world";
    scene.objects[0].name = "ball";
    EXPECT_EQ(bodyNames(scene), (std::vector<std::string>{"left_wing_1", "left_wing_1_2", "robot", "world_2", "robot_2",
                                                          "ball", "object"}));
}

}  // namespace
}  // namespace mrose
