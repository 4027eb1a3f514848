#include "report/task_report.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/format.h"
#include "report/legend.h"
#include "report/task_figures.h"

namespace mrose {
namespace {

constexpr const char* taskFiles[] = {"report.html", "predictions.csv"};
constexpr std::size_t worstShown = 8;
constexpr std::size_t inputsShown = 9;

std::string intervalOf(const Interval& interval, double factor, int decimals) {
    return cat(fixedWithMinus(factor * interval.low, decimals), " to ",
               fixedWithMinus(factor * interval.high, decimals));
}

std::string taskTiles(const TaskReport& report) {
    const TaskJudgement& judgement = report.judgement;
    const TaskScore& score = judgement.predictors.front().score;
    std::string all = tile("error, held out: sum of |error| over sum", fixed(100 * score.share, 2), "%",
                           cat("95 %: ", intervalOf(score.shareInterval, 100, 2), " %"));
    all += tile("mean absolute error", fixed(score.absolute, 3), "",
                cat("root mean square ", fixed(score.rootMeanSquare, 3), ", bias ", fixedWithMinus(score.bias, 3)));
    if (const auto& choice = judgement.predictors.front().choice) {
        const VariantChoice::Variant& best = choice->variants[choice->best];
        all += tile("better than the best variant alone", fixedWithMinus(best.gain, 3), "",
                    cat("95 %: ", intervalOf(best.gainInterval, 1, 3)));
        if (choice->oracle)
            all += tile("of the way to the best of each trial", fixedWithMinus(100 * choice->oracle->closed, 0), "%",
                        cat("95 %: ", intervalOf(choice->oracle->closedInterval, 100, 0), " %"));
    }
    all += tile("trials held out", std::to_string(judgement.heldOut.rows()), report.data.variants.empty() ? "rows" : "",
                cat("learned from ", std::to_string(judgement.learnedFrom)));
    return tileRow(all);
}

std::string scoreTable(const TaskJudgement& judgement) {
    HtmlTable table({{"", {"", "sum of |error| / sum, %", "95 %", "mean |error|", "rms", "bias"}}});
    for (std::size_t k = 0; k < judgement.predictors.size(); ++k) {
        const TaskScore& score = judgement.predictors[k].score;
        table.row({k + 1 < judgement.predictors.size() && k < 6 ? seriesName(judgement.predictors[k].name, k)
                                                                : escaped(judgement.predictors[k].name),
                   fixed(100 * score.share, 2), intervalOf(score.shareInterval, 100, 2), fixed(score.absolute, 3),
                   fixed(score.rootMeanSquare, 3), fixedWithMinus(score.bias, 3)});
    }
    return table.text();
}

std::string choiceSection(const TaskReport& report) {
    const auto& first = report.judgement.predictors.front().choice;
    if (!first) return {};
    HtmlTable table({{"",
                      {"", cat("mean ", escaped(report.data.target)), "sum of |error| / sum, %", "chosen in",
                       "what is learned is better by", "95 %, paired by trial"}}});
    for (const VariantChoice::Variant& variant : first->variants)
        table.row({escaped(variant.name), fixed(variant.mean, 3), fixed(100 * variant.share, 2),
                   counted(variant.chosen, "trial"), fixedWithMinus(variant.gain, 3),
                   intervalOf(variant.gainInterval, 1, 3)});
    for (const TaskJudgement::Predictor& predictor : report.judgement.predictors)
        if (predictor.choice)
            table.row({cat("chosen as learned: ", escaped(predictor.name)), fixed(predictor.choice->mean, 3), "", "",
                       "",
                       predictor.choice->oracle
                           ? cat(fixedWithMinus(100 * predictor.choice->oracle->closed, 0), "\u00a0% of the way")
                           : ""});
    if (first->oracle)
        table.row({"best of each trial", fixed(first->oracle->mean, 3), "",
                   cat("as learned in ", fixed(100 * first->oracle->agrees, 0), "\u00a0%"), "", ""});
    return cat(
        heading("Choosing by it"),
        paragraph(cat("For each trial the variant is taken of which it expects the best. The best variant alone is "
                      "the one that was best in the trials learned from: <b>",
                      escaped(first->variants[first->best].name),
                      "</b>. The best of each trial is found by one half of its seeds and judged by the other, and "
                      "the other way round: who knew the trials beforehand could reach it.")),
        element("div", "card", choiceFigure(report.judgement)), tableCard(table.text()));
}

std::string errorSection(const TaskReport& report) {
    std::string predictions, inputs;
    const TaskData& data = report.data;
    for (std::size_t k = 0; k < std::min<std::size_t>(data.outputs(), 6); ++k)
        predictions += card(escaped(data.variants.empty() ? data.target : data.variants[k]),
                            predictionFigure(report.judgement, k));
    std::vector<std::size_t> order = inputsByError(report.judgement);
    const std::size_t all = order.size();
    order.resize(std::min(all, inputsShown));
    for (const std::size_t i : order) inputs += card(escaped(data.inputs[i]), inputErrorFigure(report.judgement, i));
    return cat(heading("What it says, and what it came to"),
               paragraph("A dot is a row that is held out; on the dashed diagonal the prediction is right."),
               element("div", "paths", predictions), heading("Where it errs"),
               paragraph(cat("Mean absolute errors over tenths of the rows, by what an input was, rows with the same "
                             "value together",
                             order.size() < all ? cat(": of the ", std::to_string(order.size()), " of ",
                                                      std::to_string(all), " inputs along which they differ most.")
                                                : ".")),
               inputErrorLegend(report.judgement), element("div", "paths", inputs));
}

std::string worstSection(const TaskReport& report) {
    const TaskData& held = report.judgement.heldOut;
    const std::vector<double>& predicted = report.judgement.predictors.front().predicted;
    std::vector<std::size_t> order(held.y.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return std::abs(predicted[i] - held.y[i]); });
    if (order.empty() || held.window.empty()) return {};
    order.resize(std::min(order.size(), worstShown));
    HtmlTable table({{"", {"trial", "simulated", "predicted", "opens it"}}}, "files");
    for (const std::size_t i : order) {
        const std::size_t row = i / held.outputs();
        const std::string variant = held.variants.empty() ? "" : cat(", ", escaped(held.variants[i % held.outputs()]));
        table.row({cat(std::to_string(held.trial[row]), variant), fixed(held.y[i], 3), fixed(predicted[i], 3),
                   cat("<code>", escaped(held.window[i]), "</code>")});
    }
    return cat(heading("The trials that it predicts worst"), tableCard(table.text()));
}

std::string taskProvenance(const TaskReport& report, const ReportContext& context) {
    HtmlTable facts({{"", {"", ""}}}, "words");
    facts.row({"network", cat("<code>", escaped(report.file), "</code>")});
    facts.row({"learned from", cat("<code>", escaped(report.results), "</code>")});
    const auto listed = [](const std::vector<std::string>& names) {
        std::string text;
        for (const std::string& name : names) text += cat(text.empty() ? "" : ", ", escaped(name));
        return text;
    };
    facts.row({"inputs", listed(report.data.inputs)});
    facts.row({"target", report.data.variants.empty()
                             ? escaped(report.data.target)
                             : cat(escaped(report.data.target), " of ", listed(report.data.variants))});
    facts.row({"held out", "every fifth trial, whole: with all its seeds and variants"});
    facts.row(
        {"left out", cat(std::to_string(report.data.unfinished), " runs not ended by <code>until</code>, ",
                         std::to_string(report.data.faulty), " with faults, ", std::to_string(report.data.unknown),
                         report.data.variants.empty() ? " whose target or an input is not a number"
                                                      : " trials without all their runs")});
    addModelFacts(facts, context);
    if (!context.commandLine.empty()) facts.row({"made by", cat("<code>", escaped(context.commandLine), "</code>")});
    return cat(heading("Where this comes from"), tableCard(facts.text()));
}

}  // namespace

std::string taskReportHtml(const TaskReport& report, const ReportContext& context) {
    const std::string title = cat("What is known of ", escaped(report.data.target), " beforehand");
    return reportPage(
        title,
        cat(pageHead(
                title, "learned of an experiment", {report.results, true, "trials"}, context,
                {"All trials are simulated. Nothing here says how true that is of a real robot: mrose validate asks "
                 "that."}),
            taskTiles(report), tableCard(scoreTable(report.judgement)), choiceSection(report), errorSection(report),
            worstSection(report), taskProvenance(report, context)));
}

std::string taskPredictionsCsv(const TaskJudgement& judgement) {
    const TaskData& held = judgement.heldOut;
    std::string text = "trial,variant";
    for (const std::string& input : held.inputs) text += cat(",", csvCell(input));
    text += cat(",", csvCell(held.target));
    for (const TaskJudgement::Predictor& predictor : judgement.predictors)
        text += cat(",", csvCell(cat("predicted.", predictor.name)));
    text += '\n';
    for (std::size_t i = 0; i < held.y.size(); ++i) {
        const std::size_t row = i / held.outputs();
        text += std::to_string(held.trial[row]);
        text += ',';
        if (!held.variants.empty()) text += csvCell(held.variants[i % held.outputs()]);
        for (std::size_t k = 0; k < held.inputs.size(); ++k) text += cat(",", numberText(held.inputsOf(row)[k]));
        text += cat(",", numberText(held.y[i]));
        for (const TaskJudgement::Predictor& predictor : judgement.predictors)
            text += cat(",", numberText(predictor.predicted[i]));
        text += '\n';
    }
    return text;
}

Expected<void> checkTaskReportFolder(const std::filesystem::path& folder, bool overwrite) {
    return checkReportFolder(folder, taskFiles, overwrite);
}

Expected<void> writeTaskReport(const TaskReport& report, const ReportContext& context,
                               const std::filesystem::path& folder) {
    return writeReportFiles(folder, {{taskFiles[0], taskReportHtml(report, context)},
                                     {taskFiles[1], taskPredictionsCsv(report.judgement)}});
}

}  // namespace mrose
