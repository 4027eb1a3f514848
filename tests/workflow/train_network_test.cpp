#include "workflow/train_network.h"

#include "support/workshop.h"
#include "workflow/expect_error.h"

namespace mrose {
namespace {

using TrainWorkflow = Workshop;

TEST_F(TrainWorkflow, NetworkIsGivenAndWritten) {
    TrainRequest request = training(log(), path("b.net"));
    request.command = "as I say";
    const auto trained = trainNetwork(request);
    ASSERT_TRUE(trained) << trained.error().message();
    EXPECT_FALSE(trained->cancelled);
    EXPECT_EQ(trained->network.training.command, "as I say");
    ASSERT_EQ(trained->network.training.logs.size(), 1u);
    EXPECT_EQ(trained->network.training.logs[0].path, log());
    const auto written = loadNetwork(path("b.net"));
    ASSERT_TRUE(written) << written.error().message();
    EXPECT_TRUE(*written == trained->network);
}

TEST_F(TrainWorkflow, SaysWhetherTheNoiseIsOfRobotsThatTheNetworkKnows) {
    const auto alone = trainNetwork(training(log(), ""));
    ASSERT_TRUE(alone) << alone.error().message();
    ASSERT_TRUE(alone->network.noise) << alone->withoutNoise;
    EXPECT_TRUE(alone->noiseOfKnownRobots);
    TrainRequest three = training(log(), "");
    for (const char* const robot : {"second", "third"}) {
        std::string text = read("log.csv");
        for (std::size_t at = 0; (at = text.find("planted", at)) != std::string::npos;) text.replace(at, 7, robot);
        three.logs.sources.push_back(write(robot + std::string(".csv"), text));
    }
    const auto team = trainNetwork(three);
    ASSERT_TRUE(team) << team.error().message();
    ASSERT_TRUE(team->network.noise) << team->withoutNoise;
    EXPECT_FALSE(team->noiseOfKnownRobots);
    const ProgramResult shown = runMrose(trainWords(path("x.net")));
    EXPECT_NE(shown.out.find("Note: the logs have fewer than three robots: the noise is "), std::string::npos)
        << shown.out;
}

TEST_F(TrainWorkflow, WithoutAnOutputNothingIsWritten) {
    const std::string from = log();
    const auto before = listing();
    EXPECT_TRUE(trainNetwork(training(from, "")));
    EXPECT_EQ(listing(), before);
}

TEST_F(TrainWorkflow, OutputMustBeFreeAndNoneOfTheLogs) {
    const std::string there = write("there.net", "earlier");
    expectError(trainNetwork(training(log(), there)), there, {"is there already"});
    EXPECT_EQ(read("there.net"), "earlier");
    TrainRequest request = training(log(), log());
    request.overwrite = true;
    expectError(trainNetwork(request), log(), {"is read by this command"});
}

TEST_F(TrainWorkflow, CancelledWhileItLearnsTheBestSoFarIsKept) {
    TrainRequest request = training(log(), path("b.net"));
    request.epochs = 10'000'000;
    const auto trained = trainNetwork(request, {{}, [](const NetworkProgress&) { return false; }});
    ASSERT_TRUE(trained) << trained.error().message();
    EXPECT_TRUE(trained->cancelled);
    EXPECT_TRUE(loadNetwork(path("b.net")));
}

TEST_F(TrainWorkflow, CancelledBeforeItLearnsThereIsNone) {
    for (const double end : {0.0, 1.0}) {
        const auto trained =
            trainNetwork(training(log(), path("b.net")), {{}, {}, [end](double share) { return share < end; }});
        expectError(trained, log(), {"cancelled"});
    }
    EXPECT_EQ(read("b.net"), "");
}

TEST_F(TrainWorkflow, WhatIsMissingIsKnownBeforeItLearns) {
    std::vector<std::string> notes;
    bool learns = false;
    const auto trained = trainNetwork(training(write("cut.csv", plantedCsv() + "1700000200.0,0.1"), ""),
                                      {[&](const std::vector<std::string>& missing) {
                                           notes = missing;
                                           EXPECT_FALSE(learns);
                                       },
                                       [&](const NetworkProgress&) { return learns = true; }});
    ASSERT_TRUE(trained) << trained.error().message();
    EXPECT_TRUE(learns);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(notes[0].find("cut off"), std::string::npos) << notes[0];
}

TEST_F(TrainWorkflow, PhasesDivideTheControlPeriod) {
    TrainRequest request = training(log(), "");
    request.phases = 3;
    expectError(trainNetwork(request), "", {"--phases 3: do not divide the control period of 0.1 s evenly"});
}

TEST_F(TrainWorkflow, LevenbergMarquardtNeedsSingleSteps) {
    TrainRequest request = training(log(), "");
    request.method = TrainingMethod::levenbergMarquardt;
    expectError(trainNetwork(request), "", {"--method lm: fits single steps only"});
    request.recipe = NetworkRecipe::paper;
    EXPECT_TRUE(checkTogether(request));
    request.recipe = {};
    request.loss = LearningLoss::oneStep;
    const auto trained = trainNetwork(request);
    ASSERT_TRUE(trained) << trained.error().message();
    EXPECT_EQ(trained->network.training.method, "lm");
}

TEST_F(TrainWorkflow, RequestPrevailsOverTheRecipe) {
    TrainRequest request = training(log(), "");
    request.recipe = NetworkRecipe::paper;
    request.hidden = 5;
    request.lagV = 0.25;
    const auto trained = trainNetwork(request);
    ASSERT_TRUE(trained) << trained.error().message();
    EXPECT_EQ(trained->network.mlp.shape.hidden, 5);
    EXPECT_TRUE(trained->network.form == MotionNetwork::Form::state);
}

}  // namespace
}  // namespace mrose
