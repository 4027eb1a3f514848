#pragma once

#include <optional>
#include <string>

namespace mrose {

/// What a command prints, errors too; nothing when it fails.
std::optional<std::string> outputOf(const std::string& command);

/// The command that runs the referee of the MRCLAM windows, a program independent of this one, which needs Python with
/// numpy: the script that the environment variable MROSE_REFEREE names, otherwise the one beside the repository.
std::optional<std::string> referee();

/// The number behind a label in a text; not a number where there is none.
double numberAfter(const std::string& text, const std::string& label);

}  // namespace mrose
