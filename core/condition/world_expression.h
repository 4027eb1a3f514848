#pragma once

#include <string>
#include <string_view>

#include "condition/plain_expression.h"
#include "condition/world_names.h"
#include "io/error.h"
#include "script/lua_sandbox.h"

namespace mrose {

/// A Lua expression over the world's names, in an interpreter of its own, and what it gives. Most give it without Lua.
class WorldExpression {
public:
    WorldExpression(std::string_view text, const std::string& source) : text_(text), source_(source) {}
    WorldExpression(const WorldExpression&) = delete;
    WorldExpression& operator=(const WorldExpression&) = delete;

    const std::string& text() const { return text_; }
    /// Once, first; `start` is what is known at a run's start. Error: as of compileCondition().
    Expected<void> compile(const Moment& start);
    Expected<LuaValue> evaluate(const Moment& at);
    /// Says that it gives another kind of value than was asked for.
    tl::unexpected<Error> unfit(const LuaValue& value, const char* expected) const;

private:
    Expected<void> checkPaths();
    Expected<LuaValue> valueOf(std::string_view path);
    void readPlain(const Moment& start);

    std::string text_, source_;
    WorldView view_;
    LuaSandbox sandbox_;
    LuaSandbox::Expression expression_;
    std::optional<PlainExpression> plain_;  ///< the same without Lua, where it can be
};

}  // namespace mrose
