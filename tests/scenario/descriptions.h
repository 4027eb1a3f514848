#pragma once

#include <map>
#include <string>

#include "scenario/scenario_file.h"

namespace mrose {

/// A small world of description files, in memory: scenario "s.toml" in the environment "e.toml" with the kinematic
/// robot "r.toml", the learned one "learned.toml", shapes "disc.toml" and "ball.toml", network "n.net".
std::map<std::string, std::string> smallWorld();

/// The same with `from`, which must be in the file, replaced by `to`.
std::map<std::string, std::string> changedWorld(const std::string& file, const std::string& from,
                                                const std::string& to);

Expected<LoadedScenario> loadFrom(std::map<std::string, std::string> texts, const std::string& name = "s.toml");

/// The message with which the changed world is refused; "" where it loads.
std::string refusal(const std::string& file, const std::string& from, const std::string& to);

/// The scenario's state after so many ticks.
WorldState stateAfter(const ScenarioParts& parts, int ticks);

}  // namespace mrose
