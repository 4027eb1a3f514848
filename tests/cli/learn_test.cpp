// Learning a measure of an experiment, as its users run it.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "support/workshop.h"
#include "world/noise.h"

namespace mrose {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

class LearnProgram : public Workshop {
protected:
    /// Results of two variants, of which the first costs a, the second 1 - a.
    std::string results(const std::string& endOfTheFirst = "condition") {
        std::string text = "trial,seed,variant,variant_name,end,feature.a,measure.cost,window\n";
        for (int trial = 1; trial <= 200; ++trial)
            for (int variant = 1; variant <= 2; ++variant) {
                const double a = uniformNoise({1, trial, 0, 0});
                text += std::to_string(trial) + ",1," + std::to_string(variant) + (variant == 1 ? ",up" : ",down") +
                        "," + (trial == 1 && variant == 1 ? endOfTheFirst : "condition") + ',' + std::to_string(a) +
                        ',' + std::to_string(variant == 1 ? a : 1 - a) + ",mrose-gui x\n";
            }
        return write("results.csv", text);
    }
};

TEST_F(LearnProgram, ChoosesAmongVariantsAndMakesAPage) {
    const ProgramResult result = runMrose({"learn", results(), "--target", "cost", "--by-variant", "--hidden", "4",
                                           "--members", "2", "--report", path("page"), "-o", path("choice.net")});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("200 trials, 40 of them held out"));
    EXPECT_THAT(result.out, HasSubstr("\nbetter than every variant alone by more than chance (95 %)"));
    EXPECT_THAT(read("choice.net"), HasSubstr("name = \"down\""));
    EXPECT_THAT(read("page/report.html"), HasSubstr("Choosing by it"));
    EXPECT_THAT(read("page/predictions.csv"), HasSubstr("trial,variant,a,cost,predicted.network"));
    const ProgramResult again = runMrose({"learn", path("results.csv"), "--target", "cost", "--by-variant", "--report",
                                          path("page"), "-o", path("other.net")});
    expectOneLine(again, {"report.html", "--overwrite"});
    EXPECT_EQ(read("other.net"), "");
}

TEST_F(LearnProgram, JsonHoldsWhatIsPrinted) {
    const ProgramResult result = runMrose({"learn", results(), "--target", "cost", "--by-variant", "--hidden", "4",
                                           "--members", "2", "-o", path("choice.net"), "--json"});
    ASSERT_EQ(result.status, 0) << result.err;
    const Json json = Json::parse(result.out);
    EXPECT_EQ(json["held_out"], 40);
    const Json& choice = json["scores"][0]["choice"];
    EXPECT_NEAR(choice["mean"], 0.25, 0.1);
    ASSERT_EQ(choice["variants"].size(), 2u);
    EXPECT_GT(choice["variants"][0]["gain_low"], 0);
    EXPECT_LT(choice["variants"][0]["share"], 0.1) << "of what varies by a half of itself";
    EXPECT_FALSE(choice.contains("oracle")) << "there is one seed alone";
}

TEST_F(LearnProgram, OfVariantsWholeTrialsAreLeftOutAndSaidOnce) {
    const auto learnedFrom = [&](const std::string& end, const std::string& how) {
        const ProgramResult result = runMrose({"learn", results(end), "--target", "cost", how, "--hidden", "2",
                                               "--members", "2", "--overwrite", "-o", path("choice.net")});
        EXPECT_EQ(result.status, 0) << result.err;
        return result.out.substr(0, result.out.find('\n'));
    };
    EXPECT_EQ(learnedFrom("duration", "--by-variant"),
              "199 trials, 40 of them held out; 1 trial left out (runs not ended by `until`: 1)");
    EXPECT_EQ(learnedFrom("fault", "--by-variant"),
              "199 trials, 40 of them held out; 1 trial left out (runs with faults: 1)");
    EXPECT_EQ(learnedFrom("duration", "--log"),
              "399 rows, 80 of them held out by trials; 1 left out, not ended by `until`");
}

TEST_F(LearnProgram, SaysWhoseNumbersAreMissing) {
    results();
    std::string text = read("results.csv");
    const std::size_t end = text.find(",mrose-gui"), cost = text.rfind(',', end - 1);
    const std::string file = write("one missing.csv", text.replace(cost, end - cost, ",nan"));
    const auto first = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"learn",     file, "--target",    "cost", "--hidden",        "2",
                                       "--members", "2",  "--overwrite", "-o",   path("choice.net")};
        words.insert(words.end(), more.begin(), more.end());
        const ProgramResult result = runMrose(words);
        EXPECT_EQ(result.status, 0) << result.err;
        return result.out.substr(0, result.out.find('\n'));
    };
    EXPECT_EQ(first({}),
              "399 rows, 80 of them held out by trials; 1 left out, as the target or an input is not a number");
    EXPECT_EQ(first({"--by-variant"}),
              "199 trials, 40 of them held out; 1 trial left out (the target or an input is not a number)");
}

TEST_F(LearnProgram, WhatIsNoBetterThanChanceIsSaidSo) {
    std::string text = "trial,seed,variant,variant_name,end,feature.a,measure.cost,window\n";
    for (int trial = 1; trial <= 200; ++trial)
        for (std::uint32_t variant = 1; variant <= 2; ++variant)
            text += std::to_string(trial) + ",1," + std::to_string(variant) + (variant == 1 ? ",up" : ",down") +
                    ",condition," + std::to_string(uniformNoise({1, trial, 0, 0})) + ',' +
                    std::to_string(uniformNoise({1, trial, variant, 1})) + ",mrose-gui x\n";
    const ProgramResult result = runMrose({"learn", write("noise.csv", text), "--target", "cost", "--by-variant",
                                           "--hidden", "2", "--members", "2", "-o", path("choice.net")});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("\nnot better than every variant alone by more than chance (95 %)"));
}

TEST_F(LearnProgram, WhatDoesNotGoTogetherIsRefused) {
    const std::string file = results();
    expectOneLine(runMrose({"learn", file, "--target", "time", "-o", path("x.net")}),
                  {"results.csv: --target: has no measure \"time\"; it has cost"});
    expectOneLine(runMrose({"learn", file, "--target", "cost", "--greatest", "-o", path("x.net")}), {"--by-variant"},
                  2);
    expectOneLine(runMrose({"learn", file, "--target", "cost", "--by-variant", "--beside", "a", "-o", path("x.net")}),
                  {"--by-variant"}, 2);
    expectOneLine(runMrose({"learn", file, "--target", "cost", "-o", file}), {"results.csv"});
    expectOneLine(runMrose({"learn", path("none"), "--target", "cost", "-o", path("x.net")}), {"none"});
    EXPECT_EQ(read("x.net"), "");
}

}  // namespace
}  // namespace mrose
