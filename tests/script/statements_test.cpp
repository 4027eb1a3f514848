// Statements in the restricted interpreter: run in pieces, from one call that yields to the next.
#include <gtest/gtest.h>
#include <lua.hpp>

#include "script/lua_math.h"
#include "script/lua_sandbox.h"

namespace mrose {
namespace {

class Statements : public testing::Test {
protected:
    Statements() : Statements(LuaLimits{}) {}
    explicit Statements(const LuaLimits& limits) : sandbox_(limits) {
        addMath(sandbox_);
        lua_pushcfunction(sandbox_.state(), [](lua_State* lua) { return lua_yield(lua, lua_gettop(lua)); });
        sandbox_.addName("ask");
    }

    /// Answers each call ask(x) by 10 x; what was asked, and the error's message behind it.
    std::string run(const std::string& text) {
        const auto statements = sandbox_.loadStatements(text, "tour.lua");
        if (!statements) return statements.error().message();
        std::string asked;
        for (int given = 0;;) {
            const auto more = sandbox_.proceed(*statements, given);
            if (!more) asked += more.error().message();
            if (!more || !*more) break;
            const double value = lua_tonumber(statements->thread, 1);
            asked += std::to_string(static_cast<int>(value)) + '@' + std::to_string(sandbox_.lineOf(*statements)) + ' ';
            lua_settop(statements->thread, 0);
            lua_pushnumber(statements->thread, 10 * value);
            given = 1;
        }
        sandbox_.forget(*statements);
        return asked;
    }

    LuaSandbox sandbox_;
};

TEST_F(Statements, AreRunInPiecesThatKeepTheirLocals) {
    EXPECT_EQ(run("local a = ask(1)\nlocal b = ask(a + 1)\nask(a + b)"), "1@1 11@2 120@3 ");
    EXPECT_EQ(run("for i = 1, 3 do\n  ask(i)\nend\n-- done"), "1@2 2@2 3@2 ");
    EXPECT_EQ(run("local function twice(x)\n  return ask(x) + ask(x)\nend\nask(twice(1))"), "1@2 1@2 20@4 ");
    EXPECT_EQ(run(""), "");
}

TEST_F(Statements, SayWhereTheyFail) {
    EXPECT_EQ(run("ask(1)\nlocal x = = 2"), "tour.lua:2:11: unexpected symbol near '='");
    EXPECT_EQ(run("ask(1)\nask(nil + 1)"), "1@1 tour.lua:2: attempt to perform arithmetic on a nil value");
    EXPECT_EQ(run("ask(1)\n\nasc(2)"), "1@1 tour.lua:3: unknown name 'asc'; did you mean ask?");
    EXPECT_EQ(run("x = 1"), "tour.lua:1: names cannot be assigned to");
    EXPECT_EQ(run("if true then"), "tour.lua:1:13: 'end' expected near the end");
}

TEST_F(Statements, ReachNothingOutside) {
    for (const std::string name : {"os", "io", "require", "load", "dofile", "pcall", "coroutine", "setmetatable"})
        EXPECT_EQ(run("local x = " + name).substr(0, 27 + name.size()), "tour.lua:1: unknown name '" + name + '\'');
    EXPECT_EQ(run("\x1bLua"), "tour.lua:1:1: attempt to load a binary chunk (mode is 't')");
}

/// A piece is limited, the number of pieces is not.
TEST_F(Statements, InstructionsAreCountedAnewAfterEachCall) {
    EXPECT_EQ(run("while true do end"), "tour.lua:1: does not end within 10000 instructions");
    EXPECT_EQ(run("ask(1)\nlocal n = 0\nwhile true do\n  n = n + 1\nend").substr(0, 5), "1@1 t");
    EXPECT_EQ(run("for i = 1, 20 do\nfor k = 1, 5000 do end\nif i == 20 then ask(i) end end"),
              "tour.lua:2: does not end within 10000 instructions");
    EXPECT_EQ(run("local n = 0\nfor i = 1, 20 do\nfor k = 1, 5000 do end\nn = ask(i) end\nask(n)").find("tour.lua"),
              std::string::npos);
}

TEST_F(Statements, MemoryIsLimitedOverAllPieces) {
    const std::string limit = "needs more memory than the 1024 KB (64 KB in one piece) that it may use";
    EXPECT_EQ(run("local s = 'x'\nfor i = 1, 60 do\ns = s .. s\nend"), "tour.lua:3: " + limit);
    const std::string hoard =
        "local t = {}\nlocal p = 'x'\nfor i = 1, 11 do p = p .. p end\nfor i = 1, 900 do\nt[i] = p .. ask(i)\nend";
    const std::string asked = run(hoard);
    EXPECT_NE(asked.find("tour.lua:5: " + limit), std::string::npos) << asked.substr(asked.size() - 100);
    EXPECT_EQ(run("ask(2)"), "2@1 ") << "the next text has its memory again";
}

/// Names that come while a text is under way take nothing of what it may use.
TEST_F(Statements, NamesMayComeInBetween) {
    const auto statements = sandbox_.loadStatements("ask(1)\nask(late + 1)", "tour.lua");
    ASSERT_TRUE(statements);
    ASSERT_TRUE(sandbox_.proceed(*statements).value_or(false));
    lua_settop(statements->thread, 0);
    for (int i = 0; i < 3000; ++i) {
        lua_pushstring(sandbox_.state(), (std::string(1000, 'x') + std::to_string(i)).c_str());
        sandbox_.addName(("name" + std::to_string(i)).c_str());
    }
    lua_pushnumber(sandbox_.state(), 41);
    sandbox_.addName("late");
    ASSERT_TRUE(sandbox_.proceed(*statements).value_or(false));
    EXPECT_EQ(lua_tonumber(statements->thread, 1), 42);
    lua_settop(statements->thread, 0);
    EXPECT_FALSE(sandbox_.proceed(*statements).value_or(true));
}

}  // namespace
}  // namespace mrose
