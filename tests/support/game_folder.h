#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "support/workshop.h"

namespace mrose {

/// A folder with a scenario of a user: "it's a game.toml", in which "one's" chases a ball and "two" wanders.
class GameFolder : public Workshop {
protected:
    std::string game();
    /// mrose SUBCOMMAND game MORE... --quiet
    ProgramResult play(const std::string& subcommand, const std::vector<std::string>& more,
                       const RunningProgram::Options& options = {});
    /// What `mrose run ... --json` told; expects it to end well.
    static nlohmann::json told(const ProgramResult& result);
};

/// A file of comma-separated values, without its header: rows by the header's names. Quotes are taken off.
std::vector<std::map<std::string, std::string>> csvRows(const std::string& text);

}  // namespace mrose
