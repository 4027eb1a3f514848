#include "report/experiment_report.h"

#include <algorithm>
#include <cmath>

#include "io/format.h"
#include "report/mean_figure.h"
#include "report/measure_label.h"
#include "report/sweep_figure.h"

namespace mrose {
namespace {

constexpr std::string_view ofMeasures = "measure.";

/// Of a share in percent.
double factorOf(const MeasureSummary& measure) { return measure.share ? 100 : 1; }
/// With some four digits.
std::string numberOf(double value) {
    if (!std::isfinite(value)) return "";
    const double size = std::abs(value);
    return fixedWithMinus(value, size >= 1000               ? 0
                                 : size >= 100              ? 1
                                 : size >= 10               ? 2
                                 : size >= 0.1 || size == 0 ? 3
                                                            : 5);
}

/// As people read it.
std::string labelOf(std::string_view name, bool share) {
    return share ? cat(measureName(name), " (%)") : measureLabel(name);
}

/// Of a measure of that place in all variants; a share where it is one in all.
struct Column {
    std::string label;
    bool share = true;
    std::vector<NamedMean> means;

    /// Where such means can be: shares, and what is like them.
    PlotRange possible() const {
        constexpr PlotRange percent{0, 100};
        const auto isIn = [&](double value) { return !(value < percent.low || value > percent.high); };
        const bool alike = label.ends_with("(%)") && std::ranges::all_of(means, [&](const NamedMean& one) {
                               return isIn(one.mean.value) && isIn(one.mean.low) && isIn(one.mean.high);
                           });
        return alike ? percent : anyRange;
    }
};

Column columnOf(const ExperimentSummary& summary, std::size_t place) {
    Column column;
    bool known = false;
    for (const VariantSummary& variant : summary.variants) {
        known = known || variant.measures[place].count > 0;
        column.share = column.share && (variant.measures[place].share || variant.measures[place].count == 0);
    }
    column.share = column.share && known;
    for (const VariantSummary& variant : summary.variants) {
        Estimate mean = variant.measures[place].estimate;
        if (column.share) mean = {100 * mean.value, 100 * mean.low, 100 * mean.high};
        column.means.push_back({variant.name, mean});
    }
    column.label = labelOf(summary.variants.front().measures[place].name.substr(ofMeasures.size()), column.share);
    return column;
}

/// Over what was swept a curve for each sweep; below them a row for each of the other variants.
std::string figuresOf(const ExperimentSummary& summary, const Column& column) {
    if (std::ranges::none_of(column.means, [](const NamedMean& one) { return std::isfinite(one.mean.value); }))
        return paragraph("Not known in any run.");
    std::vector<NamedMean> rows;
    std::vector<std::string> titles;
    std::vector<std::vector<SweptMean>> curves;
    for (std::size_t v = 0; v < summary.variants.size(); ++v) {
        const std::optional<SweepPoint>& sweep = summary.variants[v].sweep;
        if (!sweep) {
            rows.push_back(column.means[v]);
            continue;
        }
        const std::string title = sweep->unit.empty() ? sweep->name : cat(sweep->name, " (", sweep->unit, ")");
        const auto curve = static_cast<std::size_t>(std::ranges::find(titles, title) - titles.begin());
        if (curve == titles.size()) titles.push_back(title), curves.emplace_back();
        curves[curve].push_back({sweep->at, column.means[v].mean});
    }
    std::string figures;
    for (std::size_t i = 0; i < titles.size(); ++i)
        figures += sweepFigure(curves[i], titles[i], column.label, column.possible());
    if (titles.size() > 1) figures = element("div", "pair", figures);
    return cat(figures, rows.empty() ? "" : meanFigure(rows, column.label, column.possible()));
}

std::string meansTable(const ExperimentSummary& summary, const std::vector<Column>& columns) {
    std::vector<std::string> heads{""};
    for (const Column& column : columns) heads.push_back(escaped(column.label));
    heads.emplace_back("runs");
    if (summary.until) heads.emplace_back("ended");
    heads.emplace_back("faults");
    HtmlTable table({{"", heads}});
    for (std::size_t v = 0; v < summary.variants.size(); ++v) {
        const VariantSummary& variant = summary.variants[v];
        std::vector<std::string> cells{variant.name.empty() ? "all runs" : escaped(variant.name)};
        for (const Column& column : columns) {
            const Estimate& mean = column.means[v].mean;
            cells.push_back(cat(numberOf(mean.value),
                                std::isfinite(mean.low)
                                    ? cat(" <small>", numberOf(mean.low), " to ", numberOf(mean.high), "</small>")
                                    : ""));
        }
        cells.push_back(std::to_string(variant.runs));
        if (summary.until) cells.push_back(std::to_string(variant.ended));
        cells.push_back(std::to_string(variant.faulty));
        table.row(cells);
    }
    return table.text();
}

/// How a measure spreads, of an experiment without variants.
std::string spreadTable(const VariantSummary& all) {
    HtmlTable table({{"", {"", "mean", "95 % interval", "deviation", "least", "most", "of runs"}}});
    for (const MeasureSummary& measure : all.measures) {
        const double factor = factorOf(measure);
        const auto number = [&](double value) { return measure.count > 0 ? numberOf(factor * value) : ""; };
        table.row({escaped(labelOf(measure.name, measure.share)), number(measure.mean),
                   cat(number(measure.estimate.low), " to ", number(measure.estimate.high)), number(measure.deviation),
                   number(measure.least), number(measure.most), std::to_string(measure.count)});
    }
    return table.text();
}

}  // namespace

std::string experimentReport(const Experiment& experiment, const ExperimentSummary& summary,
                             const ReportContext& context) {
    std::vector<Column> columns;
    for (std::size_t i = 0; i < summary.variants.front().measures.size(); ++i)
        if (summary.variants.front().measures[i].name.starts_with(ofMeasures)) columns.push_back(columnOf(summary, i));
    std::string body = element("h1", "", cat(escaped(experiment.name), "<span class=\"badge\">simulated</span>"));
    body += element(
        "p", "sub",
        cat("experiment <code>", escaped(experiment.file), "</code>, trials ", std::to_string(experiment.firstTrial),
            " to ", std::to_string(experiment.firstTrial + experiment.trials - 1), ", ",
            counted(experiment.seeds, "run"), " each", context.program.empty() ? "" : " · ", escaped(context.program)));
    for (const std::string& notice : context.notices) body += element("p", "notice", escaped(notice));
    for (const VariantSummary& variant : summary.variants)
        if (variant.faulty > 0)
            body += element(
                "p", "notice",
                escaped(cat(variant.name, variant.name.empty() ? "" : ": ", std::to_string(variant.faulty), " of ",
                            counted(variant.runs, "run"), " ended by a fault, the first: ", variant.firstFault)));
    if (summary.variants.size() > 1) {
        body += heading("What it comes to");
        for (const Column& column : columns) body += card(escaped(column.label), figuresOf(summary, column));
        body += tableCard(meansTable(summary, columns));
    } else {
        body += cat(heading("What it comes to"), tableCard(spreadTable(summary.variants.front())));
    }
    body += cat(heading("What the numbers mean"),
                paragraph("Means over all runs in which the measure is known. Intervals, and bands around curves, are "
                          "of 95\u00a0%, over trials: runs of a trial count as one; of shares by Wilson’s interval. "
                          "They end where a mean cannot be, as far as the measure says that. Variants have the same "
                          "trials with the same noise: their differences are more certain than the intervals look."));
    if (!context.commandLine.empty())
        body += cat(heading("Where this comes from"),
                    paragraph(cat("<code>", escaped(context.commandLine),
                                  "</code>. The runs are in "
                                  "<code>results.csv</code>, each with the commands that repeat it; "
                                  "<code>mrose-gui results.csv</code> lists them.")));
    return reportPage(escaped(experiment.name), body);
}

}  // namespace mrose
