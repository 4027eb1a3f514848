#include "tasks/task_data.h"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace mrose {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* results =
    "trial,seed,variant,variant_name,end,time_s,draw.n,feature.a,feature.b,feature.guess,measure.t,measure.c\n"
    "1,1,1,,condition,2.0,3.0,0.5,-1.0,2.5,2.0,nan\n"
    "1,2,1,,condition,2.5,3.0,0.5,-1.0,2.5,2.5,1.0\n"
    "2,1,1,,duration,9.0,4.0,0.7,-2.0,8.0,9.0,1.0\n"
    "3,1,1,,fault,1.0,4.0,0.7,-2.0,8.0,1.0,1.0\n"
    "4,1,1,,condition,1.0,4.0,nan,-2.0,8.0,1.0,1.0\n"
    "5,1,1,\"x, y\",condition,3.0,5.0,0.9,-3.0,2.0,3.0,1.0\n";

class TaskDataTest : public testing::Test {
protected:
    Expected<TaskData> read(const TaskQuestion& question) {
        folder_.write("results.csv", results);
        const auto table = readResultsTable(folder_.path());
        EXPECT_TRUE(table) << table.error().message();
        return taskData(*table, question);
    }
    std::string refusal(const TaskQuestion& question) {
        const auto data = read(question);
        return data ? "" : data.error().message();
    }

    TemporaryFolder folder_;
};

TEST_F(TaskDataTest, RowsThatSayNothingAreLeftOutAndCounted) {
    const auto data = read({.target = "t", .beside = {"guess"}});
    ASSERT_TRUE(data) << data.error().message();
    EXPECT_THAT(data->inputs, ElementsAre("a", "b"));
    EXPECT_THAT(data->y, ElementsAre(2.0, 2.5, 3.0));
    EXPECT_THAT(data->x, ElementsAre(0.5, -1.0, 0.5, -1.0, 0.9, -3.0));
    EXPECT_THAT(data->trial, ElementsAre(1u, 1u, 5u));
    ASSERT_EQ(data->beside.size(), 1u);
    EXPECT_THAT(data->beside[0].of, ElementsAre(2.5, 2.5, 2.0));
    EXPECT_EQ(data->unfinished, 1);
    EXPECT_EQ(data->faulty, 1);
    EXPECT_EQ(data->unknown, 1);
    const auto all = read({.target = "t", .unfinished = true});
    EXPECT_THAT(all->y, ElementsAre(2.0, 2.5, 9.0, 3.0));
    EXPECT_THAT(read({.target = "c"})->y, ElementsAre(1.0, 1.0)) << "without the one that is no number";
}

TEST_F(TaskDataTest, InputsMayBeChosenAndBeDraws) {
    const auto data = read({.inputs = {"draw.n", "b"}, .target = "t"});
    ASSERT_TRUE(data) << data.error().message();
    EXPECT_THAT(data->x, ElementsAre(3.0, -1.0, 3.0, -1.0, 4.0, -2.0, 5.0, -3.0));
}

/// Variants that no sweep made have no such number, and are left out.
TEST_F(TaskDataTest, InputMayBeWhatWasSwept) {
    folder_.write("results.csv",
                  "trial,seed,variant,variant_name,end,feature.a,measure.t,swept\n"
                  "1,1,1,plain,condition,0.5,2.0,\n"
                  "1,1,2,loss 10 %,condition,0.5,3.0,10\n"
                  "1,1,3,loss 20 %,condition,0.5,4.0,20\n");
    const auto table = readResultsTable(folder_.path());
    ASSERT_TRUE(table) << table.error().message();
    const auto data = taskData(*table, {.inputs = {"swept", "a"}, .target = "t"});
    ASSERT_TRUE(data) << data.error().message();
    EXPECT_THAT(data->x, ElementsAre(10.0, 0.5, 20.0, 0.5));
    EXPECT_EQ(data->unknown, 1);
    EXPECT_THAT(refusal({.inputs = {"swept"}, .target = "t"}), HasSubstr("has no feature \"swept\""));
}

TEST_F(TaskDataTest, TrialsAreHeldOutWhole) {
    TaskData data{.inputs = {"a"}, .target = "t"};
    for (std::uint32_t trial = 1; trial <= 20; ++trial)
        for (int seed = 0; seed < 3; ++seed) {
            data.x.push_back(trial);
            data.y.push_back(seed);
            data.trial.push_back(trial);
        }
    const TaskData held = data.part(5, 0, true), others = data.part(5, 0, false);
    EXPECT_EQ(std::set<std::uint32_t>(held.trial.begin(), held.trial.end()), (std::set<std::uint32_t>{5, 10, 15, 20}));
    EXPECT_EQ(held.rows(), 12u);
    EXPECT_EQ(others.rows(), 48u);
    for (const std::uint32_t trial : others.trial) EXPECT_NE(trial % 5, 0u);
}

constexpr const char* variants =
    "trial,seed,variant,variant_name,end,feature.a,measure.t,window\n"
    "1,7,1,here,condition,0.5,2.0,mrose-gui first\n"
    "1,8,1,here,condition,0.5,3.0,\n"
    "1,7,2,there,condition,0.5,4.0,\n"
    "1,8,2,there,duration,0.5,9.0,\n"
    "2,9,1,here,condition,0.7,1.0,mrose-gui second\n"
    "2,10,1,here,condition,0.7,1.5,mrose-gui later\n"
    "2,9,2,there,condition,0.7,6.0,mrose-gui other\n"
    "2,10,2,there,condition,0.7,7.0,\n";

TEST_F(TaskDataTest, ByVariantARowIsATrialWithAllItsRuns) {
    folder_.write("results.csv", variants);
    const auto table = readResultsTable(folder_.path());
    ASSERT_TRUE(table);
    const auto data = taskData(*table, {.target = "t", .byVariant = true});
    ASSERT_TRUE(data) << data.error().message();
    EXPECT_THAT(data->variants, ElementsAre("here", "there"));
    EXPECT_THAT(data->trial, ElementsAre(2u)) << "the first has a run that did not end";
    EXPECT_THAT(data->y, ElementsAre(1.25, 6.5));
    EXPECT_THAT(data->bySeed, ElementsAre(1.0, 6.0, 1.5, 7.0));
    EXPECT_THAT(data->window, ElementsAre("mrose-gui second", "mrose-gui other"));
    EXPECT_EQ(data->seeds, 2u);
    EXPECT_EQ(data->unfinished, 1);
    EXPECT_EQ(data->unknown, 1);
    const auto all = taskData(*table, {.target = "t", .unfinished = true, .byVariant = true});
    EXPECT_THAT(all->y, ElementsAre(2.5, 6.5, 1.25, 6.5));
    const TaskData held = all->part(2, 0, true);
    EXPECT_THAT(held.bySeed, ElementsAre(1.0, 6.0, 1.5, 7.0));
    EXPECT_THAT(held.y, ElementsAre(1.25, 6.5));
    EXPECT_EQ(held.outputs(), 2u);
    EXPECT_THAT(refusal({.target = "t", .byVariant = true}), HasSubstr("--by-variant: has one variant alone"));
}

TEST_F(TaskDataTest, WhatIsMissingIsToldWithWhatThereIs) {
    EXPECT_THAT(refusal({.target = "x"}), HasSubstr("results.csv: --target: has no measure \"x\"; it has t, c"));
    EXPECT_THAT(refusal({.inputs = {"c"}, .target = "t"}),
                HasSubstr("--inputs: has no feature \"c\"; it has a, b, guess"));
    EXPECT_THAT(refusal({.inputs = {"draw.m"}, .target = "t"}), HasSubstr("--inputs: has no feature \"draw.m\""));
    EXPECT_THAT(refusal({.target = "t", .beside = {"d"}}), HasSubstr("--beside: has no feature \"d\""));
    EXPECT_EQ(refusal({.inputs = {"a", "b", "a"}, .target = "t"}), "--inputs: names \"a\" twice");
    EXPECT_EQ(refusal({.inputs = {"a"}, .target = "t", .beside = {"a"}}),
              "--beside: names \"a\", an input (--inputs); expected features that are none");
    EXPECT_EQ(refusal({.target = "t", .beside = {"guess", "guess"}}), "--beside: names \"guess\" twice");
    EXPECT_THAT(refusal({.target = "t", .beside = {"a", "b", "guess"}}), HasSubstr("has no features to learn from"));
    folder_.write("results.csv", "trial,seed,variant,end,feature.a,measure.t\n1,1,1,fault,1,1\n");
    const auto table = readResultsTable(folder_.path() / "results.csv");
    ASSERT_TRUE(table);
    const auto none = taskData(*table, {.target = "t"});
    ASSERT_FALSE(none);
    EXPECT_THAT(none.error().message(), HasSubstr("has no row to learn from"));
}

TEST_F(TaskDataTest, FilesThatAreNoResultsAreRefused) {
    const auto refused = [&](const std::string& text) {
        folder_.write("results.csv", text);
        const auto table = readResultsTable(folder_.path());
        return table ? "" : table.error().message();
    };
    EXPECT_THAT(refused("a,b\n"), HasSubstr("results.csv:1: is no results.csv of mrose"));
    EXPECT_THAT(refused("trial,seed,end\n1,1,a\n2,1\n"), HasSubstr("results.csv:3: has 2 cells; expected 3"));
    EXPECT_FALSE(readResultsTable(folder_.path() / "none"));
}

}  // namespace
}  // namespace mrose
