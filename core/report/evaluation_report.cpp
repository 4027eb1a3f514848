#include "report/evaluation_report.h"

#include <algorithm>
#include <cmath>

#include "assessment/prediction_files.h"
#include "io/format.h"
#include "report/error_figures.h"
#include "report/evaluation_files.h"
#include "report/floor_section.h"
#include "report/forecast_section.h"
#include "report/legend.h"
#include "report/path_figures.h"
#include "report/shown_windows.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

constexpr const char* reportFiles[] = {"results.csv", "results.json", "windows.csv", "report.html"};

std::string withInterval(double value, const Interval& interval, std::size_t windows) {
    if (windows < leastForInterval) return fixed(value, 2);
    return cat(fixed(value, 2), "<small>", fixed(interval.low, 2), "–", fixed(interval.high, 2), "</small>");
}

void addThree(std::vector<std::string>& cells, const Distribution& d, double unit, int decimals) {
    for (const double value : {d.median, d.mean}) cells.push_back(fixed(unit * value, decimals));
    cells.push_back(p90Text(d, unit, decimals));
}

std::string signedText(double value, int decimals) {
    const std::string text = fixed(std::abs(value), decimals);
    return cat(value > 0 ? "+" : value < 0 ? "−" : "", text);
}

/// The values with the smallest one in bold, where there are several.
std::vector<std::string> smallestBold(const std::vector<double>& values, int decimals) {
    std::vector<std::string> cells;
    const auto better = [](double a, double b) { return !std::isnan(a) && (std::isnan(b) || a < b); };
    const auto best = std::min_element(values.begin(), values.end(), better) - values.begin();
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::string text = fixed(values[i], decimals);
        const bool bold = values.size() > 1 && static_cast<std::ptrdiff_t>(i) == best && std::isfinite(values[i]);
        cells.push_back(bold ? cat("<b>", text, "</b>") : text);
    }
    return cells;
}

/// A pair of columns per model under the model's name.
struct PairedTable {
    PairedTable(const Evaluation& evaluation, const std::vector<std::string>& leading,
                const std::vector<std::string>& pair)
        : table([&] {
              std::vector<HtmlTable::Group> groups{{"", leading}};
              for (const Assessment& model : evaluation.models) groups.push_back({escaped(model.name), pair});
              return HtmlTable(groups, "even");
          }()) {}

    void row(std::vector<std::string> cells, const std::vector<double>& first, const std::vector<double>& second,
             int decimals) {
        const auto left = smallestBold(first, decimals), right = smallestBold(second, decimals);
        for (std::size_t i = 0; i < left.size(); ++i) {
            cells.push_back(left[i]);
            cells.push_back(right[i]);
        }
        table.row(cells);
    }

    HtmlTable table;
};

std::string modelTable(const Evaluation& evaluation) {
    const std::vector<std::string> three{"median", "mean", "p90"};
    HtmlTable table({{"", {"", "P %", "Hd %"}},
                     {"time-mean / path, %", three},
                     {"position at the end, cm", three},
                     {"heading at the end, °", three},
                     {"mean offset at the end", {"along cm", "left cm", "turn °"}}},
                    "dense");
    for (std::size_t i = 0; i < evaluation.models.size(); ++i) {
        const Summary& s = evaluation.models[i].all;
        std::vector<std::string> cells{seriesName(evaluation.models[i], i), withInterval(s.p, s.p95, s.windows),
                                       withInterval(s.hd, s.hd95, s.windows)};
        addThree(cells, s.positionMeanOverPath, 1, 2);
        addThree(cells, s.positionFinal, 100, 2);
        addThree(cells, s.headingFinal, degrees, 2);
        cells.push_back(signedText(100 * s.along.mean, 2));
        cells.push_back(signedText(100 * s.left.mean, 2));
        cells.push_back(signedText(degrees * s.headingSigned.mean, 2));
        table.row(cells);
    }
    return table.text();
}

std::string groupTable(const Evaluation& evaluation) {
    PairedTable paired(evaluation, {"", "windows", "path m", "rotation rad"}, {"P %", "Hd %"});
    const auto& groups = evaluation.models.front().groups;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        if (g == 0 || groups[g].kind != groups[g - 1].kind) paired.table.part(cat("by ", escaped(groups[g].kind)));
        std::vector<double> p, hd;
        for (const Assessment& model : evaluation.models) {
            p.push_back(model.groups[g].summary.p);
            hd.push_back(model.groups[g].summary.hd);
        }
        const Summary& s = groups[g].summary;
        paired.row({cat(groups[g].kind == "robot" ? "robot " : "", escaped(groups[g].name)), std::to_string(s.windows),
                    fixed(s.path, 1), fixed(s.rotation, 1)},
                   p, hd, 2);
    }
    return paired.table.text();
}

std::string relativeTable(const Evaluation& evaluation) {
    PairedTable paired(evaluation, {"horizon", "pieces"}, {"cm", "°"});
    const auto& horizons = evaluation.models.front().relative;
    for (std::size_t h = 0; h < horizons.size(); ++h) {
        std::vector<double> position, heading;
        for (const Assessment& model : evaluation.models) {
            position.push_back(100 * model.relative[h].position);
            heading.push_back(degrees * model.relative[h].heading);
        }
        paired.row({cat(secondsText(fromSeconds(horizons[h].horizon), 0), " s"), std::to_string(horizons[h].pieces)},
                   position, heading, 2);
    }
    return paired.table.text();
}

std::string windowTable(const Evaluation& evaluation, std::size_t window) {
    HtmlTable table({{"", {"", "mean<br/>cm", "mean<br/>% path", "end<br/>cm", "end<br/>°"}}}, "small");
    const double path = evaluation.log.windows[window].path;
    for (const Assessment& model : evaluation.models) {
        const WindowErrors& e = model.errors[window];
        table.row({escaped(model.name), fixed(100 * e.positionMean, 1),
                   path > 0 ? fixed(100 * e.positionMean / path, 1) : "–", fixed(100 * e.positionFinal, 1),
                   fixed(degrees * e.headingFinal, 1)});
    }
    return table.text();
}

std::string robotsText(const Evaluation& evaluation) {
    std::vector<std::string> names;
    for (const auto& robot : evaluation.log.robots)
        if (robot.windows > 0) names.push_back(escaped(robot.name));
    std::string text = names.size() == 1 ? "robot " : "robots ";
    for (std::size_t i = 0; i < names.size(); ++i)
        text += cat(i == 0 ? "" : i + 1 == names.size() ? " and " : ", ", names[i]);
    return text;
}

std::string header(const Evaluation& evaluation, const ReportContext& context) {
    const LogWindows& log = evaluation.log;
    const auto [least, most] = std::ranges::minmax_element(log.windows, {}, &Window::steps);
    std::vector<std::string> notices = context.notices;
    if (log.synthetic)
        notices.insert(notices.begin(),
                       "The log comes from a simulated robot. Nothing here says how true the model is of a real one.");
    return pageHead(cat("How true is ", escaped(evaluation.models.front().name), "?"),
                    cat(counted(log.windows.size(), "window"), " of ",
                        lengthText(least->steps() * log.options.step, most->steps() * log.options.step), ", ",
                        robotsText(evaluation)),
                    {log.source, log.synthetic}, context, notices);
}

std::string typicalWindow(const Evaluation& evaluation, const Summary& s) {
    std::vector<double> paths;
    for (const Window& window : evaluation.log.windows) paths.push_back(window.path);
    return cat(
        "At the end of a typical window (median), after ", fixed(quantile(paths, 0.5), 2), "\u00a0m of path, it is ",
        fixed(100 * s.positionFinal.median, 1), "\u00a0cm from where the robot really was and points ",
        fixed(degrees * s.headingFinal.median, 1), "° off",
        s.windows < leastForPercentile ? "."
                                       : cat("; one window in ten ends more than ", p90Text(s.positionFinal, 100, 1),
                                             "\u00a0cm or more than ", p90Text(s.headingFinal, degrees, 1), "° off."));
}

std::string comparison(const Evaluation& evaluation) {
    std::string text;
    if (const std::vector<std::size_t> drawn = drawnModels(evaluation); drawn.size() > 1) {
        const Assessment& baseline = evaluation.models[drawn[1]];
        text += cat(" The best of the others by P, ", escaped(baseline.name), ", leaves ", percentText(baseline.all.p),
                    " and ", percentText(baseline.all.hd), ".");
    }
    if (evaluation.log.floor && !evaluation.log.floor->pairs.empty())
        text += cat(" Where it got near-identical commands twice (", std::to_string(evaluation.log.floor->pairs.size()),
                    " <a href=\"#floor\">", evaluation.log.floor->pairs.size() == 1 ? "pair" : "pairs", "</a>), the ",
                    evaluation.log.real(), " robot’s own runs are a P of ", percentText(evaluation.log.floor->spread.p),
                    " apart (the spread), so that the best prediction possible would be off by about ",
                    percentText(evaluation.log.floor->best.p), " there (the floor); this one is off by ",
                    percentText(evaluation.models.front().onFloor.p), ".");
    return text;
}

std::string headline(const Evaluation& evaluation) {
    const Assessment& model = evaluation.models.front();
    return element("p", "lead",
                   cat("Given a start and the commands alone, the prediction’s position is ", offText(model.all),
                       typicalWindow(evaluation, model.all), comparison(evaluation), forecastHeadline(evaluation)));
}

std::string errorBandText(const Evaluation& evaluation) {
    if (!foreseesErrors(evaluation))
        return "Lines are medians over the windows. Of the first model, the dark band holds the middle half of the "
               "windows (25–75 %), the light one 10–90 %.";
    return cat(
        "Lines are medians over the windows. The bands are what the first model foresees of its own errors, from "
        "its noise: the dark one the middle half (25–75 %), the light one 10–90 %. Thin lines are the same shares "
        "of its errors as they were: where they run along the edges of the bands, it knows how far the ",
        evaluation.log.real(), " robot strays.");
}

std::string errorSection(const Evaluation& evaluation) {
    return cat(
        heading("Error against time"), paragraph(errorBandText(evaluation)), errorOverTimeLegend(evaluation),
        figurePair(errorOverTimeFigure(evaluation, ErrorChannel::position),
                   errorOverTimeFigure(evaluation, ErrorChannel::heading)),
        heading("How errors are distributed over the windows"),
        paragraph("For each error, the part of the windows that stay below it: further left is better. Curves that "
                  "leave the frame on the right have larger errors still."),
        modelLegend(evaluation),
        figurePair(cumulativeFigure(evaluation, ErrorChannel::position),
                   cumulativeFigure(evaluation, ErrorChannel::heading)));
}

std::string barsSection(const Evaluation& evaluation) {
    std::string figures;
    const double top = highestBar(evaluation);
    for (std::size_t i = 0; i < evaluation.log.robots.size(); ++i)
        if (evaluation.log.robots[i].windows > 0)
            figures += element("div", "bars",
                               cat(element("h3", "", cat("Robot ", escaped(evaluation.log.robots[i].name))),
                                   barsFigure(evaluation, i, top)));
    return cat(heading("Every window"),
               paragraph("The first model’s time-mean position error in each window, in the log’s order, coloured by "
                         "what the commands ask for. A bar says which window it is when the pointer rests on it; "
                         "<code>--show</code> with its number adds its paths to the pictures above."),
               manoeuvreLegend(), element("div", "card", figures));
}

std::string pathCard(const Evaluation& evaluation, const ShownWindow& shown) {
    const Window& w = evaluation.log.windows[shown.window];
    // Names matter only where there are several.
    const auto several = [&](auto differs) {
        return std::any_of(evaluation.log.windows.begin(), evaluation.log.windows.end(), differs);
    };
    std::string which = cat("window\u00a0", std::to_string(shown.window + 1));
    if (several([&](const Window& other) { return other.robot != w.robot; }))
        which += cat(" · robot\u00a0", escaped(evaluation.log.robots[w.robot].name));
    if (several([&](const Window& other) { return other.robot == w.robot && other.trajectory != w.trajectory; }))
        which += cat(" · trajectory\u00a0", escaped(evaluation.log.trajectories[shown.window]));
    const std::string what =
        cat(which, " · from\u00a0", sinceDriveStart(evaluation.log, shown.window), "\u00a0s<br/>", name(w.manoeuvre),
            " · path\u00a0", fixed(w.path, 2), "\u00a0m · rotation\u00a0", fixed(w.rotation, 2), "\u00a0rad");
    return card(
        escaped(capitalised(shown.reason)),
        cat(element("p", "soft", what), pathFigure(evaluation, shown.window), windowTable(evaluation, shown.window)));
}

std::string pathSection(const Evaluation& evaluation, const ReportContext& context) {
    std::string cards;
    for (const ShownWindow& shown : shownWindows(evaluation, context.chosen)) cards += pathCard(evaluation, shown);
    return cat(
        heading(cat(capitalised(evaluation.log.real()), " against predicted paths")),
        paragraph("Both axes have the same scale; the bar below each picture, which is also the grid’s spacing, says "
                  "which. Windows are ranked by the first model’s time-mean position error over the path."),
        pathLegend(evaluation), element("div", "paths", cards));
}

std::string tablesSection(const Evaluation& evaluation) {
    std::string text =
        cat(heading("By part of the log"),
            paragraph("P and Hd of the windows of each robot and each kind of manoeuvre; the best model of "
                      "each row in bold."),
            tableCard(groupTable(evaluation)));
    if (!evaluation.models.front().relative.empty())
        text +=
            cat(heading("Relative pose error"),
                paragraph("RMS error of the predicted relative pose over shorter horizons: the windows are cut into "
                          "pieces, each predicted from its own measured start."),
                tableCard(relativeTable(evaluation)));
    return text;
}

std::string provenance(const Evaluation& evaluation, const ReportContext& context) {
    std::string text = heading("Where this comes from");
    HtmlTable facts({{"", {"", ""}}}, "words");
    facts.row({"model", escaped(evaluation.models.front().name)});
    addModelFacts(facts, context);
    facts.row({"evaluated on", cat(escaped(evaluation.log.source), " (", escaped(evaluation.log.format), ")",
                                   evaluation.log.synthetic ? ", synthetic" : "")});
    if (!context.commandLine.empty()) facts.row({"made by", cat("<code>", escaped(context.commandLine), "</code>")});
    text += tableCard(facts.text());
    if (!context.trainingLogs.empty())
        text += cat(element("h2", "", "Learned from"), tableCard(fileTable(context.trainingLogs)));
    return cat(text, heading("The log that it was evaluated on"),
               paragraph("What was found wrong with it while reading; nothing of this is hidden in the numbers above."),
               tableCard(defectTable(evaluation.log)), foldedFiles(evaluation.log.files));
}

std::string definitions(const Evaluation& evaluation) {
    const WindowOptions& options = evaluation.log.options;
    std::string list;
    list += definition(
        "window",
        cat("A stretch of ", secondsText(options.horizon, 0),
            " s with ground truth throughout in which the robot drives at least ", fixed(options.leastPath, 2),
            " m or turns at least ", fixed(options.leastRotation, 2),
            " rad (in proportion to its length). Windows of one robot do not overlap. Trajectories too short to "
            "be cut are one window each: their end, or all of them."));
    list += definition(
        "prediction",
        "Open loop: it knows pose and velocity at the start and, if it is a network’s, how the tracked point "
        "lies on the robot, measured from truth at or before it, and each command once it is issued. "
        "Nothing is aligned afterwards.");
    list += errorDefinitions(options, "windows");
    list += definition("from", "Seconds since the first stamp of the drive. Files have the log’s own clock.");
    list += definition("path, rotation", "Summed over steps of 0.5 s, because a robot’s wobble inflates shorter ones.");
    list += definition("interval", "Bootstrap: the middle 95 % of 1000 drawings of as many windows, with replacement.");
    list +=
        definition("offset at the end", cat("Mean of the signed error in the ", evaluation.log.real(),
                                            " robot’s frame: ahead of it, to its left, "
                                            "turned counter-clockwise. It shows a bias that absolute errors hide."));
    list += definition("hard switch",
                       "Somewhere in the window v or w goes within 0.1 s from full (0.7 of the robot’s "
                       "largest command) to zero (0.1 of it) or to the other sign (0.25 on both sides), held "
                       "0.3 s before and after.");
    list += definition("straight, turning", "Other windows: commanded rotation below and above 0.5 rad in 10 s.");
    return element("dl", "", list);
}

std::string trustSection(const Evaluation& evaluation, const ReportContext& context) {
    std::string text;
    if (!context.unfamiliar.empty()) {
        double sum = 0;
        for (const double share : context.unfamiliar) sum += share;
        const double mean = 100 * sum / static_cast<double>(context.unfamiliar.size());
        const auto most = std::max_element(context.unfamiliar.begin(), context.unfamiliar.end());
        text = paragraph(cat("The network says where it was learned: in ", fixed(mean, 1),
                             "\u00a0% of the periods the robot was driven otherwise, at most in ",
                             fixed(100 * *most, 0), "\u00a0% of those of a window (",
                             std::to_string(most - context.unfamiliar.begin() + 1), " of ",
                             std::to_string(evaluation.log.windows.size()), "). What it predicts there is a guess."));
    }
    if (context.advice) text += adviceCard(*context.advice);
    return text.empty() ? text : cat(heading("Where not to trust it, and what to drive next"), text);
}

}  // namespace

std::string reportHtml(const Evaluation& evaluation, const ReportContext& context) {
    const std::string title = cat(escaped(evaluation.models.front().name), " on ", escaped(evaluation.log.source),
                                  evaluation.log.synthetic ? " (synthetic)" : "");
    const std::string body =
        cat(header(evaluation, context), headline(evaluation), tiles(evaluation.models.front().all),
            heading("Models side by side"), tableCard(modelTable(evaluation)), errorSection(evaluation),
            forecastSection(evaluation), pathSection(evaluation, context), tablesSection(evaluation),
            barsSection(evaluation), trustSection(evaluation, context), floorSection(evaluation),
            heading("What the numbers mean"), definitions(evaluation), provenance(evaluation, context));
    return reportPage(title, body);
}

Expected<void> checkReportFolder(const std::filesystem::path& folder, bool overwrite) {
    return checkReportFolder(folder, reportFiles, overwrite);
}

Expected<void> writeReport(const Evaluation& evaluation, const ReportContext& context,
                           const std::filesystem::path& folder) {
    if (evaluation.models.empty() || evaluation.log.windows.empty())
        return fail(folder.string(), "nothing was evaluated that a report could show");
    return writeReportFiles(folder, {{reportFiles[0], resultsCsv(evaluation)},
                                     {reportFiles[1], resultsJson(evaluation, context)},
                                     {reportFiles[2], windowsCsv(evaluation.log)},
                                     {reportFiles[3], reportHtml(evaluation, context)}});
}

}  // namespace mrose
