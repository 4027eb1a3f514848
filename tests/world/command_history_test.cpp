#include "world/command_history.h"

#include <gtest/gtest.h>

#include "support/units.h"

namespace mrose {
namespace {

TEST(CommandHistory, StandsBeforeTheFirstCommand) {
    CommandHistory history;
    EXPECT_EQ(history.at(5), (Command{0, 0}));
    history.issue(100 * ms, {0.3, -1});
    EXPECT_EQ(history.at(100 * ms - 1), (Command{0, 0}));
    EXPECT_EQ(history.at(100 * ms), (Command{0.3, -1}));
}

TEST(CommandHistory, HoldsACommandUntilTheNext) {
    CommandHistory history;
    history.issue(0, {0.1, 0});
    history.issue(50 * ms, {0.2, 0});
    EXPECT_EQ(history.at(50 * ms - 1).v, 0.1);
    EXPECT_EQ(history.at(1000 * ms).v, 0.2);
}

TEST(CommandHistory, LaterCommandOfTheSameInstantReplacesTheEarlier) {
    CommandHistory history;
    history.issue(0, {0.1, 0});
    history.issue(0, {0.4, 1});
    EXPECT_EQ(history.at(0), (Command{0.4, 1}));
    EXPECT_EQ(history.size(), 1u);
}

TEST(CommandHistory, RepeatedCommandTakesNoRoom) {
    CommandHistory history;
    for (int i = 0; i < 1000; ++i) history.issue(i * ms, {0.1, 0});
    EXPECT_EQ(history.size(), 1u);
    EXPECT_EQ(history.at(0).v, 0.1);
}

TEST(CommandHistory, MeanWeighsCommandsByTheirDuration) {
    CommandHistory history;
    history.issue(0, {1, 0});
    history.issue(30 * ms, {2, 10});
    history.issue(90 * ms, {4, 20});
    const Command mean = history.mean(10 * ms, 100 * ms);
    EXPECT_NEAR(mean.v, (20 * 1 + 60 * 2 + 10 * 4) / 90.0, 1e-15);
    EXPECT_NEAR(mean.w, (60 * 10 + 10 * 20) / 90.0, 1e-14);
    EXPECT_NEAR(history.mean(-50 * ms, 50 * ms).v, (30 * 1 + 20 * 2) / 100.0, 1e-15);
    EXPECT_EQ(history.mean(60 * ms, 60 * ms), (Command{2, 10}));
}

TEST(CommandHistory, ReadsNothingIssuedAtOrAfterTheEndOfTheMean) {
    CommandHistory history;
    history.issue(0, {1, 0});
    history.issue(100 * ms, {9, 9});
    EXPECT_EQ(history.mean(50 * ms, 100 * ms), (Command{1, 0}));
}

TEST(CommandHistory, ForgetsAllButTheLastOfThosePushedOut) {
    CommandHistory history;
    const int issued = CommandHistory::capacity + 40;
    for (int i = 0; i < issued; ++i) history.issue(i * ms, {double(i), 0});
    EXPECT_EQ(history.size(), CommandHistory::capacity);
    EXPECT_EQ(history.at((issued - 1) * ms).v, issued - 1);
    EXPECT_EQ(history.at(40 * ms).v, 40);
    EXPECT_EQ(history.at(3 * ms).v, 39);
    EXPECT_NEAR(history.mean(38 * ms, 42 * ms).v, (39 + 39 + 40 + 41) / 4.0, 1e-13);
}

}  // namespace
}  // namespace mrose
