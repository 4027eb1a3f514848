// Without Lua an expression gives what it gives with it.
#include "condition/plain_expression.h"

#include <bit>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "condition/condition.h"
#include "quantities/part.h"
#include "simulation/small_world.h"

namespace mrose {
namespace {

/// Drives, and counts how often it was asked.
class Counting final : public Controller {
public:
    std::size_t memorySize() const override { return sizeof(std::int64_t); }
    void decide(const Observation& /*observation*/, std::span<std::byte> memory, Decision& decision) const override {
        ++as<std::int64_t>(memory);
        decision.command = Command{0.6, 0.1};
    }
    void explain(std::span<const std::byte> memory, MemoryEntries& entries) const override {
        const auto asked = as<std::int64_t>(memory);
        entries.add("asked", static_cast<double>(asked));
        entries.add("state", asked > 2 ? "on the way" : "begins");
        if (asked > 2) entries.add("late", 1.5);
    }
};

Scenario robotsAndBall() {
    Environment environment = walledField(10, 6);
    environment.goals = {{"2", {{0, 2}, {1, 2}, {1, 3}, {0, 3}}}, {"right", {{9, 2}, {10, 2}, {10, 3}, {9, 3}}}};
    SmallWorld world(environment);
    world.robot(squareRobot(), {2, 3, 0}, std::make_shared<Counting>(), ideal())
        .robot(squareRobot(), {3.5, 3, 3.1}, std::make_shared<Told>(Command{0.4, 0}), ideal())
        .object(ballType(), {5, 1, 0}, {-1, 0.2, 0});
    return world.scenario();
}

class PlainExpressions : public testing::Test {
protected:
    PlainExpressions() : scenario_(robotsAndBall()), state_(scenario_.initialState()) {}

    Moment moment() const { return {&scenario_, &state_, &trace_, {}, nullptr, &drawn_}; }
    void runTicks(int ticks) {
        for (int i = 0; i < ticks; ++i) step(scenario_, state_, buffers_, {}, &trace_);
    }
    std::optional<PlainExpression> read(std::string_view text) const {
        return PlainExpression::read(text, moment(), [](std::string_view path) -> std::optional<std::uint32_t> {
            if (path == "robot[1]") return 0;
            if (path == "robot[2]") return 1;
            if (path == "ball") return 2;
            return path == "wall" ? std::optional(noBody) : std::nullopt;
        });
    }
    /// A number, or why there is none.
    std::string given(const Expected<double>& value) const {
        if (!value) return value.error().cause;
        if (std::isnan(*value)) return "nan";
        return std::to_string(std::bit_cast<std::uint64_t>(*value));
    }
    std::string compiledAndGiven(const std::string& text) const {
        auto value = compileWorldValue(text, scenario_, "expression", nullptr, &drawn_);
        return value ? given(value->value(moment())) : value.error().cause;
    }
    /// Texts that define functions are left to Lua.
    std::string byLua(const std::string& text) const {
        return compiledAndGiven("(function() return " + text + " end)()");
    }

    Scenario scenario_;
    WorldState state_;
    StepBuffers buffers_;
    StepTrace trace_;
    DrawnValues drawn_{{"speed", 0.4}, {"count", 3}, {"wide", true}, {"narrow", false}, {"zero", 0}};
};

TEST_F(PlainExpressions, AreArithmeticAndComparisonsOfWhatIsKnown) {
    for (const char* text : {"time > 3 and robot[1].x < 2.5 or not ball.touching", "-robot[1].heading^2 * 2 / 3 - 1",
                             "min(4.5 - abs(ball.x), 2.5 - abs(ball.y), draw.speed) >= 0.41", "draw.wide == true",
                             "touching(robot[1], wall) and not touching(wall, robot[2])", "goals.right + goals[1] >= 1",
                             "distance(robot[1], ball) ~= huge", "atan(1) + atan(1, 2) + pow(2, 3) + wrap(7)",
                             "robot[1]['x'] <= .5e1 -- and a comment"})
        EXPECT_TRUE(read(text)) << text;
}

/// Of numbers and texts that parts of robots remember.
TEST_F(PlainExpressions, ReadMemories) {
    for (const char* text : {"robot[1].motion.unperturbed_v", "robot[1].controller.phase == 'driving'",
                             "not (robot[1].note.state ~= \"resting\")"})
        EXPECT_TRUE(read(text)) << text;
    for (const char* text :
         {"'driving' == robot[1].controller.phase", "robot[1].controller.phase < 'a'",
          "robot[1].controller.phase == 'a\\'b'", "robot[1].gearbox.phase == 'driving'", "robot[1].x == 'a'",
          "robot[1].controller['a\\65'] > 1", "robot[1].controller[ [[a]] ] > 1", "robot[1].controller == 'a'"})
        EXPECT_FALSE(read(text)) << text;
}

TEST_F(PlainExpressions, SayOfMemoriesWhatLuaSays) {
    for (const int ticks : {0, 1, 30}) {
        runTicks(ticks);
        for (const char* text :
             {"robot[1].controller.asked", "robot[1].controller.asked * 2 > 5", "robot[1].controller.state == 'begins'",
              "robot[1].controller.state ~= \"begins\"", "robot[1].controller['state'] == 'on the way'",
              "robot[1].controller['state '] == 'begins'", "robot[1].controller['asked]'] == robot[1].controller.asked",
              "not robot[1].controller.state == 'begins'", "robot[1].controller.asked == 'begins'",
              "robot[1].controller.late", "robot[1].controller.late ~= 'begins'", "robot[1].controller.never > 0",
              "robot[1].controller.state + 1", "robot[2].controller.asked == robot[2].controller.asked",
              "robot[1].sight.robots > 0", "robot[1].sight.robotz > 0", "robot[1].motion.never or 3"})
            EXPECT_EQ(compiledAndGiven(text), byLua(text)) << text << " after " << state_.tick;
    }
    EXPECT_EQ(compiledAndGiven("robot[1].controller.state == 'on the way' and robot[1].controller.late == 1.5"),
              std::to_string(std::bit_cast<std::uint64_t>(1.0)));
}

/// Of a robot of another type, whose sensors are others or come in another order.
TEST_F(PlainExpressions, KnowWhosePartThePlaceIs) {
    const std::vector<std::string> parts = partNames(scenario_, 0);
    ASSERT_GT(parts.size(), firstSensorPart) << "controller, motion, and what every robot senses by";
    for (std::size_t i = 0; i < parts.size() + 2; ++i)
        for (const std::string& name : parts)
            EXPECT_EQ(isPartNamed(scenario_, 0, i, name), i < parts.size() && parts[i] == name) << name << i;
    EXPECT_FALSE(isPartNamed(scenario_, 2, 0, "motion")) << "a ball that remembers nothing";
}

TEST_F(PlainExpressions, LeaveTheRestToLua) {
    for (const char* text : {"#robot > 1",
                             "'a' < 'b'",
                             "7 // 2 == 3",
                             "7 % 4",
                             "1 << 2",
                             "1 < < 2",
                             "time ..",
                             "robot[1 + 1].x > 1",
                             "nil",
                             "(function() return 1 end)()",
                             "0x10 > 1",

                             "robot[1] == robot[2]",
                             "sin",
                             "sin(1, 2)",
                             "pow(2)",
                             "min()",
                             "atan(1, 2, 3)",
                             "touching(robot[1], 3)",
                             "distance(robot[1], wall)",
                             "wall.x",
                             "seen_x(ball, robot[1])",
                             "{1} == 1",
                             "goals.left == 1",
                             "1 & 1",
                             "~1",
                             "unknown > 1",
                             "9007199254740993 > 1",
                             "robot[1].x.y",
                             "(1",
                             ""})
        EXPECT_FALSE(read(text)) << text;
}

TEST_F(PlainExpressions, ThatAreVeryLargeAreLuas) {
    std::string sum = "1", nested = "1";
    for (int i = 0; i < 400; ++i) sum += " + 1";
    for (int i = 0; i < 150; ++i) nested = "(" + nested + ")";
    EXPECT_FALSE(read(sum));
    EXPECT_FALSE(read(nested));
}

TEST_F(PlainExpressions, KnowWhatTypesLuaHas) {
    runTicks(11);
    for (const char* text : {"true + 1",
                             "true < 1",
                             "true == 1",
                             "not 0",
                             "0 and 5",
                             "false or 7",
                             "1 / 0",
                             "-0 * 1.0",
                             "1 / -0",
                             "1 / -0.0",
                             "1 / (0 * -1)",
                             "3 - 3 == 0",
                             "0/0 == 0/0",
                             "draw.wide and 0/0 or 3",
                             "draw.narrow or draw.zero",
                             "1 / (draw.zero * -1)",
                             "draw.count / 2",
                             "tick * tick",
                             "tick / 4 - seed",
                             "4503599627370497 * 4503599627370497",
                             "9007199254740991 + 1",
                             "1e300 * 1e10",
                             "not not draw.narrow",
                             "-draw.wide",
                             "abs(draw.wide)",
                             "min(draw.zero)",
                             "1 < 2 == true",
                             "1 < 2 < 3",
                             "2 - 3 - 4",
                             "2 / 4 / 8",
                             "-2^2",
                             "not 1 == 2",
                             "goals[1] + goals['2']"})
        EXPECT_EQ(compiledAndGiven(text), byLua(text)) << text;
}

/// At another moment than that for which it was read a value may be of another type.
TEST_F(PlainExpressions, AskLuaWhereValuesAreOfAnotherType) {
    auto value = compileWorldValue("draw.speed * 2", scenario_, "expression", nullptr, &drawn_);
    ASSERT_TRUE(value);
    EXPECT_EQ(*value->value(moment()), 0.8);
    drawn_ = {{"wide", true}, {"speed", 0.5}};
    EXPECT_EQ(*value->value(moment()), 1.0) << "by its name, wherever it is";
    drawn_ = {{"speed", "fast"}};
    EXPECT_EQ(value->value(moment()).error().message(),
              "expression:1: attempt to perform arithmetic on a string value (field 'speed')");
    drawn_ = {};
    EXPECT_EQ(value->value(moment()).error().message(), "expression:1: there is no draw 'speed': there is none");
}

/// Random ones, right and wrong.
class Writer {
public:
    std::string write(int depth) {
        const auto inner = [&] { return write(depth - 1); };
        switch (depth > 0 ? number(12) : number(2)) {
            case 0:
                return oneOf({"time", "tick", "robot[1].x", "robot[2].heading", "ball.vx", "ball.touching",
                              "draw.speed", "draw.count", "draw.wide", "draw.narrow", "goals[2]", "robot[1].command_w",
                              "pi", "distance(robot[1], ball)", "touching(robot[1], robot[2])",
                              "bearing(robot[2], ball)"});
            case 1:
                return oneOf(
                    {"0", "1", "2", "7", "0.5", "1e3", "3.0", "true", "false", " -1", " -0.0", "9007199254740991"});
            case 2:
            case 3:
                return inner() + oneOf({" + ", " - ", " * ", "/", " // ", "%"}) + inner();
            case 4:
                return "(" + inner() + oneOf({" < ", " <= ", "> ", ">=", "==", " ~= "}) + inner() + ")";
            case 5:
                return inner() + oneOf({" and ", " or "}) + inner();
            case 6:
                return oneOf({"not ", " -", " - -"}) + inner();
            case 7:
                return "(" + inner() + ")^2";
            case 8:
                return oneOf({"abs", "sqrt", "sin", "floor", "atan", "wrap", "deg", "exp", "log"}) + "(" + inner() +
                       ")";
            case 9:
                return oneOf({"min", "max", "atan", "pow"}) + "(" + inner() + ", " + inner() + ")";
            case 10:
                return "max(" + inner() + "," + inner() + "," + inner() + ")";
            default:
                return "(" + inner() + ")";
        }
    }

private:
    std::size_t number(std::size_t below) { return random_() % below; }
    std::string oneOf(const std::vector<std::string>& texts) { return texts[number(texts.size())]; }

    std::mt19937 random_{7};
};

TEST_F(PlainExpressions, GiveWhatLuaGives) {
    runTicks(20);
    Writer writer;
    int plain = 0, errors = 0;
    constexpr int texts = 1500;
    for (int i = 0; i < texts; ++i) {
        const std::string text = writer.write(1 + i % 4);
        const std::string expected = byLua(text);
        EXPECT_EQ(compiledAndGiven(text), expected) << text;
        plain += read(text) && read(text)->evaluate(moment());
        errors += expected.find(' ') != std::string::npos;
    }
    EXPECT_GT(plain, texts / 3);
    EXPECT_GT(errors, texts / 20);
}

}  // namespace
}  // namespace mrose
