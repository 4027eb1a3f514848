#include "condition/condition.h"

#include <cassert>

#include "condition/lua_paths.h"
#include "condition/world_names.h"
#include "io/number_text.h"

namespace mrose {
namespace {

std::string typeName(const LuaValue& value) {
    if (std::holds_alternative<double>(value)) return "the number " + numberText(std::get<double>(value));
    if (std::holds_alternative<std::string>(value)) return "a text";
    return std::string("a value of type ") + std::get<LuaOther>(value).type;
}

}  // namespace

struct Condition::Compiled {
    std::string text, source;
    WorldView view;
    LuaSandbox sandbox;
    LuaSandbox::Expression expression;

    /// Whether every name and every body with a fixed number or name exists. Lua itself would find out only where `and`
    /// and `or` lead it.
    Expected<void> checkPaths() {
        for (const LuaPath& path : luaPaths(text)) {
            const auto loaded = sandbox.load(path.text, source);
            const auto value = loaded ? sandbox.evaluate(*loaded, source) : tl::unexpected(loaded.error());
            if (loaded) sandbox.forget(*loaded);
            if (value) continue;
            const TextPosition where = positionIn(text, path.offset);
            return tl::unexpected(Error{source, where.line, where.column, "", value.error().cause});
        }
        return {};
    }

    Expected<bool> evaluate() {
        const auto value = sandbox.evaluate(expression, source);
        if (!value) return tl::unexpected(value.error());
        if (const bool* const answer = std::get_if<bool>(&*value)) return *answer;
        return fail(source, "gives " + typeName(*value) + "; expected true or false");
    }
};

Condition::Condition(std::unique_ptr<Compiled> compiled) : compiled_(std::move(compiled)) {}
Condition::Condition(Condition&&) noexcept = default;
Condition& Condition::operator=(Condition&&) noexcept = default;
Condition::~Condition() = default;

const std::string& Condition::text() const { return compiled_->text; }

Expected<bool> Condition::holds(const Scenario& scenario, const WorldState& state, const StepTrace* trace) {
    assert(state.robots.size() == scenario.scene().robots.size());
    compiled_->view = {&scenario, &state, trace};
    return compiled_->evaluate();
}

Expected<Condition> compileCondition(std::string_view text, const Scenario& scenario, const std::string& source) {
    auto compiled = std::make_unique<Condition::Compiled>();
    compiled->text = text;
    compiled->source = source;
    addMath(compiled->sandbox);
    addWorldNames(compiled->sandbox, scenario, compiled->view);
    const auto expression = compiled->sandbox.load(text, source);
    if (!expression) return tl::unexpected(expression.error());
    compiled->expression = *expression;
    const WorldState start = scenario.initialState();
    compiled->view = {&scenario, &start};
    if (const auto paths = compiled->checkPaths(); !paths) return tl::unexpected(paths.error());
    if (const auto answer = compiled->evaluate(); !answer) return tl::unexpected(answer.error());
    compiled->view = {};
    return Condition(std::move(compiled));
}

}  // namespace mrose
