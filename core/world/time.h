#pragma once

#include <cmath>
#include <cstdint>

namespace mrose {

/// Instants and durations in integer nanoseconds: real logs and the simulated world share one exact clock. Instants of
/// logs count from 1970, those of the world from its start.
using Nanoseconds = std::int64_t;

constexpr Nanoseconds nanosecondsPerSecond = 1'000'000'000;

/// The nearest nanosecond; `seconds` must be finite and within +-292 years.
inline Nanoseconds fromSeconds(double seconds) { return std::llround(seconds * 1e9); }
constexpr double toSeconds(Nanoseconds duration) { return static_cast<double>(duration) * 1e-9; }

/// Instants that a file gives lie within +- this: differences of them do not overflow.
constexpr Nanoseconds latestTime = Nanoseconds{1} << 61;

}  // namespace mrose
