#pragma once

#include <cmath>
#include <string>

#include "world/command.h"

namespace mrose {

/// Nothing on wheels is meant to be so fast, in m/s and rad/s: a command beyond is a mistake, such as a division by
/// almost nothing, and so is a motion that leads farther in its time. Far beyond, models and contact overflow.
constexpr double absurdSpeed = 1000;

/// Whether a speed is beyond it, by more than rounding, or no number.
inline bool isAbsurd(double speed) { return !(std::abs(speed) <= absurdSpeed * (1 + 1e-9)); }
inline bool isAbsurd(const Command& command) { return isAbsurd(command.v) || isAbsurd(command.w); }

/// What is wrong with a command: "gave a command of 1e+160 m/s; expected at most 1000 m/s". Empty: nothing.
std::string absurdity(const Command& command);

/// The same of one of its speeds, in `unit`: "1e+160 m/s; expected at most 1000 m/s".
std::string absurdity(double speed, const char* unit);

}  // namespace mrose
