#pragma once

#include <QString>
#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <tuple>

#include "io/error.h"
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
    const Reality* reality = nullptr;        ///< what really happened then, where it is known

    const Scene& scene() const { return scenario.scene(); }
    Nanoseconds now() const { return scene().timeOf(state.tick); }
};
Moment momentOf(const FieldFrame& frame);

/// Which number is meant, in words that mean the same tomorrow.
struct ValueKey {
    std::string quantity;   ///< one of the catalogue, or expressionQuantity
    std::string body = {};  ///< the name of whose it is; of an expression empty
    std::string of = {};    ///< another body, a manipulator, a note's label ..., where the quantity asks for one
    std::string unit = {};  ///< where the quantity does not say it
    auto words() const { return std::tie(quantity, body, of, unit); }
    bool operator==(const ValueKey& other) const { return words() == other.words(); }
    bool operator<(const ValueKey& other) const { return words() < other.words(); }
};

/// A number that changes with time. read() gives no number (NaN) where nothing is known.
struct PlottedValue {
    QString name;  ///< "red 1  speed"
    QString unit;  ///< "m/s"; empty: it has none
    int decimals = 3;
    bool angle = false;                     ///< degrees that go round from 180 to -180
    std::optional<std::uint32_t> colourOf;  ///< which robot's colour it has: Scene::placeOf()
    std::function<double(const Moment&)> read;
};

/// The quantity whose `of` is a Lua expression over the world (core/condition/README.md).
inline constexpr const char* expressionQuantity = "expression";

/// Of a robot that really drove: how far it is off, in cm and degrees; of an overlaid motion model where `of` names it.
inline constexpr const char* positionErrorQuantity = "position error";
inline constexpr const char* headingErrorQuantity = "heading error";

/// Error: there is no such quantity or body; what is wrong with the expression. read() is for one thread at a time, and
/// for scenarios with the same bodies.
Expected<PlottedValue> plottedValue(const Scenario& scenario, const ValueKey& key);

/// The number of a quantity of the catalogue at a moment; NaN where it is unknown. `body` is the one that the key
/// names.
double readValue(const Moment& moment, const ValueKey& key, std::uint32_t body);
/// Its unit and digits; nullptr: there is no such quantity.
struct QuantityText {
    const char* unit;
    int decimals;
};
const QuantityText* quantityText(const std::string& quantity);

/// A number as the window writes it, with a fixed number of digits and never "-0.00"; a dash where it is unknown.
QString fixedText(double value, int decimals);

/// Whether a number is told by what really happened.
bool readsReality(const ValueKey& key);

/// Bodies by name, robots first; noBody: none of them.
std::uint32_t bodyNamed(const Scene& scene, const std::string& name);

/// A note's label without the unit that it may end in: "ball speed" and "m/s" of "ball speed (m/s)".
struct NoteLabel {
    std::string name, unit;
};
NoteLabel noteLabel(const std::string& label);

/// What stands still, as `of` of a push.
inline constexpr const char* wallName = "wall";

}  // namespace mrose
