// The catalogue in itself: names, units, what fits whom, what parts of robots offer.
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "condition/condition.h"
#include "drawing/markup.h"
#include "quantities/part.h"
#include "simulation/small_world.h"
#include "support/shipped.h"
#include "support/values_at.h"

namespace mrose {
namespace {

using testing::HasSubstr;
using Of = Quantity::Of;

bool ofRobot(const Quantity& quantity) { return quantity.isOfBody() && quantity.of != Of::object; }
bool ofObject(const Quantity& quantity) { return quantity.of == Of::object || quantity.of == Of::body; }
bool ofWorld(const Quantity& quantity) { return !quantity.isOfBody(); }

/// Functions of bodies and variables are names of one kind.
TEST(Catalogue, NamesAreUniqueAmongWhatIsAskedOfTheSameThing) {
    for (const auto is : {ofRobot, ofObject}) {
        std::set<std::string> names;
        for (const Quantity& quantity : quantities())
            if (is(quantity)) {
                EXPECT_TRUE(names.insert(quantity.name).second) << quantity.name;
            }
        EXPECT_FALSE(names.contains("controller")) << "which is a part";
    }
    std::set<std::string> names{"robot", "person", "object", "ball", "wall", "wrap"};
    for (const Quantity& quantity : quantities())
        if (ofWorld(quantity)) {
            EXPECT_TRUE(names.insert(quantity.name).second) << quantity.name;
        }
    EXPECT_GT(quantities().size(), 60u);
}

/// One name has one unit, whatever has it, and one unit is written in one way.
TEST(Catalogue, UnitsAreThoseOfTheSystem) {
    const std::set<std::string> known{"", "s", "m", "m/s", "rad", "rad/s", "N s"};
    std::map<std::string, std::string> units;
    for (const Quantity& quantity : quantities()) {
        SCOPED_TRACE(quantity.name);
        EXPECT_TRUE(known.contains(quantity.unit.name));
        EXPECT_EQ(units.emplace(quantity.name, quantity.unit.name).first->second, quantity.unit.name);
        EXPECT_EQ(quantity.unit.isAngle(), std::string(quantity.unit.shown()) == "\u00b0");
        EXPECT_GT(std::string(quantity.what).size(), 3u);
        EXPECT_LT(std::string(quantity.what).size(), 90u);
        EXPECT_EQ(quantity.of == Of::items, quantity.items != nullptr);
    }
}

/// Those of the first version, which scripts and batches of users have: written here, not read from the catalogue.
TEST(Catalogue, NamesOfTheFirstConditionsStay) {
    const Scenario scenario = shippedScenario("soccer");
    const RealRobots real;
    for (const std::string of : {"x", "y", "heading", "v", "w", "speed", "command_v", "command_w", "error",
                                 "heading_error", "real_x", "real_y", "real_heading"})
        for (const std::string robot : {"robot[1].", "robot['red 2']."})
            EXPECT_TRUE(compileWorldValue(robot + of, scenario, "", &real)) << of;
    for (const std::string of : {"x", "y", "heading", "vx", "vy", "w", "speed"})
        for (const std::string object : {"ball.", "object[1].", "object.ball."})
            EXPECT_TRUE(compileWorldValue(object + of, scenario)) << of;
    for (const char* truth : {"robot[1].touching", "robot[1].kicked", "ball.touching", "touching(robot[1], ball)",
                              "touching(wall, robot[2])"})
        EXPECT_TRUE(compileCondition(truth, scenario)) << truth;
    for (const char* number : {"time", "tick", "seed", "goals[1]", "goals[2]", "#goals", "#robot", "#person", "#object",
                               "distance(robot[1], ball)", "bearing(robot[1], robot[2])", "wrap(7)", "deg(pi)"})
        EXPECT_TRUE(compileWorldValue(number, scenario)) << number;
    const Scenario corridor = shippedScenario("b21_corridor");
    for (const std::string of : {"x", "y", "heading", "v", "w", "speed", "command_v", "command_w"})
        EXPECT_TRUE(compileWorldValue("person[1]." + of, corridor)) << of;
}

TEST(Catalogue, SaysWhatThereIsWhereSomethingIsNot) {
    const Scenario scenario = shippedScenario("soccer");
    const auto refused = [&](const ValueKey& key) {
        const auto value = boundValue(scenario, key);
        return value ? "" : value.error().cause;
    };
    EXPECT_THAT(refused({"command", "red 2"}), HasSubstr("there is no command of red 2; of red 2 there are command_"));
    EXPECT_THAT(refused({"direction", "red 2"}), HasSubstr("there is no direction of red 2"));
    EXPECT_THAT(refused({"x", "green 2"}), HasSubstr("there are red 2, "));
    EXPECT_THAT(refused({"distance", "red 2", "bal"}), HasSubstr("there is no distance of red 2"));
    EXPECT_THAT(refused({"distance", "red 2", "wall"}), HasSubstr("there is no distance"));
    EXPECT_EQ(refused({"touching", "red 2", "wall"}), "");
    EXPECT_EQ(refused({"time"}), "");
}

/// Explains numbers with units and a text.
class Explaining final : public Controller {
public:
    std::size_t memorySize() const override { return 8; }
    void decide(const Observation&, std::span<std::byte> memory, Decision& decision) const override {
        as<std::int64_t>(memory) += 1;
        decision.annotations.push_back(
            {Annotation::Kind::value, "count (s)", double(as<std::int64_t>(memory)), {}, {}});
        decision.annotations.push_back({Annotation::Kind::text, "mood", 0, "good", {}});
        decision.annotations.push_back({Annotation::Kind::point, "goal", 0, {}, {{3, 4}}});
    }
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override {
        const auto asked = as<std::int64_t>(memory);
        entries.add("asked", double(asked));
        entries.add("turn", 0.5 * double(asked), "rad");
        entries.add("mode", "searching");
    }
};

/// What a part of a robot explains is in the catalogue under its own names, with no line there.
TEST(Catalogue, HasWhatPartsOffer) {
    const Scenario scenario =
        SmallWorld().robot(discRobot(), {}, std::make_shared<const Explaining>(), ideal()).scenario();
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    std::vector<RobotInsight> insights(1);
    for (int i = 0; i < 30; ++i) {
        const std::vector<std::byte> before = state.memory;
        step(scenario, state, buffers, {}, &trace);
        noteInsights(scenario, trace, state.tick, before, insights);
    }
    const double asked =
        static_cast<double>(as<std::int64_t>(std::as_const(scenario).memoryOf(std::as_const(state), 0)));
    ASSERT_GT(asked, 3);
    const Moment moment{&scenario, &state, &trace, insights};
    const auto read = [&](const std::string& text) {
        auto value = compileWorldValue(text, scenario);
        EXPECT_TRUE(value) << value.error().message();
        return value->value(moment).value_or(-1);
    };
    EXPECT_EQ(read("robot[1].controller.asked"), asked);
    EXPECT_EQ(read("robot[1].controller.turn"), 0.5 * asked);
    EXPECT_EQ(read("robot[1].controller.mode == 'searching'"), 1);
    EXPECT_EQ(read("robot[1].note.count"), asked);
    EXPECT_EQ(read("robot[1].note['count (s)']"), asked);
    EXPECT_EQ(read("robot[1].note.mood == 'good'"), 1);
    EXPECT_EQ(read("robot[1].note_x.goal + robot[1].note_y.goal"), 7);
    EXPECT_TRUE(std::isnan(read("robot[1].note.other")));
    const auto turn = boundValue(scenario, {"controller", "1", "turn", "rad"});
    ASSERT_TRUE(turn);
    EXPECT_EQ(turn->shownUnit(), "\u00b0");
    EXPECT_EQ(turn->shownNumber(moment), inDegrees(0.5 * asked));
    std::set<std::string> offered;
    for (const ValueKey& key : valuesAt(moment))
        if (key.quantity == "controller") offered.insert(key.of);
    EXPECT_EQ(offered, (std::set<std::string>{"asked", "turn", "mode"}));
    // What was seen and decided was not recorded: that is said, and nothing old is given.
    auto unknown = compileWorldValue("robot[1].note.count", scenario);
    EXPECT_THAT(unknown->value({&scenario, &state, &trace}).error().cause, HasSubstr("is not known here"));
    EXPECT_TRUE(readsControl("robot[1].note.count > 2", scenario));
    EXPECT_TRUE(readsControl("robot[1]['controller'].asked > 2", scenario));
    EXPECT_FALSE(readsControl("robot[1].x > 2", scenario));
}

/// An entry that is asked for alone is made in another way than all of them at once.
TEST(Catalogue, EachEntryOfAPartIsTheSameAlone) {
    for (const char* const name : {"soccer", "four_against_four", "navigation_team", "b21_corridor"}) {
        const Scenario scenario = shippedScenario(name);
        WorldState state = scenario.initialState();
        StepBuffers buffers;
        StepTrace trace;
        std::vector<RobotInsight> insights(state.robots.size());
        for (int i = 0; i < 100; ++i) {
            const std::vector<std::byte> before = state.memory;
            step(scenario, state, buffers, {}, &trace);
            noteInsights(scenario, trace, state.tick, before, insights);
        }
        const Moment moment{&scenario, &state, &trace, insights};
        std::size_t count = 0;
        for (std::size_t body = 0; body < scenario.scene().bodyCount(); ++body)
            for (std::size_t part = 0; part < partNames(scenario, body).size(); ++part) {
                std::set<std::string> names;
                for (const MemoryEntry& expected : partEntries(moment, body, part)) {
                    SCOPED_TRACE(cat(name, ": ", nameOfBody(scenario.scene(), static_cast<std::uint32_t>(body)), " ",
                                     partNames(scenario, body)[part], " ", expected.name));
                    EXPECT_TRUE(names.insert(expected.name).second);
                    MemoryEntries alone(expected.name);
                    addPartEntries(moment, body, part, alone);
                    ASSERT_EQ(alone.all().size(), 1u);
                    const MemoryEntry& entry = alone.all().front();
                    EXPECT_EQ(std::tie(entry.name, entry.unit, entry.text),
                              std::tie(expected.name, expected.unit, expected.text));
                    EXPECT_TRUE(entry.value == expected.value ||
                                (std::isnan(entry.value) && std::isnan(expected.value)));
                    ++count;
                }
            }
        EXPECT_GT(count, 50u) << name;
    }
}

}  // namespace
}  // namespace mrose
