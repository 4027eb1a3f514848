#include "report/experiment_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "report/mean_figure.h"
#include "report/measure_label.h"
#include "report/program_json.h"
#include "report/sweep_figure.h"
#include "support/markup.h"

namespace mrose {
namespace {

using testing::HasSubstr;
using testing::Not;

MeasureSummary measured(const std::string& name, double mean, double low, double high, bool share = false) {
    MeasureSummary measure;
    measure.name = name;
    measure.count = 40;
    measure.mean = mean;
    measure.share = share;
    measure.estimate = {mean, low, high};
    return measure;
}

VariantSummary variant(const std::string& name, double time, double share) {
    return {name,
            {},
            40,
            38,
            1,
            "a: failed (trial 7)",
            {measured("feature.asked", 7777, 7000, 8000), measured("measure.time <s>", time, time - 1, time + 2),
             measured("measure.done", share, share - 0.1, share + 0.1, true)}};
}

Experiment named() {
    Experiment experiment;
    experiment.file = "a&b.toml";
    experiment.name = "<ways>";
    experiment.firstTrial = 11;
    experiment.trials = 20;
    experiment.seeds = 2;
    return experiment;
}

TEST(ExperimentReport, VariantsStandBesideEachOtherInTableAndPictures) {
    ExperimentSummary summary;
    summary.variants = {variant("slow & <sure>", 23.456, 0.25), variant("fast", 12.5, 0.5)};
    ReportContext context;
    context.commandLine = "mrose experiment 'x' > y";
    const std::string html = experimentReport(named(), summary, context);
    EXPECT_EQ(markupError(html), "");
    for (const char* const raw : {"<ways>", "a&b.toml", "time <s>", "& <sure>", "7777"})
        EXPECT_THAT(html, Not(HasSubstr(raw)));
    for (const char* const text :
         {"&lt;ways&gt;", "a&amp;b.toml", "trials 11 to 30", "2 runs", "time &lt;s&gt;", "slow &amp; &lt;sure&gt;",
          "23.46 <small>22.46 to 25.46</small>", "25.00 <small>15.00 to 35.00</small>", "done (%)",
          "fast: 1 of 40 runs ended by a fault, the first: a: failed (trial 7)"})
        EXPECT_THAT(html, HasSubstr(text));
    EXPECT_EQ(countOf(html, "<svg class=\"plot\""), 2u) << "one for each measure, none for what was asked";
}

TEST(ExperimentReport, WhatWasSweptIsDrawnAsCurves) {
    ExperimentSummary summary;
    summary.variants = {variant("as it is", 20, 0.25)};
    for (const double at : {10.0, 0.0, 5.0}) {
        summary.variants.push_back(variant("loss " + std::to_string(at), 20 + at, 0.5));
        summary.variants.back().sweep = {"lost <messages>", "%", at};
        summary.variants.push_back(variant("error " + std::to_string(at), 10, 0.5));
        summary.variants.back().sweep = {"error", "cm", at};
    }
    for (VariantSummary& one : summary.variants) one.faulty = 0;
    const std::string html = experimentReport(named(), summary, {});
    EXPECT_EQ(markupError(html), "");
    EXPECT_EQ(countOf(html, "<svg class=\"plot\""), 6u)
        << "of each measure two curves, and the variant that is on none";
    EXPECT_EQ(countOf(html, "aria-label=\"time &lt;s&gt; over lost &lt;messages&gt; (%)\""), 1u);
    EXPECT_THAT(html, Not(HasSubstr("ended"))) << "no condition ends them";
    summary.until = true;
    EXPECT_THAT(experimentReport(named(), summary, {}), HasSubstr("ended"));
}

/// The number of an attribute of the first element that a text begins.
double attributeAfter(const std::string& svg, const std::string& element, const std::string& attribute) {
    const auto at = svg.find(' ' + attribute + "=\"", svg.find(element));
    return std::stod(svg.substr(at + attribute.size() + 3));
}

TEST(ExperimentReport, AxesOfSharesEndWhereSharesDo) {
    const NamedMean none{"none", {0, 0, 20}}, all{"all", {100, 80, 100}};
    const auto placeOf = [](std::initializer_list<NamedMean> means, PlotRange possible) {
        const std::string svg = meanFigure(std::vector(means), "done (%)", possible);
        return (attributeAfter(svg, "<circle", "cx") - attributeAfter(svg, "<svg x=", "x")) /
               attributeAfter(svg, "<svg x=", "width");
    };
    EXPECT_NEAR(placeOf({none, all}, {0, 100}), 0, 1e-4) << "the axis begins at 0 %";
    EXPECT_NEAR(placeOf({all, none}, {0, 100}), 1, 1e-4) << "and ends at 100 %";
    EXPECT_NEAR(placeOf({none, all}, anyRange), 0.08 / 1.16, 1e-4) << "else there is room beside it";
    const SweptMean swept[] = {{0, {0, 0, 20}}, {1, {100, 80, 100}}};
    const std::string curve = sweepFigure(swept, "x", "done (%)", {0, 100});
    EXPECT_NEAR(attributeAfter(curve, "<circle", "cy"),
                attributeAfter(curve, "<svg x=", "y") + attributeAfter(curve, "<svg x=", "height"), 0.01);
}

TEST(ExperimentReport, WhatIsLikeASharePerCentIsDrawnAsOne) {
    const auto beginOf = [](const std::string& name, double low) {
        ExperimentSummary summary;
        summary.variants = {variant("a", 20, 0.5), variant("b", 20, 0.5)};
        for (VariantSummary& one : summary.variants) one.measures = {measured("measure." + name, 0, low, 90)};
        const std::string html = experimentReport(named(), summary, {});
        return attributeAfter(html, "<circle", "cx") - attributeAfter(html, "<svg x=", "x");
    };
    EXPECT_NEAR(beginOf("none_percent", 0), 0, 0.01);
    EXPECT_GT(beginOf("time_s", 0), 10);
    EXPECT_GT(beginOf("gained_percent", -5), 10) << "a gain may be a loss";
}

TEST(SweepFigure, LeadsFromValueToValueInTheirOrder) {
    const SweptMean means[] = {{10, {4, 3, 5}}, {0, {1, 0, 2}}, {5, {}}};
    const std::string svg = sweepFigure(means, "x", "y");
    EXPECT_EQ(markupError(svg), "");
    EXPECT_EQ(countOf(svg, "class=\"mark\""), 2u);
    EXPECT_EQ(countOf(svg, "class=\"unreported\""), 1u) << "what is not known is a hollow mark";
    EXPECT_EQ(countOf(svg, "class=\"line s0\""), 2u) << "and no line leads across it";
    const SweptMean turned[] = {{0, {1, 0, 2}}, {5, {}}, {10, {4, 3, 5}}};
    EXPECT_EQ(svg, sweepFigure(turned, "x", "y"));
    EXPECT_EQ(markupError(sweepFigure({}, "x", "y")), "");
}

TEST(ExperimentReport, OfAMeasureThatIsNeverKnownSaysSo) {
    ExperimentSummary summary;
    summary.variants = {variant("slow", 20, 0.25), variant("fast", 10, 0.5)};
    for (VariantSummary& variant : summary.variants) {
        variant.measures[1].count = 0;
        variant.measures[1].estimate = {};
    }
    const std::string html = experimentReport(named(), summary, {});
    EXPECT_THAT(html, HasSubstr("Not known in any run."));
    EXPECT_THAT(html, Not(HasSubstr("time &lt;s&gt; (%)"))) << "which would be a share";
    EXPECT_EQ(countOf(html, "<svg class=\"plot\""), 1u);
}

TEST(MeasureLabel, UnitsAreWhatTheNameEndsIn) {
    EXPECT_EQ(measureLabel("time_s"), "time (s)");
    EXPECT_EQ(measureLabel("none_percent"), "none (%)");
    EXPECT_EQ(measureLabel("turned_in_all_deg"), "turned in all (°)");
    EXPECT_EQ(measureName("turned_in_all_deg"), "turned in all");
    EXPECT_EQ(measureName("at_walls"), "at walls");
    for (const char* const plain : {"goals", "s", "", "so-called"}) EXPECT_EQ(measureLabel(plain), plain);
}

TEST(ExperimentReport, WithoutVariantsItSaysHowMeasuresSpread) {
    ExperimentSummary summary;
    summary.variants = {variant("", 12.5, 0.5)};
    const std::string html = experimentReport(named(), summary, {});
    EXPECT_EQ(markupError(html), "");
    EXPECT_THAT(html, HasSubstr("11.50 to 14.50"));
    EXPECT_THAT(html, HasSubstr(">1 of 40 runs ended by a fault, the first: a: failed (trial 7)"));
    const auto json = nlohmann::json::parse(experimentJson(summary, "out"));
    ASSERT_EQ(json["variants"].size(), 1u);
    EXPECT_EQ(json["variants"][0]["first_fault"], "a: failed (trial 7)");
    EXPECT_EQ(countOf(html, "<svg class=\"plot\""), 0u);
}

}  // namespace
}  // namespace mrose
