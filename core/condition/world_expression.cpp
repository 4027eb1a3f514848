#include "condition/world_expression.h"

#include "condition/lua_paths.h"
#include "io/number_text.h"

namespace mrose {
namespace {

std::string typeName(const LuaValue& value) {
    if (std::holds_alternative<double>(value)) return "the number " + numberText(std::get<double>(value));
    if (std::holds_alternative<bool>(value)) return std::get<bool>(value) ? "true" : "false";
    if (std::holds_alternative<std::string>(value)) return "a text";
    return std::string("a value of type ") + std::get<LuaOther>(value).type;
}

}  // namespace

Expected<void> WorldExpression::compile(const Scenario& scenario) {
    addMath(sandbox_);
    addWorldNames(sandbox_, scenario, view_);
    const auto expression = sandbox_.load(text_, source_);
    if (!expression) return tl::unexpected(expression.error());
    expression_ = *expression;
    const WorldState start = scenario.initialState();
    view_ = {&scenario, &start};
    Expected<void> checked = checkPaths();
    view_ = {};
    return checked;
}

/// Whether every name and every body with a fixed number or name exists. Lua itself would find out only where `and` and
/// `or` lead it.
Expected<void> WorldExpression::checkPaths() {
    for (const LuaPath& path : luaPaths(text_)) {
        const auto loaded = sandbox_.load(path.text, source_);
        const auto value = loaded ? sandbox_.evaluate(*loaded, source_) : tl::unexpected(loaded.error());
        if (loaded) sandbox_.forget(*loaded);
        if (value) continue;
        const TextPosition where = positionIn(text_, path.offset);
        return tl::unexpected(Error{source_, where.line, where.column, "", value.error().cause});
    }
    return {};
}

Expected<LuaValue> WorldExpression::evaluate(const WorldView& view) {
    view_ = view;
    return sandbox_.evaluate(expression_, source_);
}

tl::unexpected<Error> WorldExpression::unfit(const LuaValue& value, const char* expected) const {
    return fail(source_, "gives " + typeName(value) + "; expected " + expected);
}

}  // namespace mrose
