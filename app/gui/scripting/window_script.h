#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "debug/field_frame.h"
#include "debug/shown.h"
#include "io/error.h"
#include "scripting/scripted_window.h"

namespace mrose::gui {

struct ScriptOutcome {
    int expected = 0;  ///< calls of expect()
    int failed = 0;    ///< of them
};

/// Where a script's output goes, a line each.
struct ScriptOutput {
    std::function<void(const std::string&)> said;      ///< by say()
    std::function<void(const std::string&)> mistaken;  ///< "tour.lua:12: expected ..."
};

/// Until all that was asked for is done and shown, plots too.
void settle(const ScriptedWindow& window);

/// Lets the window do its work for so long (ms).
void letPass(int duration);

/// The shown state's hash as `mrose run` prints it.
std::string stateText(const Shown& shown);

/// A body by its name or by its number from 1, as robot[1] of conditions. Error: the names that there are.
Expected<std::size_t> bodyCalled(const FieldFrame& frame, const std::string& text);

/// All functions that a script knows: the actions by their names, and its own.
std::vector<std::string> scriptFunctions(const Actions& actions);

/// Runs Lua statements that drive the window as a user does (app/README.md): all actions by name, what the mouse does,
/// and expect() about what is shown, with the names of conditions. Each call is carried out before the next. No modal
/// dialogue is opened meanwhile. Error: `source`, the line, and what cannot be done; then the rest is not run.
Expected<ScriptOutcome> runScript(const ScriptedWindow& window, std::string_view text, const std::string& source,
                                  const ScriptOutput& output);

}  // namespace mrose::gui
