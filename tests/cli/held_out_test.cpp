// Holding out of learning, and judging by what was held out.
#include <nlohmann/json.hpp>

#include "cli/workshop.h"
#include "motion/motion_network.h"
#include "support/test_data.h"

namespace mrose {
namespace {

using HeldOutProgram = Workshop;
using Json = nlohmann::json;

TEST_F(HeldOutProgram, EvaluatesOnlyWhatWasHeldOut) {
    auto words = trainWords(path("half.net"));
    words.insert(words.end(), {"--hold-out", "0.5"});
    ASSERT_EQ(runMrose(words).status, 0);
    const auto network = loadNetwork(path("half.net"));
    ASSERT_TRUE(network) << network.error().message();
    EXPECT_TRUE((network->heldOut.part == HoldOut{2, 1}));

    const auto windowsOf = [&](std::vector<std::string> more) {
        std::vector<std::string> all{"evaluate", path("half.net"), "--log", log(), "--no-floor", "--json"};
        all.insert(all.end(), more.begin(), more.end());
        const ProgramResult result = runMrose(all);
        EXPECT_EQ(result.status, 0) << result.err;
        const Json json = Json::parse(result.out, nullptr, false);
        return json["models"][0]["all"]["windows"].get<int>();
    };
    const int everything = windowsOf({}), heldOut = windowsOf({"--held-out"});
    EXPECT_GT(heldOut, 0);
    EXPECT_EQ(2 * heldOut, everything);  // two of the four runs
}

TEST_F(HeldOutProgram, ThePartsAreDifferentGroups) {
    auto words = trainWords(path("other.net"));
    words.insert(words.end(), {"--hold-out", "0.5", "--hold-out-part", "1"});
    ASSERT_EQ(runMrose(words).status, 0);
    EXPECT_TRUE((loadNetwork(path("other.net"))->heldOut.part == HoldOut{2, 0}));
}

TEST_F(HeldOutProgram, NothingWasHeldOut) {
    expectOneLine(runMrose({"evaluate", network(), "--log", log(), "--held-out"}), {network(), "--hold-out"});
}

TEST_F(HeldOutProgram, AnotherLogIsNotJudgedByItsHeldOutPart) {
    auto words = trainWords(path("half.net"));
    words.insert(words.end(), {"--hold-out", "0.5"});
    ASSERT_EQ(runMrose(words).status, 0);
    const std::string other = write("other.csv", plantedCsv() + "# another hash\n");
    expectOneLine(runMrose({"evaluate", path("half.net"), "--log", other, "--held-out"}), {other, "half.net"});
}

TEST_F(HeldOutProgram, WrongSharesAreRefused) {
    for (const std::string share : {"0", "0.9", "-1", "some", "nan"}) {
        auto words = trainWords(path("x.net"));
        words.insert(words.end(), {"--hold-out", share});
        expectOneLine(runMrose(words), {"--hold-out", share}, 2);
    }
    auto words = trainWords(path("x.net"));
    words.insert(words.end(), {"--hold-out-part", "1"});
    expectOneLine(runMrose(words), {"--hold-out-part", "--hold-out"}, 2);
    EXPECT_EQ(read("x.net"), "");
}

TEST_F(HeldOutProgram, NoGroupForSoSmallAShareIsAnError) {
    auto words = trainWords(path("x.net"));
    words.insert(words.end(), {"--hold-out", "0.01"});
    expectOneLine(runMrose(words), {log(), "no group of trajectories to hold out"});
    EXPECT_EQ(read("x.net"), "");
}

TEST_F(HeldOutProgram, HuskyOfEveryFifthStepIsPredictedFromTheOthers) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs beside the repository";
    const std::string windows = (*data / "drive" / "husky_windows.csv").string();
    ASSERT_EQ(runMrose({"train", windows, "-q", "--hold-out", "0.2", "--hidden", "16", "--members", "2", "--epochs",
                        "200", "-o", path("h.net")})
                  .status,
              0);
    const ProgramResult result =
        runMrose({"evaluate", path("h.net"), "--log", windows, "--held-out", "--no-floor", "--json"});
    ASSERT_EQ(result.status, 0) << result.err;
    const Json json = Json::parse(result.out, nullptr, false);
    const auto steady = [&](std::size_t model) {
        for (const Json& group : json["models"][model]["groups"])
            if (group["name"] == "steady") return group["summary"];
        return Json();
    };
    EXPECT_EQ(steady(0)["windows"], 80);
    const auto median = [&](std::size_t model) {
        return steady(model)["position_final_over_path_by_steps_percent"]["median"].get<double>();
    };
    EXPECT_LT(median(0), 21);                // a network in a hurry
    EXPECT_LT(median(0), 0.75 * median(1));  // against velocity = command
    EXPECT_LT(steady(0)["position_final_over_path_by_steps_percent"]["median"],
              steady(0)["position_final_over_path_percent"]["median"]);
}

}  // namespace
}  // namespace mrose
