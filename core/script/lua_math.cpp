#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include <lua.hpp>

#include "geometry/elementary.h"
#include "script/lua_sandbox.h"

namespace mrose {
namespace {

template <double (*function)(double)>
int apply(lua_State* lua) {
    lua_pushnumber(lua, function(luaL_checknumber(lua, 1)));
    return 1;
}

/// The best of the arguments.
template <class Better>
int choose(lua_State* lua) {
    double best = luaL_checknumber(lua, 1);
    for (int i = 2; i <= lua_gettop(lua); ++i) {
        const double value = luaL_checknumber(lua, i);
        if (Better{}(value, best)) best = value;
    }
    lua_pushnumber(lua, best);
    return 1;
}

int applyArcTangent(lua_State* lua) {
    lua_pushnumber(lua, arcTangent(luaL_checknumber(lua, 1), luaL_optnumber(lua, 2, 1)));
    return 1;
}

int applyPower(lua_State* lua) {
    lua_pushnumber(lua, power(luaL_checknumber(lua, 1), luaL_checknumber(lua, 2)));
    return 1;
}

double toDegrees(double radians) { return radians * (180 / std::numbers::pi); }
double toRadians(double degrees) { return degrees * (std::numbers::pi / 180); }

constexpr luaL_Reg functions[] = {
    {"abs", apply<std::abs>},
    {"ceil", apply<std::ceil>},
    {"floor", apply<std::floor>},
    {"sqrt", apply<std::sqrt>},
    {"exp", apply<exponential>},
    {"log", apply<logarithm>},
    {"sin", apply<sine>},
    {"cos", apply<cosine>},
    {"tan", apply<tangent>},
    {"asin", apply<arcSine>},
    {"acos", apply<arcCosine>},
    {"atan", applyArcTangent},
    {"pow", applyPower},
    {"deg", apply<toDegrees>},
    {"rad", apply<toRadians>},
    {"min", choose<std::less<double>>},
    {"max", choose<std::greater<double>>},
};

}  // namespace

void addMath(LuaSandbox& sandbox) {
    lua_State* const lua = sandbox.state();
    for (const luaL_Reg& function : functions) {
        lua_pushcfunction(lua, function.func);
        sandbox.addName(function.name);
    }
    lua_pushnumber(lua, std::numbers::pi);
    sandbox.addName("pi");
    lua_pushnumber(lua, std::numeric_limits<double>::infinity());
    sandbox.addName("huge");
}

}  // namespace mrose
