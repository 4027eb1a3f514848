// Networks and scenarios against logs: evaluate, predict, compare.
#include <algorithm>
#include <sstream>

#include "io/file.h"
#include "logs/csv_writer.h"
#include "logs/log_reader.h"
#include "report/sheet.h"
#include "support/places.h"
#include "support/workshop.h"
#include "workflow/compare_log.h"
#include "workflow/evaluate_network.h"
#include "workflow/expect_error.h"
#include "workflow/predict_windows.h"
#include "workflow/sim_to_real_sheet.h"

namespace mrose {
namespace {

using Judging = Workshop;

bool isSaid(const std::vector<std::string>& notices, const std::string& part) {
    return std::any_of(notices.begin(), notices.end(),
                       [&](const std::string& notice) { return notice.find(part) != std::string::npos; });
}

TEST_F(Judging, NetworkIsJudgedBesideOthersAndKinematics) {
    EvaluateRequest request{network(), log()};
    request.against = {network()};
    request.withFloor = false;
    request.shown = {2};
    request.command = "as I say";
    const auto judged = evaluateNetwork(request);
    ASSERT_TRUE(judged) << judged.error().message();
    ASSERT_EQ(judged->evaluation.models.size(), 5u);
    EXPECT_EQ(judged->evaluation.models[0].name, "a.net");
    EXPECT_EQ(judged->evaluation.models[0].all.p, judged->evaluation.models[1].all.p);
    EXPECT_FALSE(judged->evaluation.log.floor);
    EXPECT_EQ(judged->context.commandLine, "as I say");
    EXPECT_EQ(judged->context.chosen, std::vector<std::size_t>{1});
    EXPECT_TRUE(isSaid(judged->context.notices, "learned from this log"));
    request.shown = {999};
    expectError(evaluateNetwork(request), "", {"--show: there is no window 999 of "});
}

TEST_F(Judging, WhatWasLearnedFromTheLogIsSaidOfEachNetwork) {
    const std::string shipped = (sourceFolder() / "nets/pioneer.net").string(), own = network();
    const auto said = [&](const std::string& judged, const std::string& beside) {
        EvaluateRequest request{judged, log()};
        request.against = {beside};
        request.withFloor = false;
        request.samples = 19;
        const auto evaluated = evaluateNetwork(request);
        EXPECT_TRUE(evaluated) << evaluated.error().message();
        return evaluated->context.notices;
    };
    EXPECT_TRUE(isSaid(said(shipped, own), "a.net was learned from this log: on another one its errors are larger."));
    EXPECT_FALSE(isSaid(said(own, shipped), "pioneer.net was learned from this log"));
}

TEST_F(Judging, EvaluationIsEndedByItsProgress) {
    double most = 0;
    const auto judged = evaluateNetwork({network(), log()}, [&](double share) {
        most = share;
        return false;
    });
    EXPECT_FALSE(judged);
    EXPECT_LT(most, 1);
}

TEST_F(Judging, SheetIsOnePageThatIsNotWrittenOverAnother) {
    SheetRequest request{network(), log()};
    request.output = path("sheet.html");
    const auto sheet = writeSheet(request);
    ASSERT_TRUE(sheet) << sheet.error().message();
    EXPECT_EQ(*readFile(request.output), sheetHtml(sheet->evaluation, sheet->context));
    expectError(writeSheet(request), request.output, {"is there already"});
    request.overwrite = true;
    EXPECT_FALSE(writeSheet(request, [](double) { return false; }));
    EXPECT_EQ(*readFile(request.output), sheetHtml(sheet->evaluation, sheet->context)) << "nothing is lost";
    EXPECT_TRUE(writeSheet(request));
    request.network = path("none.net");
    expectError(writeSheet(request), request.network, {});
}

TEST_F(Judging, WindowsArePredictedStepByStep) {
    PredictRequest request{network(), log(), windows()};
    const auto before = listing();
    const auto predicted = predictWindows(request);
    ASSERT_TRUE(predicted) << predicted.error().message();
    EXPECT_EQ(predicted->windows, 4u);
    EXPECT_EQ(std::count(predicted->csv.begin(), predicted->csv.end(), '\n'), 1 + 4 * 100);
    EXPECT_TRUE(isSaid(predicted->notices, "learned from this log"));
    EXPECT_EQ(listing(), before) << "no output was asked for";
    request.output = path("p.csv");
    ASSERT_TRUE(predictWindows(request));
    EXPECT_EQ(read("p.csv"), predicted->csv);
    expectError(predictWindows(request), path("p.csv"), {"is there already"});
    request.overwrite = true;
    request.output = request.windows;
    expectError(predictWindows(request), request.windows, {"is read by this command"});
}

TEST_F(Judging, SamplesArePredictedOfTheInstantsAskedFor) {
    PredictRequest request{network(), log(), windows()};
    request.samples = 3;
    request.at = {1, 10};
    const auto predicted = predictWindows(request);
    ASSERT_TRUE(predicted) << predicted.error().message();
    EXPECT_EQ(std::count(predicted->csv.begin(), predicted->csv.end(), '\n'), 1 + 4 * 3 * 2);
    EXPECT_EQ(firstLines(predicted->csv, 1), "dataset,robot,t_start,sample,seed,t,x,y,heading,trajectory\n");
    const auto again = predictWindows(request);
    request.seed = 2;
    const auto other = predictWindows(request);
    ASSERT_TRUE(again && other);
    EXPECT_EQ(again->csv, predicted->csv);
    EXPECT_NE(other->csv, predicted->csv);
}

TEST_F(Judging, SamplesOfARobotDoNotDependOnWhichOthersTheLogHas) {
    auto two = readLog(log());
    ASSERT_TRUE(two) << two.error().message();
    const std::string name = two->robots.front().robot;
    two->robots.insert(two->robots.begin(), two->robots.front());
    two->robots.front().robot = "another";
    ASSERT_TRUE(writeCsv(path("two.csv"), *two));
    PredictRequest request{network(), path("two.csv"), windows()};
    request.samples = 3;
    const auto among = predictWindows(request);
    request.robots = {name};
    const auto alone = predictWindows(request);
    ASSERT_TRUE(among) << among.error().message();
    ASSERT_TRUE(alone) << alone.error().message();
    EXPECT_EQ(alone->csv, among->csv);
}

TEST_F(Judging, PredictionsDoNotReadWhatTheRobotDidAfterTheirStart) {
    auto known = readLog(log());
    ASSERT_TRUE(known) << known.error().message();
    const auto predicted = [&](const std::string& name) {
        EXPECT_TRUE(writeCsv(path(name), *known));
        PredictRequest request{network(), path(name), windows()};
        const auto mean = predictWindows(request);
        request.samples = 3;
        const auto samples = predictWindows(request);
        EXPECT_TRUE(mean && samples);
        return mean && samples ? mean->csv + samples->csv : std::string();
    };
    const std::string before = predicted("known.csv");
    const Nanoseconds start = fromSeconds(1'700'000'003.5);
    for (Trajectory& trajectory : known->robots.front().trajectories)
        for (StampedPose& stamped : trajectory.poses)
            if (stamped.time > start) stamped.pose.x += 0.3;
    EXPECT_EQ(predicted("garbled.csv"), before);
    for (Trajectory& trajectory : known->robots.front().trajectories)
        for (StampedPose& stamped : trajectory.poses) stamped.pose.x += 0.3;
    EXPECT_NE(predicted("moved.csv"), before) << "what was known enters";
}

TEST_F(Judging, SamplesNeedANetworkThatKnowsItsNoise) {
    TrainRequest alone = training(log(), path("mean.net"));
    alone.noise = false;
    ASSERT_TRUE(trainNetwork(alone));
    PredictRequest request{path("mean.net"), log(), windows()};
    ASSERT_TRUE(predictWindows(request));
    request.samples = 2;
    expectError(predictWindows(request), path("mean.net"), {"knows its mean alone"});
    request.network = network();
    request.at = {10.5};
    expectError(predictWindows(request), "", {"at: 10.5 s is not within a window of 10"});
    request.at = {0.05};
    expectError(predictWindows(request), "", {"at: 0.05 s is no whole number of steps"});
}

TEST_F(Judging, PredictionIsEndedByItsProgress) {
    PredictRequest request{network(), log(), windows(), path("p.csv")};
    for (const double end : {0.0, 1.0})
        expectError(predictWindows(request, [end](double share) { return share < end; }), log(), {"cancelled"});
    EXPECT_EQ(read("p.csv"), "");
}

/// The log that ships, played by a scenario that is made for it.
CompareRequest shippedPioneer() {
    CompareRequest request{"", (sourceFolder() / "resources/logs/pioneer").string()};
    request.robotFile = "pioneer1.toml";
    request.duration = 10;
    return request;
}

TEST_F(Judging, ScenarioIsPutBesideItsLogWithDivergencesAndCauses) {
    CompareRequest request = shippedPioneer();
    request.divergence.position = 0.001;
    request.divergence.held = 0;
    double driven = 0, diagnosed = 0;
    const auto compared = compareLog(request, {[&](double share) {
                                                   EXPECT_EQ(diagnosed, 0)
                                                       << "causes are looked for in what was driven";
                                                   driven = share;
                                                   return true;
                                               },
                                               [&](double share) {
                                                   diagnosed = share;
                                                   return true;
                                               }});
    ASSERT_TRUE(compared) << compared.error().message();
    EXPECT_EQ(driven, 1);
    EXPECT_GT(diagnosed, 0.5);
    EXPECT_EQ(compared->comparison.requests.size(), 1u);
    EXPECT_TRUE(isSaid(compared->context.notices, "comes from a simulated robot"));
    ASSERT_EQ(compared->divergences.rollouts.size(), 1u);
    EXPECT_TRUE(compared->divergences.rollouts[0].diagnosis);
    request.divergence.noCauses = true;
    const auto without = compareLog(request);
    ASSERT_TRUE(without) << without.error().message();
    ASSERT_EQ(without->divergences.rollouts.size(), 1u);
    EXPECT_FALSE(without->divergences.rollouts[0].diagnosis);
}

TEST_F(Judging, ComparisonIsEndedWhileItDrivesAndWhileItLooksForCauses) {
    CompareRequest request = shippedPioneer();
    request.divergence.position = 0.001;
    request.divergence.held = 0;
    const auto never = [](double) { return false; };
    expectError(compareLog(request, {never, {}}), request.log, {"was not compared: cancelled"});
    expectError(compareLog(request, {{}, never}), request.log, {"was not compared: cancelled"});
}

TEST_F(Judging, WhatDoesNotFitAComparisonIsNamed) {
    CompareRequest request = shippedPioneer();
    request.divergence.models = {path("none.net")};
    bool driven = false;
    expectError(compareLog(request, {[&](double) { return driven = true; }, {}}), path("none.net"));
    EXPECT_FALSE(driven) << "before any work";
    request = shippedPioneer();
    request.robotFile = "none.toml";
    expectError(compareLog(request), "--robot none.toml", {"does not exist"});
    request = shippedPioneer();
    request.windows = allWindows;
    request.duration = 0.55;
    expectError(compareLog(request), "", {"--duration: 0.55 s is no whole number of steps"});
}

}  // namespace
}  // namespace mrose
