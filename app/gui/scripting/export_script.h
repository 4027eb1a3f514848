#pragma once

#include <optional>
#include <span>
#include <string>
#include <variant>

#include "io/error.h"
#include "scripting/scripted_window.h"

namespace mrose::gui {

/// What a script gives and gets.
using ScriptValue = std::variant<std::monostate, bool, double, std::string>;

/// An export with all that can be said of it, in this order:
/// export_film(file, from, to, speed, frames per second, "1280x720", "window"), export_sequence(folder, the same),
/// export_report(log, network, folder, other networks ...), export_comparison(scenario, log, folder, every). nullopt:
/// `name` is no such export.
std::optional<Expected<void>> exportByScript(const ScriptedWindow& window, const std::string& name,
                                             std::span<const ScriptValue> values);

}  // namespace mrose::gui
