// The flags about holding out of learning.
#include <gmock/gmock.h>

#include "support/workshop.h"

namespace mrose {
namespace {

using HeldOutProgram = Workshop;

TEST_F(HeldOutProgram, SaysWhatWasKeptAndJudgesByIt) {
    auto words = trainWords(path("half.net"));
    words.insert(words.end(), {"--hold-out", "0.5", "--hold-out-part", "1", "--hold-out-by", "groups"});
    const ProgramResult trained = runMrose(words);
    ASSERT_EQ(trained.status, 0) << trained.err;
    EXPECT_THAT(trained.out, testing::HasSubstr("kept from learning, for mrose evaluate --held-out: one in 2 of the "
                                                "groups of trajectories\n"));
    EXPECT_TRUE((loadNetwork(path("half.net"))->heldOut.part == HoldOut{2, 0}));
    const ProgramResult judged = runMrose(
        {"evaluate", path("half.net"), "--log", log(), "--held-out", "--no-floor", "--report", path("report"), "-q"});
    ASSERT_EQ(judged.status, 0) << judged.err;
    // The windows are the whole log's, too.
    EXPECT_EQ(runMrose({"predict", path("half.net"), "--log", log(), "--windows", path("report/windows.csv"), "-o",
                        path("predicted.csv"), "-q"})
                  .status,
              0);
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
    words = trainWords(path("x.net"));
    words.insert(words.end(), {"--hold-out-by", "time"});
    expectOneLine(runMrose(words), {"--hold-out-by", "--hold-out"}, 2);
    words.insert(words.end(), {"--hold-out", "0.5", "--hold-out-by", "luck"});
    EXPECT_EQ(runMrose(words).status, 2);
    EXPECT_EQ(read("x.net"), "");
}

}  // namespace
}  // namespace mrose
