#include "condition/lua_paths.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mrose {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> pathsOf(std::string_view text) {
    std::vector<std::string> paths;
    for (const LuaPath& path : luaPaths(text)) {
        EXPECT_EQ(text.substr(path.offset, path.text.size()), path.text);
        paths.emplace_back(path.text);
    }
    return paths;
}

TEST(LuaPaths, GoAsFarAsTheyAreFixed) {
    EXPECT_THAT(pathsOf("robot[2].speed > 0.5 and distance(robot[2], ball) < 0.3"),
                ElementsAre("robot[2].speed", "distance", "robot[2]", "ball"));
    EXPECT_THAT(pathsOf("robot[1 + 1].x"), ElementsAre("robot"));
    EXPECT_THAT(pathsOf("robot[tick].x"), ElementsAre("robot", "tick"));
    EXPECT_THAT(pathsOf("robot [ 'a b' ] . x"), ElementsAre("robot [ 'a b' ] . x"));
    EXPECT_THAT(pathsOf("robot[[[a]]].x + robot[=[b]=]"), ElementsAre("robot", "robot"));
    EXPECT_THAT(pathsOf("robot[ [[a]] ].x"), ElementsAre("robot[ [[a]] ].x"));
    EXPECT_THAT(pathsOf("(goals).left"), ElementsAre("goals"));
}

TEST(LuaPaths, HavePartsThatAreNamesAndKeys) {
    const std::string_view text = "1 < robot [ 'a b' ] . x + y";
    std::vector<std::string> parts, upTo;
    for (const LuaPath& path : luaPaths(text))
        for (const LuaPath::Part& part : path.parts) {
            const std::string_view whole = path.text.substr(0, part.end);
            upTo.emplace_back(whole);
            parts.emplace_back(whole.substr(part.begin));
        }
    EXPECT_THAT(upTo, ElementsAre("robot", "robot [ 'a b' ]", "robot [ 'a b' ] . x", "y"));
    EXPECT_THAT(parts, ElementsAre("robot", "'a b' ]", "x", "y"));
}

TEST(LuaPaths, AreNotInTextsCommentsNumbersAndKeys) {
    EXPECT_THAT(pathsOf("'a.b' .. \"c\\\" d\" .. [[e\nf]] .. [==[ g ]] h]==]"), IsEmpty());
    EXPECT_THAT(pathsOf("1 -- a.b\n + x --[[ c \n d ]] + y --[=[ e"), ElementsAre("x", "y"));
    EXPECT_THAT(pathsOf("0xffp-3 + 1e+5 + 3.e2 + .5 + 1e5"), IsEmpty());
    EXPECT_THAT(pathsOf("{x = y, [z] = 1, u == v}"), ElementsAre("y", "z", "u", "v"));
    EXPECT_THAT(pathsOf("a ..b and c:d() or not true"), ElementsAre("a", "b", "c"));
}

TEST(LuaPaths, AreNotToldOfFunctions) { EXPECT_THAT(pathsOf("x and (function(n) return n + y end)(1)"), IsEmpty()); }

/// Any bytes end somewhere: the search runs before or after whatever the reader makes of them.
TEST(LuaPaths, EndOnAnyText) {
    for (const char* const text : {"", "'", "\"\\", "[[", "--[[", "--", "[==", "a.", "a[", "a[1", "1e", ".", "\\"})
        pathsOf(text);
}

}  // namespace
}  // namespace mrose
