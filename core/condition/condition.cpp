#include "condition/condition.h"

#include <cassert>

#include "condition/world_expression.h"

namespace mrose {
namespace {

Expected<std::unique_ptr<WorldExpression>> compiled(std::string_view text, const Scenario& scenario,
                                                    const std::string& source, const RealPoses& real) {
    auto expression = std::make_unique<WorldExpression>(text, source, real);
    if (const auto done = expression->compile(scenario); !done) return tl::unexpected(done.error());
    return expression;
}

}  // namespace

Condition::Condition(std::unique_ptr<WorldExpression> expression) : expression_(std::move(expression)) {}
Condition::Condition(Condition&&) noexcept = default;
Condition& Condition::operator=(Condition&&) noexcept = default;
Condition::~Condition() = default;

const std::string& Condition::text() const { return expression_->text(); }

Expected<bool> Condition::holds(const Scenario& scenario, const WorldState& state, const StepTrace* trace) {
    assert(state.robots.size() == scenario.scene().robots.size());
    const auto value = expression_->evaluate(scenario, state, trace);
    if (!value) return tl::unexpected(value.error());
    if (const bool* const answer = std::get_if<bool>(&*value)) return *answer;
    return expression_->unfit(*value, "true or false");
}

Expected<Condition> compileCondition(std::string_view text, const Scenario& scenario, const std::string& source,
                                     const RealPoses& real) {
    auto expression = compiled(text, scenario, source, real);
    if (!expression) return tl::unexpected(expression.error());
    Condition condition(std::move(*expression));
    const auto answer = condition.holds(scenario, scenario.initialState(), nullptr);
    if (!answer) return tl::unexpected(answer.error());
    return condition;
}

WorldValue::WorldValue(std::unique_ptr<WorldExpression> expression) : expression_(std::move(expression)) {}
WorldValue::WorldValue(WorldValue&&) noexcept = default;
WorldValue& WorldValue::operator=(WorldValue&&) noexcept = default;
WorldValue::~WorldValue() = default;

const std::string& WorldValue::text() const { return expression_->text(); }

Expected<double> WorldValue::value(const Scenario& scenario, const WorldState& state, const StepTrace* trace) {
    assert(state.robots.size() == scenario.scene().robots.size());
    const auto value = expression_->evaluate(scenario, state, trace);
    if (!value) return tl::unexpected(value.error());
    if (const double* const number = std::get_if<double>(&*value)) return *number;
    if (const bool* const answer = std::get_if<bool>(&*value)) return *answer ? 1 : 0;
    return expression_->unfit(*value, "a number, or true or false");
}

Expected<WorldValue> compileWorldValue(std::string_view text, const Scenario& scenario, const std::string& source,
                                       const RealPoses& real) {
    auto expression = compiled(text, scenario, source, real);
    if (!expression) return tl::unexpected(expression.error());
    WorldValue value(std::move(*expression));
    const auto first = value.value(scenario, scenario.initialState(), nullptr);
    if (!first) return tl::unexpected(first.error());
    return value;
}

}  // namespace mrose
