#include "widgets/value_catalogue.h"

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
    value.name = QString::fromStdString(key.of);
    value.unit = QString::fromStdString(key.unit);
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
    const QString of = QString::fromStdString(key.of);
    QString what = QString::fromStdString(key.quantity);
    // Errors of the run and of models are held against each other: they have one name.
    if (isError(key) && !key.of.empty()) what.remove("model_");
    value.name = QString::fromStdString(key.body) + "  ";
    if (readsReality(key) && !key.of.empty())
        value.name += of + ": " + what;  // the model first: it is what differs
    else
        value.name += key.of.empty() ? what : what + ' ' + of;
    value.angle = bound->isAngle();
    value.unit = QString::fromStdString(bound->shownUnit());
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

QString fixedText(double value, int decimals) {
    if (!std::isfinite(value)) return QString::fromUtf8("\u2013");
    const double rounding = 0.5 * std::pow(10, -decimals);
    return QString::number(std::abs(value) < rounding ? 0.0 : value, 'f', decimals);
}

}  // namespace mrose
