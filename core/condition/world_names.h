#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "quantities/moment.h"
#include "script/lua_sandbox.h"

namespace mrose {

/// What the names of a condition look at.
struct WorldView {
    Moment at = {};            ///< set anew before each evaluation
    mutable std::string text;  ///< on its way to Lua, whose errors would not free it
};

/// Adds the names of the scenario's bodies and goals and of the catalogue's quantities (README.md). Their values are
/// read from `view`, which must stay where it is, as long as the sandbox lives. Added again for another scenario, they
/// take the place of the earlier ones.
void addWorldNames(LuaSandbox& sandbox, const Scenario& scenario, const WorldView& view);

/// The number of the body that a value stands for which these names have just given; noBody: `wall`. Nothing: it stands
/// for no body.
std::optional<std::uint32_t> bodyOf(const LuaValue& value);

}  // namespace mrose
