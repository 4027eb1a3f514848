#include "report/task_report.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/format.h"
#include "report/task_figures.h"
#include "support/markup.h"
#include "tasks/task_learning.h"
#include "world/noise.h"

namespace mrose {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Trials in which one variant costs a, the other 1 - a, with a little noise of two seeds.
TaskData crossing() {
    TaskData data{.inputs = {"a<b>", "same"}, .target = "cost & time", .variants = {"<up>", "down"}};
    data.seeds = 2;
    for (std::uint32_t trial = 1; trial <= 300; ++trial) {
        const double a = uniformNoise({1, trial, 0, 0});
        double sums[2] = {};
        for (std::uint32_t seed = 0; seed < 2; ++seed)
            for (std::uint32_t k = 0; k < 2; ++k) {
                const double cost = (k == 0 ? a : 1 - a) + 0.01 * normalNoise({2, trial, seed, k});
                data.bySeed.push_back(cost);
                sums[k] += cost / 2;
            }
        data.y.insert(data.y.end(), sums, sums + 2);
        data.x.insert(data.x.end(), {a, 7.0});
        data.trial.push_back(trial);
        for (const char* const variant : {"one", "other"})
            data.window.push_back("mrose-gui 'x <y>' --trial " + std::to_string(trial) + " --variant " + variant);
    }
    return data;
}

class TaskReportTest : public testing::Test {
protected:
    TaskReportTest() {
        network_ = *learnTask(data_, {.hidden = 6, .members = 2});
        judgement_ = judge(data_, {network_});
        context_.commandLine = "mrose learn 'x' > y";
    }
    TaskReport report() const { return {"<results>.csv", "of<task>.net", network_, data_, judgement_}; }

    const TaskData data_ = crossing();
    TaskNetwork network_;
    TaskJudgement judgement_;
    ReportContext context_;
};

TEST_F(TaskReportTest, IsWellFormedAndEscapesAllText) {
    const std::string html = taskReportHtml(report(), context_);
    EXPECT_EQ(markupError(html), "");
    for (const char* raw : {"<up>", "a<b>", "cost & time", "<results>", "<task>", "'x <y>'"})
        EXPECT_THAT(html, Not(HasSubstr(raw)));
    for (const char* text :
         {"&lt;up&gt;", "a&lt;b&gt;", "cost &amp; time", "&#39;x&#39; &gt; y", "&#39;x &lt;y&gt;&#39; --trial"})
        EXPECT_THAT(html, HasSubstr(text));
}

TEST_F(TaskReportTest, HoldsTheFiguresAndThePictures) {
    const std::string html = taskReportHtml(report(), context_);
    const VariantChoice& choice = *judgement_.predictors[0].choice;
    EXPECT_NEAR(choice.mean, 0.25, 0.02) << "the mean of the less of a and 1 - a";
    EXPECT_THAT(html, HasSubstr("<b>" + std::string(choice.best == 0 ? "&lt;up&gt;" : "down") + "</b>"));
    for (const double shown : {choice.mean, choice.oracle->mean, choice.variants[0].mean, choice.variants[1].gain})
        EXPECT_THAT(html, HasSubstr(fixed(shown, 3)));
    EXPECT_THAT(html, HasSubstr(fixed(100 * judgement_.predictors[0].score.share, 2)));
    // the choice, two outputs, and the one input that is not always the same
    EXPECT_EQ(countOf(html, "<svg class=\"plot\""), 4u);
    EXPECT_EQ(countOf(html, "--trial"), 8u) << "the trials predicted worst";
}

TEST_F(TaskReportTest, OfManyInputsThoseAreDrawnAlongWhichErrorsDiffer) {
    TaskJudgement judgement = judgement_;
    TaskData& held = judgement.heldOut;
    const std::size_t rows = held.rows(), inputs = 30;
    // Errors grow along input 7; all others are in no order.
    held.inputs.clear();
    held.x.clear();
    for (std::size_t i = 0; i < inputs; ++i) held.inputs.push_back("input " + std::to_string(i));
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t i = 0; i < inputs; ++i)
            held.x.push_back(i == 7
                                 ? static_cast<double>(row)
                                 : uniformNoise({3, static_cast<std::int64_t>(row), static_cast<std::uint32_t>(i), 0}));
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t o = 0; o < 2; ++o)
            judgement.predictors[0].predicted[2 * row + o] = held.y[2 * row + o] + 0.01 * static_cast<double>(row);
    const std::vector<std::size_t> order = inputsByError(judgement);
    ASSERT_EQ(order.size(), inputs);
    EXPECT_EQ(order.front(), 7u);
    const std::string html = taskReportHtml({"r.csv", "t.net", network_, held, judgement}, context_);
    EXPECT_EQ(countOf(html, "<svg class=\"plot\""), 3u + 9u);
    EXPECT_THAT(html, HasSubstr("the 9 of 30 inputs"));
}

/// Errors of a half with one value are those of all of it, whichever of its rows are in which tenth.
TEST_F(TaskReportTest, RowsWithTheSameInputAreOneGroup) {
    TaskJudgement judgement = judgement_;
    TaskData& held = judgement.heldOut;
    held.inputs = {"box", "in no order"};
    held.x.clear();
    for (std::size_t row = 0; row < held.rows(); ++row) {
        const std::size_t half = row % 2;
        // Errors are 1 and 3 of the one half in turn, 2 of the other.
        const double error = half == 1 ? 2 : row / 2 < held.rows() / 4 ? 1 : 3;
        for (std::size_t o = 0; o < 2; ++o)
            judgement.predictors[0].predicted[2 * row + o] = held.y[2 * row + o] + error;
        held.x.push_back(static_cast<double>(half));
        held.x.push_back(uniformNoise({3, static_cast<std::int64_t>(row), 0, 0}));
    }
    EXPECT_EQ(inputsByError(judgement).front(), 1u) << "along the first nothing differs";
    const std::string figure = inputErrorFigure(judgement, 0);
    const std::size_t line = figure.find("class=\"line ");
    ASSERT_NE(line, figure.npos) << figure;
    const std::size_t tag = figure.rfind("<path", line);
    const std::string path = figure.substr(tag, figure.find('>', tag) - tag);
    EXPECT_EQ(std::ranges::count(path, 'M') + std::ranges::count(path, 'L'), 2) << path;
}

TEST_F(TaskReportTest, PredictionsAreOfAllThatIsHeldOut) {
    const std::string csv = taskPredictionsCsv(judgement_);
    EXPECT_TRUE(csv.starts_with("trial,variant,a<b>,same,cost & time,predicted.network,predicted.mean of all\n5,<up>,"))
        << csv.substr(0, 100);
    EXPECT_EQ(countOf(csv, "\n"), 1u + 60 * 2);
}

}  // namespace
}  // namespace mrose
