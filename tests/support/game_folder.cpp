#include "support/game_folder.h"

#include <sstream>

#include "experiment/results_row.h"
#include "support/game_text.h"

namespace mrose {
std::string GameFolder::game() { return write("it's a game.toml", gameText()); }

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
    const std::vector<std::string> header = resultsCells(line);
    std::vector<std::map<std::string, std::string>> rows;
    while (std::getline(lines, line)) {
        const std::vector<std::string> cells = resultsCells(line);
        EXPECT_EQ(cells.size(), header.size()) << line;
        for (std::size_t i = 0; i < std::min(cells.size(), header.size()); ++i) {
            if (i == 0) rows.emplace_back();
            rows.back()[header[i]] = cells[i];
        }
    }
    return rows;
}

}  // namespace mrose
