#include "condition/plain_expression.h"

#include <cmath>

#include "io/value.h"
#include "quantities/catalogue.h"
#include "quantities/part.h"

namespace mrose {
namespace {

constexpr double wholeBelow = 0x1p53;

}  // namespace

std::optional<std::variant<bool, double>> PlainExpression::evaluate(const Moment& at) const {
    if (at.state->robots.size() != robots_ || at.state->objects.size() != objects_ || at.state->goals.size() != goals_)
        return std::nullopt;
    const Number result = of(root_, at);
    if (result.kind == Number::Kind::none) return std::nullopt;
    if (result.kind == Number::Kind::truth) return result.value != 0;
    return result.value;
}

PlainExpression::Number PlainExpression::of(int place, const Moment& at) const {
    const Node& node = nodes_[static_cast<std::size_t>(place)];
    switch (node.operation) {
        case Operation::constant:
            return node.number;
        case Operation::quantity:
            return asked(node, at);
        case Operation::item: {
            const auto value = itemOf(node, at);
            const double* const number = value ? std::get_if<double>(&*value) : nullptr;
            return number != nullptr ? Number{*number, Number::Kind::real} : Number{};
        }
        case Operation::isText:
        case Operation::isOtherText: {
            const auto value = itemOf(nodes_[static_cast<std::size_t>(node.left)], at);
            if (!value) return {};
            const std::string* const text = std::get_if<std::string>(&*value);
            const bool same = text != nullptr && *text == node.name;
            return {same == (node.operation == Operation::isText) ? 1.0 : 0.0, Number::Kind::truth};
        }
        case Operation::drawn:
            return ofTrial(node, at.drawnValues());
        case Operation::measured:
            return ofTrial(node, at.measured);
        case Operation::conjunction:
        case Operation::disjunction: {
            const Number first = of(node.left, at);
            if (first.kind == Number::Kind::none) return first;
            return first.counts() == (node.operation == Operation::conjunction) ? of(node.right, at) : first;
        }
        case Operation::negation: {
            const Number operand = of(node.left, at);
            if (operand.kind == Number::Kind::none) return operand;
            return {operand.counts() ? 0.0 : 1.0, Number::Kind::truth};
        }
        default:
            return ofNumbers(node, at);
    }
}

PlainExpression::Number PlainExpression::ofNumbers(const Node& node, const Moment& at) const {
    const Number a = of(node.left, at);
    if (a.kind == Number::Kind::none) return a;
    const Number b = node.right >= 0 ? of(node.right, at) : a;
    if (b.kind == Number::Kind::none) return b;
    if (node.operation == Operation::equal || node.operation == Operation::different)
        return compared(node.operation, a, b);
    if (!a.isNumber() || !b.isNumber()) return {};
    switch (node.operation) {
        case Operation::minus:
            return a.kind == Number::Kind::whole ? Number{0 - a.value, a.kind} : Number{-a.value, a.kind};
        case Operation::square:
            return {a.value * a.value, Number::Kind::real};
        case Operation::ofOne:
            return {node.one(a.value), Number::Kind::real};
        case Operation::ofTwo:
            return {node.two(a.value, b.value), Number::Kind::real};
        case Operation::less:
        case Operation::lessOrEqual:
            return compared(node.operation, a, b);
        default:
            return combined(node.operation, a, b);
    }
}

PlainExpression::Number PlainExpression::combined(Operation operation, Number a, Number b) {
    if (operation == Operation::divide) return {a.value / b.value, Number::Kind::real};
    const double result = operation == Operation::add        ? a.value + b.value
                          : operation == Operation::subtract ? a.value - b.value
                                                             : a.value * b.value;
    if (a.kind == Number::Kind::real || b.kind == Number::Kind::real) return {result, Number::Kind::real};
    if (!(std::abs(result) < wholeBelow)) return {};
    return {result + 0.0, Number::Kind::whole};  // a whole 0 has no sign
}

PlainExpression::Number PlainExpression::compared(Operation operation, Number a, Number b) {
    const auto truth = [](bool is) { return Number{is ? 1.0 : 0.0, Number::Kind::truth}; };
    if (operation == Operation::less) return truth(a.value < b.value);
    if (operation == Operation::lessOrEqual) return truth(a.value <= b.value);
    const bool same = a.isNumber() == b.isNumber() && a.value == b.value;
    return truth(same == (operation == Operation::equal));
}

PlainExpression::Number PlainExpression::asked(const Node& node, const Moment& at) {
    const Quantity& quantity = *node.asked;
    if (quantity.needs == Quantity::Needs::real && at.real == nullptr) return {};
    if (quantity.needs == Quantity::Needs::control && at.insights.empty()) return {};
    const Subject subject{at, node.body, node.other};
    if (const auto* const number = std::get_if<double (*)(const Subject&)>(&quantity.read))
        return {(*number)(subject), Number::Kind::real};
    if (const auto* const truth = std::get_if<bool (*)(const Subject&)>(&quantity.read))
        return {(*truth)(subject) ? 1.0 : 0.0, Number::Kind::truth};
    const auto* const count = std::get_if<std::int64_t (*)(const Subject&)>(&quantity.read);
    if (count == nullptr) return {};
    const auto value = static_cast<double>((*count)(subject));
    return std::abs(value) < wholeBelow ? Number{value, Number::Kind::whole} : Number{};
}

/// Nothing where it is not known: Lua says whether there can be one.
std::optional<QuantityValue> PlainExpression::itemOf(const Node& node, const Moment& at) {
    const Quantity& quantity = *node.asked;
    const bool ofPart = &quantity == &partQuantity(), remembered = ofPart && node.other < firstSensorPart;
    if (ofPart && !isPartNamed(*at.scenario, node.body, node.other, node.part)) return std::nullopt;
    if (quantity.needs == Quantity::Needs::control && at.insights.empty() && !remembered) return std::nullopt;
    QuantityValue value = quantity.value({at, node.body, node.other, node.name});
    const double* const number = std::get_if<double>(&value);
    if (number != nullptr && std::isnan(*number)) return std::nullopt;
    return value;
}

/// Lua gets whole numbers that were drawn as real ones, too.
PlainExpression::Number PlainExpression::ofTrial(const Node& node, const DrawnValues* values) {
    if (values == nullptr) return {};
    const auto isIt = [&](std::size_t i) { return i < values->size() && (*values)[i].name == node.name; };
    std::size_t place = node.place;
    if (!isIt(place))
        for (place = 0; place < values->size() && !isIt(place);) ++place;
    if (place == values->size()) return {};
    const Value& value = (*values)[place].value;
    if (const double* const number = value.asFloat()) return {*number, Number::Kind::real};
    if (const std::int64_t* const whole = value.asInteger()) return {static_cast<double>(*whole), Number::Kind::real};
    if (const bool* const truth = value.asBoolean()) return {*truth ? 1.0 : 0.0, Number::Kind::truth};
    return {};
}

}  // namespace mrose
