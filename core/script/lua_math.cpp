#include "script/lua_math.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <lua.hpp>

#include "geometry/elementary.h"
#include "geometry/pose.h"
#include "script/lua_sandbox.h"

namespace mrose {
namespace {

template <double (*function)(double)>
int applyToOne(lua_State* lua) {
    lua_pushnumber(lua, function(luaL_checknumber(lua, 1)));
    return 1;
}

template <double (*function)(double, double)>
int applyToTwo(lua_State* lua) {
    lua_pushnumber(lua, function(luaL_checknumber(lua, 1), luaL_checknumber(lua, 2)));
    return 1;
}

template <double (*function)(double, double)>
int applyToAll(lua_State* lua) {
    double result = luaL_checknumber(lua, 1);
    for (int i = 2; i <= lua_gettop(lua); ++i) result = function(result, luaL_checknumber(lua, i));
    lua_pushnumber(lua, result);
    return 1;
}

int applyArcTangent(lua_State* lua) {
    lua_pushnumber(lua, arcTangent(luaL_checknumber(lua, 1), luaL_optnumber(lua, 2, 1)));
    return 1;
}

double slopeAngle(double slope) { return arcTangent(slope, 1); }
double toDegrees(double radians) { return radians * (180 / std::numbers::pi); }
double toRadians(double degrees) { return degrees * (std::numbers::pi / 180); }
double itself(double x) { return x; }
double lesser(double a, double b) { return b < a ? b : a; }
double greater(double a, double b) { return b > a ? b : a; }

template <double (*function)(double)>
constexpr MathFunction ofOne(const char* name) {
    return {name, applyToOne<function>, function};
}
template <double (*function)(double, double)>
constexpr MathFunction ofAll(const char* name) {
    return {name, applyToAll<function>, itself, function, true};
}

constexpr MathFunction functions[] = {
    ofOne<std::abs>("abs"),
    ofOne<std::ceil>("ceil"),
    ofOne<std::floor>("floor"),
    ofOne<std::sqrt>("sqrt"),
    ofOne<exponential>("exp"),
    ofOne<logarithm>("log"),
    ofOne<sine>("sin"),
    ofOne<cosine>("cos"),
    ofOne<tangent>("tan"),
    ofOne<arcSine>("asin"),
    ofOne<arcCosine>("acos"),
    {"atan", applyArcTangent, slopeAngle, arcTangent},
    {"pow", applyToTwo<power>, nullptr, power},
    ofOne<toDegrees>("deg"),
    ofOne<toRadians>("rad"),
    ofOne<wrapAngle>("wrap"),
    ofAll<lesser>("min"),
    ofAll<greater>("max"),
};

}  // namespace

std::span<const MathFunction> mathFunctions() { return functions; }

void addMath(LuaSandbox& sandbox) {
    lua_State* const lua = sandbox.state();
    for (const MathFunction& function : functions) {
        lua_pushcfunction(lua, function.inLua);
        sandbox.addName(function.name);
    }
    lua_pushnumber(lua, std::numbers::pi);
    sandbox.addName("pi");
    lua_pushnumber(lua, std::numeric_limits<double>::infinity());
    sandbox.addName("huge");
}

}  // namespace mrose
