#include "script/lua_sandbox.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <lua.hpp>

#include "script/lua_math.h"

namespace mrose {
namespace {

class Sandbox : public testing::Test {
protected:
    Sandbox() {
        addMath(sandbox_);
        sandbox_.addVariable("turn", [](lua_State* lua) {
            lua_pushinteger(lua, 7);
            return 1;
        });
    }

    Expected<LuaValue> value(const std::string& text) {
        const auto expression = sandbox_.load(text, "text");
        if (!expression) return tl::unexpected(expression.error());
        auto result = sandbox_.evaluate(*expression, "text");
        sandbox_.forget(*expression);
        return result;
    }
    double number(const std::string& text) {
        const auto result = value(text);
        EXPECT_TRUE(result) << text << ": " << result.error().message();
        return result && std::holds_alternative<double>(*result) ? std::get<double>(*result) : std::nan("");
    }
    bool truth(const std::string& text) {
        const auto result = value(text);
        EXPECT_TRUE(result && std::holds_alternative<bool>(*result)) << text;
        return result && std::holds_alternative<bool>(*result) && std::get<bool>(*result);
    }
    std::string refusal(const std::string& text) {
        const auto result = value(text);
        EXPECT_FALSE(result) << text << " was not refused";
        return result ? "" : result.error().message();
    }

    LuaSandbox sandbox_;
};

TEST_F(Sandbox, GivesValuesOfAllKinds) {
    EXPECT_EQ(number("1 + 2 * 3"), 7);
    EXPECT_TRUE(truth("not (1 > 2) and 'a' < 'b'"));
    EXPECT_EQ(std::get<std::string>(*value("'a\\0' .. 1")), std::string("a\0", 2) + "1");
    EXPECT_STREQ(std::get<LuaOther>(*value("nil")).type, "nil");
    EXPECT_STREQ(std::get<LuaOther>(*value("sin")).type, "function");
    EXPECT_EQ(number("turn"), 7);
}

TEST_F(Sandbox, MathIsTheStandardLibrarys) {
    for (const double x : {-0.7, 0.2, 0.9}) {
        const std::string in = "(" + std::to_string(x) + ")";
        EXPECT_EQ(number("abs" + in), std::abs(x));
        EXPECT_EQ(number("floor" + in), std::floor(x));
        EXPECT_EQ(number("ceil" + in), std::ceil(x));
        EXPECT_DOUBLE_EQ(number("exp" + in), std::exp(x));
        EXPECT_DOUBLE_EQ(number("sin" + in), std::sin(x));
        EXPECT_DOUBLE_EQ(number("cos" + in), std::cos(x));
        EXPECT_DOUBLE_EQ(number("tan" + in), std::tan(x));
        EXPECT_DOUBLE_EQ(number("asin" + in), std::asin(x));
        EXPECT_DOUBLE_EQ(number("acos" + in), std::acos(x));
        EXPECT_DOUBLE_EQ(number("atan" + in), std::atan(x));
    }
    EXPECT_EQ(number("sqrt(2)"), std::sqrt(2));
    EXPECT_DOUBLE_EQ(number("log(2)"), std::log(2));
    EXPECT_DOUBLE_EQ(number("atan(1, -1)"), std::atan2(1, -1));
    EXPECT_DOUBLE_EQ(number("pow(2, 0.5)"), std::sqrt(2));
    EXPECT_EQ(number("pow(-3, 3)"), -27);
    EXPECT_EQ(number("pi"), std::numbers::pi);
    EXPECT_EQ(number("min(3, -1, 2)"), -1);
    EXPECT_EQ(number("max(3, -1, 9, 2)"), 9);
    EXPECT_EQ(number("-huge"), -INFINITY);
    EXPECT_NEAR(number("deg(pi)"), 180, 1e-12);
    EXPECT_NEAR(number("rad(90)"), std::numbers::pi / 2, 1e-15);
    EXPECT_EQ(refusal("sin()"), "text:1: bad argument #1 to 'sin' (number expected, got no value)");
}

/// Lua multiplies for a square, and leaves other powers to the C library, which differs from processor to processor.
TEST_F(Sandbox, OperatorOfPowersSquaresAlone) {
    EXPECT_EQ(number("3^2"), 9);
    EXPECT_EQ(number("-3 ^ --[[^3]] 2 + #'^3'"), -7);
    const std::string cause = "x^y is there for y = 2 alone; write pow(x, y)";
    EXPECT_EQ(refusal("2^3"), "text:1:2: " + cause);
    EXPECT_EQ(refusal("1 + turn^2.5"), "text:1:9: " + cause);
    EXPECT_EQ(refusal("1 < 2 and\n  3 ^ turn > 1"), "text:2:5: " + cause);
    for (const char* const text : {"2^2^3", "2^-2", "2^20", "2^2.0", "2^(2)", "2^0x2", "turn^'2'", "3^2 + 3^0.5"})
        EXPECT_NE(refusal(text).find(cause), std::string::npos) << text;
    const auto statements = sandbox_.loadStatements("local x = 1\nx = x^3", "script");
    ASSERT_FALSE(statements);
    EXPECT_EQ(statements.error().message(), "script:2:6: " + cause);
}

TEST_F(Sandbox, SyntaxErrorsNameLineAndColumn) {
    EXPECT_EQ(refusal("1 +"), "text:1:4: unexpected symbol near the end");
    EXPECT_EQ(refusal("1 > 2 then"), "text:1:7: the end expected near 'then'");
    EXPECT_EQ(refusal("abs(1"), "text:1:6: ')' expected near the end");
    EXPECT_EQ(refusal("1 <\n2 and\n  * 3"), "text:3:3: unexpected symbol near '*'");
    EXPECT_EQ(refusal("abs(3x)"), "text:1:5: malformed number near '3x'");
    EXPECT_EQ(refusal("1 > 'abc"), "text:1:9: unfinished string near the end");
    EXPECT_EQ(refusal("1 = 2"), "text:1:3: the end expected near '='");
    EXPECT_EQ(refusal(""), "text: is empty; expected an expression");
    EXPECT_EQ(refusal(" \n\t"), "text: is empty; expected an expression");
}

TEST_F(Sandbox, RunningErrorsNameTheLine) {
    EXPECT_EQ(refusal("1 +\nwhere"), "text:2: unknown name 'where'");
    EXPECT_EQ(refusal("(nil).x"), "text:1: attempt to index a nil value");
    EXPECT_EQ(refusal("1 < 'a'"), "text:1: attempt to compare number with string");
    EXPECT_EQ(refusal("1 // 0"), "text:1: attempt to divide by zero");
}

/// Nothing but one expression is read: statements, lists and text that closes the frame around it are refused before
/// anything runs.
TEST_F(Sandbox, OnlyOneExpressionIsAllowed) {
    for (const char* const text :
         {"1) os.exit( (", "1), (2", "1, 2", "1;", "x = 1", "local x = 1", "do end", "return 1", "1 return 2", "-- 1",
          "1 --[[", "1 --[==[ x", "goto a", "1 end", "abs(1) abs(2)", "while true do end", "1\n)\nabs((1"})
        EXPECT_TRUE(refusal(text).starts_with("text:1:") || refusal(text).starts_with("text:2:1:")) << refusal(text);
    EXPECT_EQ(refusal("1, 2"), "text:1:2: is more than one expression");
    EXPECT_EQ(number("1 -- one"), 1);
    EXPECT_EQ(number("1 --[[ one ]]"), 1);
    EXPECT_EQ(number("((1))"), 1);
    EXPECT_STREQ(std::get<LuaOther>(*value("...")).type, "nil");
}

TEST_F(Sandbox, NoLibraryIsThere) {
    for (const std::string name :
         {"load",      "loadstring", "loadfile", "dofile",       "require",      "print",
          "pcall",     "xpcall",     "error",    "assert",       "select",       "type",
          "tostring",  "tonumber",   "next",     "pairs",        "ipairs",       "rawget",
          "rawset",    "rawequal",   "rawlen",   "getmetatable", "setmetatable", "collectgarbage",
          "coroutine", "string",     "table",    "math",         "os",           "io",
          "debug",     "utf8",       "package",  "_G",           "_VERSION",     "random"})
        EXPECT_TRUE(refusal(name).starts_with("text:1: unknown name '" + name + "'")) << name;
    EXPECT_EQ(refusal("sqr(2)"), "text:1: unknown name 'sqr'; did you mean sqrt?");
    EXPECT_EQ(refusal("_ENV._G"), "text:1: unknown name '_G'");
    EXPECT_EQ(refusal("_ENV[1]"), "text:1: unknown name '?'");
}

TEST_F(Sandbox, TextsHaveNoMethods) {
    EXPECT_EQ(refusal("('x'):rep(1e9)"), "text:1: attempt to index a string value (constant 'x')");
    EXPECT_EQ(refusal("('').format"), "text:1: attempt to index a string value (constant '')");
    EXPECT_EQ(refusal("#'abc' + '1'"), "text:1: attempt to perform arithmetic on a string value (constant '1')");
}

TEST_F(Sandbox, BytecodeIsRefused) {
    EXPECT_NE(refusal("\x1bLua").find("unexpected symbol"), std::string::npos);
    EXPECT_EQ(refusal("\x1bLua").find('\x1b'), std::string::npos);
}

TEST_F(Sandbox, EvaluationsThatDoNotEndAreEnded) {
    const std::string limit = "text: does not end within 10000 instructions";
    EXPECT_EQ(refusal("(function() while true do end end)()"), limit);
    EXPECT_EQ(refusal("(function() repeat until false end)()"), limit);
    EXPECT_EQ(refusal("(function() ::a:: goto a end)()"), limit);
    EXPECT_EQ(refusal("(function() for i = 1, huge do end end)()"), limit);
    EXPECT_EQ(refusal("(function(f) return f(f) end)(function(f) return f(f) end)"), limit);
    EXPECT_EQ(number("(function() local n = 0 for i = 1, 1000 do n = n + i end return n end)()"), 500500);
}

TEST_F(Sandbox, MemoryIsLimited) {
    const std::string limit = "text: needs more memory than the 1024 KB (64 KB in one piece) that it may use";
    EXPECT_EQ(refusal("(function() local s = 'x' for i = 1, 60 do s = s .. s end return s end)()"), limit);
    EXPECT_EQ(refusal("(function() local t = {} for i = 1, 9000 do t[i] = i end return t end)()"), limit);
    const std::string piece = "'" + std::string(2000, 'x') + "'";
    EXPECT_EQ(refusal("(function() local t = {} for i = 1, 900 do t[i] = " + piece + " .. i end return t end)()"),
              limit);
    EXPECT_EQ(number("(function() local t = {} for i = 1, 400 do t[i] = " + piece + " .. i end return #t end)()"), 400);
    EXPECT_EQ(refusal("'" + std::string(100'000, 'x') + "'"), limit);
    std::string table = "{";
    for (int i = 0; i < 100'000; ++i) table += "1,";
    EXPECT_EQ(refusal(table + "}"), limit);
}

TEST_F(Sandbox, RecursionIsLimited) {
    const std::string deep = refusal("(function(f) return 1 + f(f) end)(function(f) return 1 + f(f) end)");
    EXPECT_TRUE(deep.find("memory") != std::string::npos || deep.find("stack overflow") != std::string::npos) << deep;
    const std::string nested(300, '(');
    EXPECT_NE(refusal(nested + "1" + std::string(300, ')')).find("overflow"), std::string::npos);
    EXPECT_NE(refusal(std::string(300, '{') + std::string(300, '}')).find("overflow"), std::string::npos);
    std::string chain = "1";
    for (int i = 0; i < 300; ++i) chain += "^1";
    EXPECT_NE(refusal(chain).find("overflow"), std::string::npos);
}

TEST_F(Sandbox, GoesOnAfterEveryRefusal) {
    refusal("(function() while true do end end)()");
    refusal("(function() local s = 'x' for i = 1, 60 do s = s .. s end return s end)()");
    refusal("nonsense");
    for (int i = 0; i < 1000; ++i) ASSERT_EQ(number("1 + 1"), 2);
}

/// What one evaluation does to its names or to its environment does not reach the next.
TEST_F(Sandbox, EvaluationsLeaveNothingBehind) {
    EXPECT_EQ(refusal("(function() x = 1 end)()"), "text:1: names cannot be assigned to");
    EXPECT_EQ(refusal("(function() sin = cos end)()"), "text:1: names cannot be assigned to");
    EXPECT_EQ(refusal("(function() _ENV.sin = cos end)()"), "text:1: names cannot be assigned to");
    EXPECT_EQ(refusal("(function() turn = 1 end)()"), "text:1: names cannot be assigned to");
    const auto expression = sandbox_.load("(function() local one = abs(-1); _ENV = nil; return one end)()", "text");
    ASSERT_TRUE(expression);
    for (int i = 0; i < 3; ++i) {
        const auto result = sandbox_.evaluate(*expression, "text");
        ASSERT_TRUE(result) << result.error().message();
        EXPECT_EQ(std::get<double>(*result), 1);
    }
    EXPECT_EQ(number("sin(0)"), 0);
}

TEST_F(Sandbox, MovesWithItsTexts) {
    const auto expression = sandbox_.load("turn + 1", "text");
    ASSERT_TRUE(expression);
    LuaSandbox other = std::move(sandbox_);
    EXPECT_EQ(std::get<double>(*other.evaluate(*expression, "text")), 8);
    sandbox_ = std::move(other);
    EXPECT_EQ(std::get<double>(*sandbox_.evaluate(*expression, "text")), 8);
}

TEST(SandboxLimits, AreTheCallers) {
    LuaLimits limits;
    limits.instructions = 100;
    LuaSandbox sandbox(limits);
    const auto expression = sandbox.load("(function() for i = 1, 1000 do end return 1 end)()", "text");
    ASSERT_TRUE(expression);
    const auto result = sandbox.evaluate(*expression, "text");
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().message(), "text: does not end within 100 instructions");
}

}  // namespace
}  // namespace mrose
