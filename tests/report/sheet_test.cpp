#include "report/sheet.h"

#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "assessment/test_models.h"
#include "io/format.h"
#include "motion/noisy_model.h"
#include "support/markup.h"

namespace mrose {
namespace {

using testing::HasSubstr;
using testing::Not;

Command toAndFro(double t) { return {0.2, std::fmod(t, 20) < 10 ? 0.4 : -0.3}; }

/// A model with a noise of its own, on a log of 12 windows.
struct Sheet {
    Evaluation evaluation;
    ReportContext context;
    std::string page() const { return sheetHtml(evaluation, context); }
};
Sheet madeSheet(double strayed = 0.2) {
    Log log = logOf({obedientTrajectory(0, 125 * second, toAndFro)});
    log.source = "a <log>";
    const auto mean = std::make_shared<const HeldCommandModel>(second / 10, 1.02);
    const NoisyModel noisy(mean, {strayed, strayed, strayed});
    const std::vector<NamedModel> models{NamedModel::same("mine.net", *mean)};
    Sheet sheet{*evaluate(log, models), {}};
    sheet.context.advice = DriveAdvice{{}, {}, {}, "no logs"};
    const SampledModel sampled{NamedModel::same("mine.net", noisy), models.front(), 0, 20};
    sheet.evaluation.forecasts = *forecast(log, sheet.evaluation.log, {&sampled, 1});
    sheet.context.unfamiliar.assign(sheet.evaluation.log.windows.size(), 0.0);
    return sheet;
}

TEST(Sheet, IsWellFormedAndHoldsTheNumbers) {
    Sheet sheet = madeSheet();
    sheet.context.advice =
        DriveAdvice{"120 s, in 2 x 3 m", {"40 s: turns <faster> than the logs"}, "mrose advise mine.net", {}};
    const std::string page = sheet.page();
    EXPECT_EQ(markupError(page), "");
    const Summary& all = sheet.evaluation.models.front().all;
    EXPECT_THAT(page, HasSubstr("P " + fixed(all.p, 2) + "\u00a0%"));
    EXPECT_THAT(page, HasSubstr("a &lt;log&gt;"));
    EXPECT_THAT(page, HasSubstr("turns &lt;faster&gt; than the logs"));
    EXPECT_THAT(page, HasSubstr("No window has more than 10\u00a0% that is driven as it was never learned."));
    EXPECT_THAT(page, Not(HasSubstr("nan")));
}

TEST(Sheet, SaysWhereNotToTrustIt) {
    Sheet sheet = madeSheet();
    EXPECT_THAT(sheet.page(), Not(HasSubstr("driven as it was never learned</span>")));
    for (double& share : sheet.context.unfamiliar) share = 0.5;
    EXPECT_THAT(sheet.page(), HasSubstr("driven as it was never learned</span>"));
    EXPECT_THAT(sheet.page(),
                HasSubstr("12 windows of 12 have more than 10\u00a0% that is driven as it was never learned."));
    EXPECT_THAT(sheet.page(), HasSubstr("no logs"));
    // The real robot is off by 2 % of its way, and runs hardly differ.
    EXPECT_THAT(madeSheet(1e-4).page(), HasSubstr("surer than it should be"));
}

TEST(Sheet, SaysWhatIsNotKnown) {
    Sheet sheet = madeSheet();
    sheet.evaluation.forecasts.clear();
    sheet.context.unfamiliar.clear();
    const std::string page = sheet.page();
    EXPECT_EQ(markupError(page), "");
    EXPECT_THAT(page, HasSubstr("It does not know how far they may differ."));
    EXPECT_THAT(page, HasSubstr("It does not know where it was learned."));
}

}  // namespace
}  // namespace mrose
