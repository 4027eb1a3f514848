#include "support/referee.h"

#include <filesystem>

#include <gtest/gtest.h>
#include <unistd.h>

#include "assessment/evaluate.h"
#include "assessment/prediction_files.h"
#include "assessment/test_models.h"
#include "io/file.h"
#include "logs/log_reader.h"
#include "support/test_data.h"

namespace mrose {
namespace {

struct Case {
    int dataset;
    std::string robots;
};

class Referee : public testing::TestWithParam<Case> {
protected:
    void SetUp() override {
        const auto data = realData();
        const auto command = referee();
        if (!data) GTEST_SKIP() << "no real logs: set MROSE_DATA";
        if (!command) GTEST_SKIP() << "no referee with numpy: set MROSE_REFEREE";
        const std::string folder = "MRCLAM_Dataset" + std::to_string(GetParam().dataset);
        if (!std::filesystem::is_directory(*data / "mrclam" / folder)) GTEST_SKIP() << "no " << folder;
        tail_ = " '" + (*data / "mrclam").string() + "' --dataset " + std::to_string(GetParam().dataset) +
                " --robots " + GetParam().robots;
        command_ = *command;
        auto log = readLog(*data / "mrclam" / folder);
        ASSERT_TRUE(log) << log.error().message();
        log_ = std::move(*log);
        std::stringstream list(GetParam().robots);
        for (std::string robot; std::getline(list, robot, ',');) robots_.push_back(robot);
    }

    std::optional<std::string> ask(const std::string& what, const std::string& file = {}) const {
        return outputOf(command_ + " " + what + tail_ + " " + file);
    }

    Log log_;
    std::vector<std::string> robots_;

private:
    std::string command_, tail_;
};

TEST_P(Referee, HasTheSameWindows) {
    const HeldCommandModel model{100'000'000};
    const NamedModel named = NamedModel::same("any", model);
    const auto evaluation = evaluate(log_, {&named, 1}, {.robots = robots_, .withFloor = false});
    ASSERT_TRUE(evaluation) << evaluation.error().message();
    const auto theirs = ask("windows");
    ASSERT_TRUE(theirs);
    const auto requests = parseWindows(*theirs, "referee"), ours = parseWindows(windowsCsv(evaluation->log), "ours");
    ASSERT_TRUE(requests && ours);
    ASSERT_EQ(requests->size(), ours->size());
    for (std::size_t i = 0; i < ours->size(); ++i) {
        EXPECT_EQ((*requests)[i].robot, (*ours)[i].robot);
        EXPECT_EQ((*requests)[i].start, (*ours)[i].start);
    }
}

TEST_P(Referee, FindsTheSameErrors) {
    // The command in force is followed exactly: a period of 10 ms, shorter than those between commands.
    const HeldCommandModel model{10'000'000};
    const NamedModel named = NamedModel::same("velocity = command", model);
    const auto evaluation = evaluate(log_, {&named, 1}, {.robots = robots_, .withFloor = false});
    ASSERT_TRUE(evaluation) << evaluation.error().message();
    RequestedStarts requested{rolloutStarts(log_, evaluation->log.windows), {}};
    for (const Window& window : evaluation->log.windows) requested.robots.push_back(window.robot);
    PredictionsCsv rows(log_, requested, 100'000'000, false, {});
    rows.add(evaluation->models[0].predicted);
    const auto file = std::filesystem::temp_directory_path() / ("mrose_referee_" + std::to_string(getpid()) + ".csv");
    ASSERT_TRUE(writeFileAtomically(file, rows.text()));
    const auto verdict = ask("score", "'" + file.string() + "'");
    std::filesystem::remove(file);
    ASSERT_TRUE(verdict);
    const Summary& all = evaluation->models[0].all;
    EXPECT_EQ(numberAfter(*verdict, "windows "), static_cast<double>(all.windows)) << *verdict;
    // Its figures are rounded to 0.01.
    EXPECT_NEAR(numberAfter(*verdict, "P "), all.p, 0.01);
    EXPECT_NEAR(numberAfter(*verdict, "Hd "), all.hd, 0.01);
    const auto line = [&](const std::string& label) { return verdict->substr(verdict->find(label)); };
    const auto expectLine = [&](const std::string& label, const Distribution& ours, double unit) {
        EXPECT_NEAR(numberAfter(line(label), "median"), unit * ours.median, 0.015) << label;
        EXPECT_NEAR(numberAfter(line(label), "mean "), unit * ours.mean, 0.015) << label;
        EXPECT_NEAR(numberAfter(line(label), "p90"), unit * ours.p90, 0.03) << label;
    };
    expectLine("position, final [cm]", all.positionFinal, 100);
    expectLine("position, final / path [%]", all.positionFinalOverPath, 1);
    expectLine("heading, final [deg]", all.headingFinal, 180 / std::numbers::pi);
    if (GetParam().dataset == 7) {
        // The published study's figures for velocity = command.
        EXPECT_NEAR(all.p, 6.70, 0.15);
        EXPECT_NEAR(all.hd, 6.77, 0.15);
    }
}

INSTANTIATE_TEST_SUITE_P(Mrclam, Referee, testing::Values(Case{6, "1,2,3,4,5"}, Case{7, "1,2"}),
                         [](const auto& test) { return "Dataset" + std::to_string(test.param.dataset); });

}  // namespace
}  // namespace mrose
