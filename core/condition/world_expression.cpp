#include "condition/world_expression.h"

#include <bit>
#include <cmath>

#include "condition/lua_paths.h"
#include "io/format.h"
#include "io/text_position.h"
#include "script/lua_math.h"

namespace mrose {
namespace {

std::string typeName(const LuaValue& value) {
    if (std::holds_alternative<double>(value)) return "the number " + numberText(std::get<double>(value));
    if (std::holds_alternative<bool>(value)) return std::get<bool>(value) ? "true" : "false";
    if (std::holds_alternative<std::string>(value)) return "a text";
    return std::string("a value of type ") + std::get<LuaOther>(value).type;
}

bool isSame(const LuaValue& a, const std::variant<bool, double>& b) {
    if (const bool* const truth = std::get_if<bool>(&a)) return b == std::variant<bool, double>(*truth);
    const double *const number = std::get_if<double>(&a), *const other = std::get_if<double>(&b);
    if (number == nullptr || other == nullptr) return false;
    return std::bit_cast<std::uint64_t>(*number) == std::bit_cast<std::uint64_t>(*other) ||
           (std::isnan(*number) && std::isnan(*other));
}

}  // namespace

Expected<void> WorldExpression::compile(const Moment& start) {
    addMath(sandbox_);
    addWorldNames(sandbox_, *start.scenario, view_);
    const auto expression = sandbox_.load(text_, source_);
    if (!expression) return tl::unexpected(expression.error());
    expression_ = *expression;
    view_.at = start;
    Expected<void> checked = checkPaths();
    if (checked) readPlain(start);
    view_.at = {};
    return checked;
}

/// Kept unless it disagrees with Lua at the start.
void WorldExpression::readPlain(const Moment& start) {
    plain_ = PlainExpression::read(text_, start, [this](std::string_view path) {
        const auto value = valueOf(path);
        return value ? bodyOf(*value) : std::nullopt;
    });
    if (!plain_) return;
    const auto byLua = sandbox_.evaluate(expression_, source_);
    const auto plain = plain_->evaluate(start);
    if (!byLua || (plain && !isSame(*byLua, *plain))) plain_.reset();
}

Expected<LuaValue> WorldExpression::valueOf(std::string_view path) {
    const auto loaded = sandbox_.load(path, source_);
    if (!loaded) return tl::unexpected(loaded.error());
    auto value = sandbox_.evaluate(*loaded, source_);
    sandbox_.forget(*loaded);
    return value;
}

/// Whether every name and every body with a fixed number or name exists. Lua itself would find out only where `and` and
/// `or` lead it.
Expected<void> WorldExpression::checkPaths() {
    for (const LuaPath& path : luaPaths(text_)) {
        if (valueOf(path.text)) continue;
        // The first part that does not fit is the one that is wrong.
        for (const LuaPath::Part& part : path.parts) {
            const auto value = valueOf(path.text.substr(0, part.end));
            if (value) continue;
            const TextPosition where = positionIn(text_, path.offset + part.begin);
            return tl::unexpected(Error{source_, where.line, where.column, "", value.error().cause});
        }
    }
    return {};
}

Expected<LuaValue> WorldExpression::evaluate(const Moment& at) {
    if (plain_)
        if (const auto value = plain_->evaluate(at)) return std::visit([](auto one) { return LuaValue(one); }, *value);
    view_.at = at;
    return sandbox_.evaluate(expression_, source_);
}

tl::unexpected<Error> WorldExpression::unfit(const LuaValue& value, const char* expected) const {
    return fail(source_, "gives " + typeName(value) + "; expected " + expected);
}

}  // namespace mrose
