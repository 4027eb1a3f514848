#include "report/tuning_report.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "drawing/svg_plot.h"
#include "geometry/elementary.h"
#include "io/format.h"
#include "report/legend.h"
#include "tuning/tuning_output.h"

namespace mrose {
namespace {

constexpr double markPixels = 3, bestPixels = 5.5;

const char* markOf(const Candidate& candidate) { return candidate.dropped ? "body" : "sample"; }

/// Costs that a picture shows: those far above the others lie on its upper edge.
PlotRange costRange(const TunerResult& result) {
    std::vector<double> costs;
    for (const Candidate& candidate : result.candidates) costs.push_back(candidate.cost);
    std::sort(costs.begin(), costs.end());
    const double low = costs.front(), most = costs[(costs.size() - 1) * 9 / 10];
    const double high = std::max(most, result.candidates.front().cost);
    const double margin = 0.08 * (high > low ? high - low : 1);
    return {low - margin, high + margin};
}

std::string progressFigure(const Tuning& tuning, const TunerResult& result) {
    const PlotRange costs = costRange(result);
    SvgPlot plot({}, {0, static_cast<double>(result.evaluations)}, costs, "Least cost over evaluations");
    plot.axes("evaluations (candidates by trials)", tuning.costText);
    std::vector<Point> best;
    for (const Candidate& candidate : result.candidates) {
        const auto at = static_cast<double>(candidate.evaluations);
        plot.circle({at, std::min(candidate.cost, costs.high)}, markPixels, markOf(candidate));
        if (!candidate.best) continue;
        if (!best.empty()) best.push_back({at, best.back().y});
        best.push_back({at, candidate.cost});
    }
    best.push_back({static_cast<double>(result.evaluations), best.back().y});
    plot.line(best, "s0");
    return plot.text();
}

std::string parameterFigure(const Tuning& tuning, const TunerResult& result, std::size_t index) {
    const TunedParameter& parameter = tuning.options.parameters[index];
    const auto across = [&](double value) { return parameter.logarithmic ? logarithm(value) / logarithm(10) : value; };
    const PlotRange costs = costRange(result);
    const double margin = 0.03 * (across(parameter.to) - across(parameter.from));
    SvgPlot plot({}, {across(parameter.from) - margin, across(parameter.to) + margin}, costs,
                 cat("Cost against ", parameter.name));
    plot.axes(parameter.logarithmic ? cat("log10 of ", parameter.name) : parameter.name, tuning.costText);
    const auto at = [&](const Candidate& candidate) {
        return Point{across(candidate.values[index]), std::min(candidate.cost, costs.high)};
    };
    for (const Candidate& candidate : result.candidates) plot.circle(at(candidate), markPixels, markOf(candidate));
    plot.circle(at(result.candidates.front()), bestPixels, "start");
    plot.circle(at(result.candidates[result.best]), bestPixels, "leaves");
    return card(escaped(parameter.name), plot.text());
}

std::string parameterTable(const Tuning& tuning, const TunerResult& result) {
    HtmlTable table({{"", {"", "before", "tuned", "from", "to", "scale"}}});
    for (std::size_t i = 0; i < tuning.options.parameters.size(); ++i) {
        const TunedParameter& parameter = tuning.options.parameters[i];
        const auto number = [&](double value) {
            return parameter.whole ? std::to_string(static_cast<std::int64_t>(value)) : numberText(value);
        };
        std::string paths;
        for (const std::string& path : parameter.paths) paths += cat(" <code>", escaped(path), "</code>");
        table.row({cat(escaped(parameter.name), paths), number(parameter.start),
                   cat("<b>", number(result.candidates[result.best].values[i]), "</b>"), number(parameter.from),
                   number(parameter.to), parameter.logarithmic ? "log" : "linear"});
    }
    return table.text();
}

std::string number(double value) { return numberText(std::round(value * 1e4) / 1e4); }

std::string intervalText(const MeanInterval& interval) {
    return cat("95\u00a0% interval ", number(interval.low), " to ", number(interval.high));
}

std::string evidenceTiles(const Tuning& tuning, const TunerResult& result) {
    const TuningEvidence evidence = evidenceOf(result);
    return tileRow(cat(tile("cost before", number(evidence.before.mean), "", intervalText(evidence.before)),
                       tile("cost tuned", number(evidence.after.mean), "", intervalText(evidence.after)),
                       tile("change, paired by trial", number(evidence.change.mean), "", intervalText(evidence.change)),
                       tile("trials held out", std::to_string(tuning.options.heldOut), "",
                            cat("numbers from ", std::to_string(tuning.options.trials + 1), " on, ",
                                counted(tuning.experiment.seeds, "seed"), " each"))));
}

std::string spentText(const Tuning& tuning, const TunerResult& result) {
    const auto dropped = std::ranges::count_if(result.candidates, &Candidate::dropped);
    const double all = static_cast<double>(result.candidates.size()) * tuning.options.trials;
    return cat(counted(result.candidates.size(), "candidate"), " in ",
               counted(static_cast<std::size_t>(tuning.options.trials), "trial"), ": ",
               std::to_string(result.evaluations), " evaluations; ", std::to_string(dropped),
               " were dropped on the way, which saved ",
               fixed(100 * (1 - static_cast<double>(result.evaluations) / all), 0), "\u00a0% of the work.");
}

}  // namespace

std::string tuningReport(const Tuning& tuning, const TuningSummary& summary, const ReportContext& context) {
    const TunerResult& result = summary.result;
    std::string body = element("h1", "", escaped(tuning.name)) +
                       element("p", "sub",
                               cat("cost: ", escaped(tuning.costText), ", in trials of <code>",
                                   escaped(tuning.experimentCalled), "</code> · ", escaped(context.program)));
    for (const std::string& notice : context.notices) body += element("p", "notice", escaped(notice));
    body += evidenceTiles(tuning, result);
    body += paragraph(
        "Means over trials in which nothing was searched, with intervals by Student’s t over trials. "
        "Before and tuned had the same trials with the same noise.");
    body += tableCard(parameterTable(tuning, result));
    body += heading("The search") + paragraph(spentText(tuning, result));
    body += legend(cat(lineEntry("s0", "best so far"), dotEntry("sample", "run in all trials"),
                       dotEntry("body", "dropped: cost estimated"), dotEntry("start", "before"),
                       dotEntry("leaves", "tuned")));
    body += card("Least cost", progressFigure(tuning, result));
    std::string figures;
    for (std::size_t i = 0; i < tuning.options.parameters.size(); ++i) figures += parameterFigure(tuning, result, i);
    body += element("div", "pair", figures);
    body +=
        paragraph(cat("Costs far above the others lie at the upper edge. All runs: <code>results.csv</code>; "
                      "candidates: <code>candidates.csv</code>; for <code>--settings</code>: "
                      "<code>settings.toml</code>. Made by <code>",
                      escaped(context.commandLine), "</code>."));
    return reportPage(escaped(tuning.name), body);
}

std::string tuningJson(const Tuning& tuning, const TuningSummary& summary, const std::string& folder) {
    using Printed = nlohmann::json;
    const TunerResult& result = summary.result;
    Printed json{{"evaluations", result.evaluations},
                 {"candidates", result.candidates.size()},
                 {"dropped", std::ranges::count_if(result.candidates, &Candidate::dropped)},
                 {"runs", summary.runs},
                 {"resumed", summary.resumed},
                 {"complete", result.complete}};
    for (std::size_t i = 0; i < tuning.options.parameters.size() && !result.candidates.empty(); ++i)
        json["parameters"].push_back({{"name", tuning.options.parameters[i].name},
                                      {"before", tuning.options.parameters[i].start},
                                      {"tuned", result.candidates[result.best].values[i]}});
    if (result.complete) {
        const TuningEvidence evidence = evidenceOf(result);
        const auto interval = [](const MeanInterval& one) {
            return Printed{{"mean", one.mean}, {"low", one.low}, {"high", one.high}};
        };
        json["held_out"] = {{"trials", tuning.options.heldOut},
                            {"before", interval(evidence.before)},
                            {"after", interval(evidence.after)},
                            {"change", interval(evidence.change)}};
        if (summary.unfamiliar)
            json["unfamiliar"] = {{"before", summary.unfamiliar->before}, {"tuned", summary.unfamiliar->tuned}};
        json["settings"] = folder + "/settings.toml";
        json["report"] = folder + "/report.html";
    }
    return json.dump(2);
}

}  // namespace mrose
