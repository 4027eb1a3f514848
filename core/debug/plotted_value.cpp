#include "debug/plotted_value.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "condition/condition.h"

namespace mrose {
namespace {

Expected<PlottedValue> expressionValue(const Scenario& scenario, const ValueKey& key) {
    // Whether a real log is open, each moment says anew.
    const RealRobots none;
    auto compiled = compileWorldValue(key.of, scenario, "expression", &none);
    if (!compiled) return tl::unexpected(compiled.error());
    PlottedValue value;
    value.name = key.of;
    value.unit = key.unit;
    value.read = [expression = std::make_shared<WorldValue>(std::move(*compiled))](const Moment& at) {
        return expression->value(at).value_or(std::numeric_limits<double>::quiet_NaN());
    };
    return value;
}

}  // namespace

Expected<PlottedValue> plottedValue(const Scenario& scenario, const ValueKey& key) {
    if (key.quantity == expressionQuantity) return expressionValue(scenario, key);
    auto bound = boundValue(scenario, key);
    if (!bound) return tl::unexpected(bound.error());
    PlottedValue value;
    std::string what = key.quantity;
    // Errors of the run and of models are held against each other: they have one name.
    if (isError(key) && !key.of.empty())
        what.erase(0, std::string_view("model_").size() * static_cast<std::size_t>(what.starts_with("model_")));
    value.name = key.body + "  ";
    if (readsReality(key) && !key.of.empty())
        value.name += key.of + ": " + what;  // the model first: it is what differs
    else
        value.name += key.of.empty() ? what : what + ' ' + key.of;
    value.angle = bound->isAngle();
    value.unit = bound->shownUnit();
    value.decimals = bound->quantity->unit.digits;
    const Scene& scene = scenario.scene();
    if (bound->quantity->of != Quantity::Of::goal && bound->body < scene.robots.size())
        value.colourOf = static_cast<std::uint32_t>(scene.placeOf(bound->body));
    value.read = [reader = std::move(*bound)](const Moment& at) { return reader.shownNumber(at); };
    return value;
}

bool isError(const ValueKey& key) {
    for (const char* const error :
         {positionErrorQuantity, headingErrorQuantity, modelPositionErrorQuantity, modelHeadingErrorQuantity})
        if (key.quantity == error) return true;
    return false;
}

bool readsReality(const ValueKey& key) {
    const auto all = quantities();
    return std::any_of(all.begin(), all.end(), [&](const Quantity& quantity) {
        return quantity.name == key.quantity && quantity.needs == Quantity::Needs::real;
    });
}

}  // namespace mrose
