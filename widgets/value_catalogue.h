#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <QString>

#include "widgets/field_frame.h"

namespace mrose {

/// What is known at a tick: the state, what the tick that led there told, and what robots last saw and decided.
struct Moment {
    const Scenario& scenario;
    const WorldState& state;
    std::span<const StepTrace::Robot> lastTick;  ///< empty at a beginning
    std::span<const ContactReport> contacts;
    std::span<const RobotInsight> insights;  ///< of each robot
    const StepTrace* trace = nullptr;        ///< all of that tick, where it is at hand

    const Scene& scene() const { return scenario.scene(); }
    Nanoseconds now() const { return scene().timeOf(state.tick); }
};
Moment momentOf(const FieldFrame& frame);

/// Which number is meant, in words that mean the same tomorrow.
struct ValueKey {
    std::string quantity;    ///< one of the catalogue
    std::uint32_t body = 0;  ///< whose
    std::string of = {};     ///< another body, a manipulator, a note's label ..., where the quantity asks for one
    std::string unit = {};   ///< where the quantity does not say it
    auto operator<=>(const ValueKey&) const = default;
};

/// A number that changes with time. read() gives no number (NaN) where nothing is known.
struct PlottedValue {
    QString name;   ///< "red 1  speed"
    QString unit;   ///< "m/s"; empty: it has none
    QString body;   ///< whose; empty: nobody's
    int decimals = 3;
    bool angle = false;  ///< degrees that go round from 180 to -180
    std::optional<std::uint32_t> colourOf;  ///< the robot whose colour it has
    std::function<double(const Moment&)> read;
};

/// Nothing: there is no such quantity or body.
std::optional<PlottedValue> plottedValue(const Scene& scene, const ValueKey& key);

/// Its number at a moment; NaN where it is unknown.
double readValue(const Moment& moment, const ValueKey& key);

/// A number as the window writes it, with a fixed number of digits and never "-0.00"; a dash where it is unknown.
QString fixedText(double value, int decimals);

/// Bodies by name, robots first; noBody: none of them.
std::uint32_t bodyNamed(const Scene& scene, const std::string& name);

/// What stands still, as `of` of a push.
inline constexpr const char* wallName = "wall";

}  // namespace mrose
