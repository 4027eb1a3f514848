#pragma once

#include <span>

struct lua_State;

namespace mrose {

class LuaSandbox;

/// A function of numbers that texts may call: the same in Lua and out of it.
struct MathFunction {
    const char* name;
    int (*inLua)(lua_State*);
    double (*ofOne)(double);                    ///< nullptr: it takes two
    double (*ofTwo)(double, double) = nullptr;  ///< nullptr: it takes one
    bool ofMore = false;                        ///< it takes any number, from the left
};

/// abs, ceil, floor, sqrt, exp, log, pow, sin, cos, tan, asin, acos, atan (of one or two arguments), deg, rad, wrap,
/// min, max. Angles are radians. All give the same bits on every processor.
std::span<const MathFunction> mathFunctions();

/// Adds these, and pi and huge.
void addMath(LuaSandbox& sandbox);

}  // namespace mrose
