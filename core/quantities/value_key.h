#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "io/error.h"
#include "quantities/catalogue.h"

namespace mrose {

/// Which value is meant, in words that mean the same tomorrow.
struct ValueKey {
    std::string quantity;   ///< a name of the catalogue, or of a part
    std::string body = {};  ///< the name of whose it is, or of a goal; empty: the run's
    std::string of = {};    ///< the other body of a pair, or an item
    std::string unit = {};  ///< where the quantity does not say it
    auto words() const { return std::tie(quantity, body, of, unit); }
    bool operator==(const ValueKey& other) const { return words() == other.words(); }
    bool operator<(const ValueKey& other) const { return words() < other.words(); }
};

/// What stands still, as `of` of a pair.
inline constexpr const char* wallName = "wall";

/// A value of a scenario, found by its key once and read at every tick.
struct BoundValue {
    const Quantity* quantity = nullptr;
    std::uint32_t body = noBody, other = noBody;  ///< Subject's
    std::string item = {};
    std::string ownUnit = {};  ///< where the quantity does not say it

    /// NaN where the moment does not have what it needs.
    QuantityValue value(const Moment& at) const;
    bool isAngle() const { return ownUnit.empty() ? quantity->unit.isAngle() : ownUnit == "rad"; }
    std::string shownUnit() const;      ///< as people are shown it
    double shown(double number) const;  ///< a number in that unit
    double shownNumber(const Moment& at) const { return shown(numberOf(value(at))); }
};
/// Error: there is no such quantity or body; with those that there are.
Expected<BoundValue> boundValue(const Scenario& scenario, const ValueKey& key);
ValueKey keyOf(const Scenario& scenario, const BoundValue& value);

/// The unit of what a part remembers or reports, as far as it is known at a run's start; "" where it is not. Error: the
/// part cannot have such an entry; with those that it has.
Expected<std::string> entryUnit(const Scenario& scenario, const BoundValue& value);

/// As conditions spell it: robot["red 2"].speed.
std::string pathOf(const Scenario& scenario, const BoundValue& value);
/// What such a spelling of a body's quantity or entry stands for, also by number, robot[2].speed, and as ball.speed;
/// nullopt: it is more than that, or there is no such value.
std::optional<ValueKey> keyOfPath(const Scenario& scenario, const std::string& path);

}  // namespace mrose
