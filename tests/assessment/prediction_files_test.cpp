#include "assessment/prediction_files.h"

#include <gtest/gtest.h>

#include "assessment/test_models.h"
#include "io/format.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

std::string errorOf(std::string_view content) {
    const auto windows = parseWindows(content, "w.csv");
    return windows ? "no error" : windows.error().message();
}

TEST(WindowFile, IsReadAsTheRefereeWritesIt) {
    const auto windows = parseWindows("dataset,robot,t_start,path_m,rotation_rad\n7,2,1248446702.5,0.3,1.2\n", "w");
    ASSERT_TRUE(windows);
    ASSERT_EQ(windows->size(), 1u);
    EXPECT_EQ(windows->front().dataset, 7);
    EXPECT_EQ(windows->front().robot, "2");
    EXPECT_EQ(windows->front().start, 1'248'446'702'500'000'000);
}

TEST(WindowFile, IsRefusedWithFileLineAndCause) {
    EXPECT_EQ(errorOf("dataset,robot,t\n7,1,3\n"),
              "w.csv:1: t_start: the header has no such column; expected dataset,robot,t_start");
    EXPECT_EQ(errorOf("dataset,robot,t_start\n"), "w.csv:1: has no window");
    EXPECT_EQ(errorOf("dataset,robot,t_start\n7,1,3.5\n7.5,1,3.5\n"), "w.csv:3: dataset: is no whole number");
    EXPECT_EQ(errorOf("dataset,robot,t_start\n7,1,3.5\n7,1,3.50\n"),
              "w.csv:3: t_start: the window of line 2 once more");
    for (const std::string row : {"7,1", "7,1,3.5,9", "7,1,soon", "7,1,nan", "seven,1,3.5", "7,1,"}) {
        const std::string error = errorOf("dataset,robot,t_start\n" + row + "\n");
        EXPECT_EQ(error.rfind("w.csv:2", 0), 0u) << row << ": " << error;
    }
    EXPECT_FALSE(readWindows("/nonexistent/w.csv"));
}

TEST(WindowFile, WhatIsWrittenIsReadBack) {
    const Log log = logOf({obedientTrajectory(0, 60 * second, [](double) { return Command{0.1, 0.01}; })});
    const HeldCommandModel model{second / 10};
    const NamedModel named = NamedModel::same("model", model);
    const auto evaluation = evaluate(log, {&named, 1}, {.withFloor = false});
    ASSERT_TRUE(evaluation);
    const std::string text = windowsCsv(evaluation->log);
    EXPECT_TRUE(text.starts_with(
        "dataset,robot,t_start,path_m,rotation_rad,trajectory\n0,r,3.5,1.0000,0.1000,a\n0,r,13.5,1.0000,0.1000,a\n"))
        << text;
    const auto back = parseWindows(text, "w");
    ASSERT_TRUE(back);
    const auto requested = requestedStarts(log, *back, 100, "w");
    ASSERT_TRUE(requested);
    const auto direct = rolloutStarts(log, evaluation->log.windows);
    ASSERT_EQ(requested->starts.size(), direct.size());
    for (std::size_t i = 0; i < direct.size(); ++i) {
        EXPECT_EQ(requested->starts[i].time, direct[i].time);
        EXPECT_EQ(requested->starts[i].pose, direct[i].pose);
        EXPECT_EQ(requested->starts[i].velocity, direct[i].velocity);
    }
}

TEST(RequestedStarts, AreRefusedWithTheRequestsLine) {
    const Trajectory trajectory = obedientTrajectory(0, 20 * second, [](double) { return Command{0.1, 0}; });
    Trajectory twin = trajectory;
    twin.name = "b";
    const Log log = logOf({trajectory}), twins = logOf({trajectory, twin});
    const auto error = [&](const Log& in, const WindowRequest& request) {
        const auto starts = requestedStarts(in, {&request, 1}, 100, "w.csv");
        return starts ? "no error" : starts.error().message();
    };
    EXPECT_EQ(error(log, {7, "r", "", second, 4}), "w.csv:4: dataset: is 7, but the log made-up is data set 0");
    EXPECT_EQ(error(log, {0, "q", "", second, 4}), "w.csv:4: robot: the log made-up has no robot q");
    EXPECT_EQ(error(log, {0, "r", "", 99 * second, 4}),
              "w.csv:4: t_start: no ground truth of robot r at 99.0 s to start from");
    EXPECT_EQ(error(twins, {0, "r", "", second, 4}),
              "w.csv:4: t_start: several trajectories have robot r at 1.0 s; expected a column trajectory");
    EXPECT_EQ(error(twins, {0, "r", "b", second, 4}), "no error");
}

TEST(Predictions, HaveOneRowPerStep) {
    const Log log = logOf({obedientTrajectory(0, 20 * second, [](double) { return Command{0.1, 0}; })});
    const RequestedStarts requested{{{&log.robots[0].trajectories[0], 1'250'000'000, {}, {}, 2}}, {0}};
    const std::vector<std::vector<Pose>> poses{{{1, -2, 3}, {0.12345678, 0, -1e-9}}};
    PredictionsCsv rows(log, requested, 100'000'000, false, {});
    rows.add(poses);
    EXPECT_EQ(rows.text(),
              "dataset,robot,t_start,t,x,y,heading\n"
              "0,r,1.25,0.1,1.0000000,-2.0000000,3.0000000\n"
              "0,r,1.25,0.2,0.1234568,0.0000000,0.0000000\n");
}

TEST(Predictions, OfSamplesAreByWindowAndHaveTheStepsAskedFor) {
    const Log log = logOf({obedientTrajectory(0, 20 * second, [](double) { return Command{0.1, 0}; })});
    const Trajectory* const whole = &log.robots[0].trajectories[0];
    RequestedStarts requested{{{whole, 1'250'000'000, {}, {}, 2}, {whole, 2'000'000'000, {}, {}, 2}}, {0, 0}};
    requested.starts[0].seed = 71;
    requested.starts[1].seed = 4'294'967'295;
    PredictionsCsv rows(log, requested, 100'000'000, true, {2});
    rows.add(std::vector<std::vector<Pose>>{{{}, {1, 0, 0}}, {{}, {2, 0, 0}}}, 0);
    requested.starts[0].seed = 72;
    rows.add(std::vector<std::vector<Pose>>{{{}, {3, 0, 0}}, {{}, {4, 0, 0}}}, 1);
    EXPECT_EQ(rows.text(),
              "dataset,robot,t_start,sample,seed,t,x,y,heading\n"
              "0,r,1.25,0,71,0.2,1.0000000,0.0000000,0.0000000\n"
              "0,r,1.25,1,72,0.2,3.0000000,0.0000000,0.0000000\n"
              "0,r,2.0,0,4294967295,0.2,2.0000000,0.0000000,0.0000000\n"
              "0,r,2.0,1,4294967295,0.2,4.0000000,0.0000000,0.0000000\n");
}

TEST(SecondsText, LosesNothing) {
    EXPECT_EQ(secondsText(0), "0.0");
    EXPECT_EQ(secondsText(-1'500'000'001), "-1.500000001");
    EXPECT_EQ(secondsText(10 * second, 0), "10");
    EXPECT_EQ(secondsText(1'248'446'702'500'000'000), "1248446702.5");
}

}  // namespace
}  // namespace mrose
