#pragma once

#include <string>
#include <variant>

#include "io/error.h"
#include "scripting/scripted_window.h"

namespace mrose::gui {

/// What scripts ask about the log that is laid over the run, all rollouts compared: "rollouts", "windows", "p", "hd"
/// (%), "session", "start", "robot", "error" (m), "heading" (rad) and "path_share" (%) of the shown rollout,
/// "divergence" (s; nil: it stays within the bound), "cause" (the likely one; "none of these") and "explained" (0 ...
/// 1) of it. Error: no log is open; there is nothing of that name.
std::variant<std::monostate, bool, double, std::string> overlayValue(const ScriptedWindow& window,
                                                                     const std::string& name, Expected<void>& done);
/// Opens a log and waits; `robotFile`: what drove in it, "" where the log says it. Error: as of Overlay::openNow().
Expected<void> openLogByScript(const ScriptedWindow& window, const std::string& log, const std::string& robotFile);
/// Opens the rollout that comes so far down in the list, 1 the worst. Error: the list is shorter.
Expected<void> openWorst(const ScriptedWindow& window, int place);

}  // namespace mrose::gui
