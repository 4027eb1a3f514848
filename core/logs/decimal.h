#pragma once

#include "world/time.h"

namespace mrose {

/// Parses one decimal number that begins at `begin`: `-0.3e-2`, `+1.0`, `.5`, `5.`; never inf, nan or hexadecimal.
/// The result is the double nearest to the text. Returns the first character behind the number, nullptr where there is
/// no number or one that no double can hold.
const char* parseNumber(const char* begin, const char* end, double& value);

/// Numbers of a log lie within this bound: sums and differences of them stay finite.
constexpr double largestNumber = 1e9;

/// The same for an instant in seconds, without passing through a double: the nearest nanosecond, halves away from zero.
/// nullptr also for instants beyond +-latestSecond.
const char* parseInstant(const char* begin, const char* end, Nanoseconds& time);

/// The difference of two instants within this bound cannot overflow; the year 2096.
constexpr std::int64_t latestSecond = 4'000'000'000;

}  // namespace mrose
