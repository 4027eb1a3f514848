#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "io/error.h"
#include "quantities/value_key.h"

namespace mrose {

/// A number that changes with time. read() gives no number (NaN) where nothing is known.
struct PlottedValue {
    std::string name;  ///< "red 1  speed"
    std::string unit;  ///< "m/s"; empty: it has none
    int decimals = 3;
    bool angle = false;                     ///< degrees that go round from 180 to -180
    std::optional<std::uint32_t> colourOf;  ///< which robot's colour it has: Scene::placeOf()
    std::function<double(const Moment&)> read;
};

/// The quantity whose `of` is a Lua expression over the world (core/condition/README.md).
inline constexpr const char* expressionQuantity = "expression";

/// Of a robot that really drove: how far it is off, and how far an overlaid motion model, which `of` names.
inline constexpr const char *positionErrorQuantity = "error", *headingErrorQuantity = "heading_error",
                            *modelPositionErrorQuantity = "model_error",
                            *modelHeadingErrorQuantity = "model_heading_error";

/// Error: there is no such quantity or body; what is wrong with the expression. read() is for one thread at a time, and
/// for scenarios with the same bodies.
Expected<PlottedValue> plottedValue(const Scenario& scenario, const ValueKey& key);

/// Whether it is one of those errors, which are never below zero.
bool isError(const ValueKey& key);

/// Whether a number depends on the real log.
bool readsReality(const ValueKey& key);

}  // namespace mrose
