// Scripts that repeat and sum up what pages say, beside the programs.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/file.h"
#include "io/toml_text.h"
#include "support/places.h"
#include "support/workshop.h"

namespace mrose {
namespace {

using testing::HasSubstr;

class ShippedScripts : public Workshop {
protected:
    static std::string shipped(const std::string& name) {
        return readFile(sourceFolder() / "resources" / name).value_or("");
    }
};

TEST_F(ShippedScripts, PaperIsRepeatedWithAsManyTrialsAsItsPageSays) {
    const std::string repeat = shipped("paper/repeat");
    EXPECT_THAT(shipped("paper/README.md"), HasSubstr("who_is_fastest.toml --trials 4800"));
    EXPECT_THAT(repeat, HasSubstr("decisions=4800"));
    const auto validation = parseToml(shipped("experiments/planner_choice_validation.toml"), "v.toml");
    ASSERT_TRUE(validation);
    EXPECT_THAT(repeat, HasSubstr("plans=" + std::to_string(*validation->at("trials")->asInteger()) + "\n"));
}

TEST_F(ShippedScripts, TablesOfOtherExperimentsAreRefusedByTheColumnThatIsMissing) {
    const std::string other = write("results.csv", "trial,seed,end\n1,1,duration\n");
    for (const std::string name : {"goes_for.awk", "goals_gained.awk", "fastest.awk"}) {
        const std::string script = (sourceFolder() / "resources" / "experiments" / name).string();
        const ProgramResult result = RunningProgram({"/usr/bin/env", "awk", "-f", script, other}).finish();
        EXPECT_EQ(result.status, 1) << name;
        EXPECT_EQ(result.out, "") << name;
        EXPECT_THAT(result.err, HasSubstr(name + ": no column ")) << name;
    }
}

}  // namespace
}  // namespace mrose
