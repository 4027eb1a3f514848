#include "condition/condition.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include "condition/lua_paths.h"
#include "condition/world_expression.h"
#include "quantities/catalogue.h"
#include "quantities/part.h"

namespace mrose {
namespace {

/// A run's start: no robot has observed or decided anything yet.
struct Start {
    WorldState state;
    std::vector<RobotInsight> insights;
    Moment moment;

    Start(const Scenario& scenario, const RealRobots* real, const DrawnValues* drawn,
          const DrawnValues* measured = nullptr)
        : state(scenario.initialState()), insights(state.robots.size()), moment{&scenario, &state, nullptr, insights,
                                                                                real,      drawn,  measured} {}
    Start(const Start&) = delete;
    Start& operator=(const Start&) = delete;
};

Expected<std::unique_ptr<WorldExpression>> compiled(std::string_view text, const Start& start,
                                                    const std::string& source) {
    auto expression = std::make_unique<WorldExpression>(text, source);
    if (const auto done = expression->compile(start.moment); !done) return tl::unexpected(done.error());
    return expression;
}

Expected<LuaValue> valueAt(WorldExpression& expression, const Moment& at) {
    assert(at.state->robots.size() == at.scene().robots.size());
    return expression.evaluate(at);
}

}  // namespace

Condition::Condition(std::unique_ptr<WorldExpression> expression) : expression_(std::move(expression)) {}
Condition::Condition(Condition&&) noexcept = default;
Condition& Condition::operator=(Condition&&) noexcept = default;
Condition::~Condition() = default;

const std::string& Condition::text() const { return expression_->text(); }

Expected<bool> Condition::holds(const Moment& at) {
    const auto value = valueAt(*expression_, at);
    if (!value) return tl::unexpected(value.error());
    if (const bool* const answer = std::get_if<bool>(&*value)) return *answer;
    return expression_->unfit(*value, "true or false");
}

namespace {

/// Whether a text has the name of a quantity that needs insights, or of one of a body's parts from `firstPart` on.
bool readsControlFrom(std::ptrdiff_t firstPart, std::string_view text, const Scenario& scenario) {
    std::vector<std::string> names;
    for (const Quantity& quantity : quantities())
        if (quantity.needs == Quantity::Needs::control) names.emplace_back(quantity.name);
    for (std::size_t body = 0; body < scenario.scene().bodyCount(); ++body) {
        const std::vector<std::string> parts = partNames(scenario, body);
        names.insert(names.end(), parts.begin() + std::min(firstPart, std::ssize(parts)), parts.end());
    }
    const std::vector<std::string_view> words = luaWords(text);
    return std::find_first_of(words.begin(), words.end(), names.begin(), names.end()) != words.end();
}

}  // namespace

bool readsControl(std::string_view text, const Scenario& scenario) { return readsControlFrom(0, text, scenario); }

bool readsInsights(std::string_view text, const Scenario& scenario) {
    return readsControlFrom(static_cast<std::ptrdiff_t>(firstSensorPart), text, scenario);
}

Expected<Condition> compileCondition(std::string_view text, const Scenario& scenario, const std::string& source,
                                     const RealRobots* real, const DrawnValues* drawn, bool tried) {
    const Start start(scenario, real, drawn);
    auto expression = compiled(text, start, source);
    if (!expression) return tl::unexpected(expression.error());
    Condition condition(std::move(*expression));
    if (!tried) return condition;
    const auto answer = condition.holds(start.moment);
    if (!answer) return tl::unexpected(answer.error());
    return condition;
}

WorldValue::WorldValue(std::unique_ptr<WorldExpression> expression) : expression_(std::move(expression)) {}
WorldValue::WorldValue(WorldValue&&) noexcept = default;
WorldValue& WorldValue::operator=(WorldValue&&) noexcept = default;
WorldValue::~WorldValue() = default;

const std::string& WorldValue::text() const { return expression_->text(); }

Expected<double> WorldValue::value(const Moment& at) {
    const auto value = valueAt(*expression_, at);
    if (!value) return tl::unexpected(value.error());
    if (const double* const number = std::get_if<double>(&*value)) return *number;
    if (const bool* const answer = std::get_if<bool>(&*value)) return *answer ? 1 : 0;
    return expression_->unfit(*value, "a number, or true or false");
}

Expected<WorldValue> compileWorldValue(std::string_view text, const Scenario& scenario, const std::string& source,
                                       const RealRobots* real, const DrawnValues* drawn, const DrawnValues* measured,
                                       bool tried) {
    const Start start(scenario, real, drawn, measured);
    auto expression = compiled(text, start, source);
    if (!expression) return tl::unexpected(expression.error());
    WorldValue value(std::move(*expression));
    if (!tried) return value;
    const auto first = value.value(start.moment);
    if (!first) return tl::unexpected(first.error());
    return value;
}

}  // namespace mrose
