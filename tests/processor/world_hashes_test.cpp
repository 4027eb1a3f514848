// The kept hashes of the shipped scenarios: the one place where results are compared with the program's own of before.
// They show that a change, another compiler or another processor computes other bits, which nothing else shows to the
// last.
#include <set>

#include "io/file.h"
#include "simulation/step.h"
#include "support/game_folder.h"
#include "support/places.h"
#include "support/test_data.h"

namespace mrose {
namespace {

class WorldHashes : public GameFolder {
protected:
    static std::vector<std::map<std::string, std::string>> kept() {
        return csvRows(readFile(sourceFolder() / "tests/reference/world_hashes.csv").value_or(""));
    }
};

TEST_F(WorldHashes, AreThoseThatAreKept) {
    const auto data = realData();
    int compared = 0;
    for (const auto& row : kept()) {
        std::vector<std::string> words{"run", row.at("scenario"), "--duration", row.at("seconds"), "--quiet", "--json"};
        if (const std::string& log = row.at("log"); !log.empty()) {
            if (!data || !std::filesystem::exists(*data / log)) continue;
            words.insert(words.end(), {"--log", (*data / log).string()});
        }
        EXPECT_EQ(told(runMrose(words))["world_hash"], row.at("world_hash"))
            << row.at("scenario") << ": where this is meant, raise stepVersion (core/simulation/step.h) and run "
            << "tests/reference/keep_hashes";
        ++compared;
    }
    EXPECT_GE(compared, 2);
}

TEST_F(WorldHashes, AreKeptOfEveryShippedScenarioAndThisStep) {
    std::set<std::string> there, listed;
    for (const auto& entry : std::filesystem::directory_iterator(sourceFolder() / "resources/scenarios"))
        there.insert(entry.path().filename().string());
    for (const auto& row : kept()) {
        listed.insert(row.at("scenario"));
        EXPECT_EQ(row.at("step"), std::to_string(stepVersion)) << row.at("scenario");
    }
    EXPECT_EQ(listed, there);
}

}  // namespace
}  // namespace mrose
