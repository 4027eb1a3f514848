#include "cli/game_folder.h"

#include <sstream>

namespace mrose {
namespace {

std::vector<std::string> csvCells(const std::string& line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
            cells.back() += line[++i];
        else if (line[i] == '"')
            quoted = !quoted;
        else if (line[i] == ',' && !quoted)
            cells.emplace_back();
        else
            cells.back() += line[i];
    }
    return cells;
}

}  // namespace

std::string GameFolder::game() {
    return write("it's a game.toml", R"(format = "mrose scenario"
version = 1
name = "a game"
environment = "midsize_2001.toml"
seed = 5
duration_s = 3.0
random_factor = 0.1
variation = { robot_position_m = 0.3, robot_heading_deg = 40, object_position_m = 0.2, mass_share = 0.2 }

[[robot]]
name = "one's"
type = "pioneer1.toml"
start = { x_m = -0.6, y_m = 0.1, heading_deg = 0 }
controller = { kind = "chase_ball", target_m = [4.8, 0.0] }

[[robot]]
name = "two"
type = "nomad200.toml"
start = { x_m = 1.0, y_m = 1.0, heading_deg = 200 }
controller = { kind = "wander" }

[[object]]
name = "ball"
shape = "ball.toml"
mass_kg = 0.43
start = { x_m = 0.0, y_m = 0.0 }
)");
}

ProgramResult GameFolder::play(const std::string& subcommand, const std::vector<std::string>& more,
                               const RunningProgram::Options& options) {
    std::vector<std::string> words{subcommand, game(), "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    return runMrose(words, options);
}

nlohmann::json GameFolder::told(const ProgramResult& result) {
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    nlohmann::json json = nlohmann::json::parse(result.out, nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << result.out;
    return json;
}

std::vector<std::map<std::string, std::string>> csvRows(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    const std::vector<std::string> header = csvCells(line);
    std::vector<std::map<std::string, std::string>> rows;
    while (std::getline(lines, line)) {
        const std::vector<std::string> cells = csvCells(line);
        EXPECT_EQ(cells.size(), header.size()) << line;
        for (std::size_t i = 0; i < std::min(cells.size(), header.size()); ++i) {
            if (i == 0) rows.emplace_back();
            rows.back()[header[i]] = cells[i];
        }
    }
    return rows;
}

}  // namespace mrose
