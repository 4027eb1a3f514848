#pragma once

#include <numbers>

#include "world/time.h"

namespace mrose {

constexpr Nanoseconds ms = 1'000'000, second = nanosecondsPerSecond;
constexpr double pi = std::numbers::pi, degree = pi / 180;

}  // namespace mrose
