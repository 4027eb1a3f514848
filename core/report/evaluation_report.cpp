#include "report/evaluation_report.h"

#include <algorithm>
#include <cmath>

#include "assessment/prediction_files.h"
#include "drawing/markup.h"
#include "io/format.h"
#include "report/evaluation_figures.h"
#include "report/evaluation_prose.h"
#include "report/evaluation_tables.h"
#include "report/page.h"
#include "report/shown_windows.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

constexpr const char* reportFiles[] = {"results.csv", "results.json", "windows.csv", "report.html"};

std::string robotsText(const Evaluation& evaluation) {
    std::vector<std::string> names;
    for (const auto& robot : evaluation.log.robots)
        if (robot.windows > 0) names.push_back(escaped(robot.name));
    std::string text = names.size() == 1 ? "robot " : "robots ";
    for (std::size_t i = 0; i < names.size(); ++i)
        text += cat(i == 0 ? "" : i + 1 == names.size() ? " and " : ", ", names[i]);
    return text;
}

/// "10 s", or "1.0 to 1.9 s" where windows differ in length.
std::string durationText(const Evaluation& evaluation) {
    const auto [least, most] =
        std::minmax_element(evaluation.log.windows.begin(), evaluation.log.windows.end(),
                            [](const Window& a, const Window& b) { return a.steps() < b.steps(); });
    const Nanoseconds step = evaluation.log.options.step;
    const std::string longest = secondsText(most->steps() * step, 0);
    return least->steps() == most->steps() ? cat(longest, " s")
                                           : cat(secondsText(least->steps() * step, 0), " to ", longest, " s");
}

std::string header(const Evaluation& evaluation, const ReportContext& context) {
    const std::string badge = context.synthetic ? "<span class=\"badge\">synthetic data</span>" : "";
    std::string text = element("h1", "", cat("How true is ", escaped(evaluation.models.front().name), "?", badge));
    std::string what = cat(std::to_string(evaluation.log.windows.size()), " windows of ", durationText(evaluation),
                           ", ", robotsText(evaluation), ", log <code>", escaped(evaluation.log.source), "</code>");
    if (!context.program.empty()) what += cat(" · ", escaped(context.program));
    text += element("p", "sub", what);
    if (context.synthetic)
        text += element("p", "notice",
                        "The log comes from a simulated robot. Nothing here says how true the model is of a real one.");
    for (const std::string& notice : context.notices) text += element("p", "notice", escaped(notice));
    return text;
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
    const auto baseline = std::min_element(evaluation.models.begin() + 1, evaluation.models.end(),
                                           [](const auto& a, const auto& b) { return a.all.p < b.all.p; });
    if (baseline != evaluation.models.end())
        text += cat(" The best of the others by P, ", escaped(baseline->name), ", leaves ",
                    percentText(baseline->all.p), " and ", percentText(baseline->all.hd), ".");
    if (evaluation.log.floor && !evaluation.log.floor->pairs.empty())
        text += cat(" Where it got near-identical commands twice (", std::to_string(evaluation.log.floor->pairs.size()),
                    " <a href=\"#floor\">pairs</a>), the real robot’s own runs are a P of ",
                    percentText(evaluation.log.floor->spread.p),
                    " apart (the spread), so that the best prediction possible would be off by about ",
                    percentText(evaluation.log.floor->best.p), " there (the floor); this one is off by ",
                    percentText(evaluation.models.front().onFloor.p), ".");
    return text;
}

std::string headline(const Evaluation& evaluation) {
    const Assessment& model = evaluation.models.front();
    return element("p", "lead",
                   cat("Given a start and the commands alone, the prediction’s position is off by <b>",
                       percentText(model.all.p), "</b> of the path driven (P) and its heading by <b>",
                       percentText(model.all.hd), "</b> of the rotation turned (Hd), on average over time. ",
                       typicalWindow(evaluation, model.all), comparison(evaluation)));
}

std::string errorSection(const Evaluation& evaluation) {
    return cat(
        heading("Error against time"),
        paragraph("Lines are medians over the windows. Of the first model, the dark band holds the middle half of "
                  "the windows (25–75 %), the light one 10–90 %."),
        modelLegend(evaluation),
        element("div", "pair",
                cat(card("Position", errorOverTimeFigure(evaluation, Channel::position)),
                    card("Heading", errorOverTimeFigure(evaluation, Channel::heading)))),
        heading("How errors are distributed over the windows"),
        paragraph("For each error, the part of the windows that stay below it: further left is better. Curves that "
                  "leave the frame on the right have larger errors still."),
        modelLegend(evaluation),
        element("div", "pair",
                cat(card("Position", cumulativeFigure(evaluation, Channel::position)),
                    card("Heading", cumulativeFigure(evaluation, Channel::heading)))));
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
    std::string reason = shown.reason;
    if (reason[0] >= 'a' && reason[0] <= 'z') reason[0] = static_cast<char>(reason[0] - 'a' + 'A');
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
        cat(which, " · from\u00a0", sinceDriveStart(evaluation, shown.window), "\u00a0s<br/>", name(w.manoeuvre),
            " · path\u00a0", fixed(w.path, 2), "\u00a0m · rotation\u00a0", fixed(w.rotation, 2), "\u00a0rad");
    return card(escaped(reason), cat(element("p", "soft", what), pathFigure(evaluation, shown.window),
                                     windowTable(evaluation, shown.window)));
}

std::string pathSection(const Evaluation& evaluation, const ReportContext& context) {
    std::string cards;
    for (const ShownWindow& shown : shownWindows(evaluation, context.chosen)) cards += pathCard(evaluation, shown);
    return cat(
        heading("Real against predicted paths"),
        paragraph("Both axes have the same scale; the bar below each picture, which is also the grid’s spacing, says "
                  "which. Windows are ranked by the first model’s time-mean position error over the path."),
        pathLegend(evaluation), element("div", "paths", cards));
}

std::string floorSection(const Evaluation& evaluation) {
    if (!evaluation.log.floor) return {};
    std::string text = cat("<h2 id=\"floor\">Spread and floor: how differently near-identical commands turn out</h2>\n",
                           paragraph(floorText(*evaluation.log.floor)));
    if (evaluation.log.turningFloor) text += paragraph(turningFloorText(*evaluation.log.turningFloor));
    const bool any = !evaluation.log.floor->pairs.empty() ||
                     (evaluation.log.turningFloor && !evaluation.log.turningFloor->pairs.empty());
    if (any)
        text += cat(
            paragraph("Both depend on how these stretches turn and how long they are: compare the rows of this table "
                      "with each other and not with those of the whole log."),
            tableCard(floorTable(evaluation)));
    return text;
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
    HtmlTable facts({"", ""}, "words");
    facts.row({"model", escaped(evaluation.models.front().name)});
    for (const auto& [key, value] : context.modelFacts) facts.row({escaped(key), escaped(value)});
    facts.row({"evaluated on", cat(escaped(evaluation.log.source), " (", escaped(evaluation.log.format), ")",
                                   context.synthetic ? ", synthetic" : "")});
    if (!context.commandLine.empty()) facts.row({"made by", cat("<code>", escaped(context.commandLine), "</code>")});
    text += tableCard(facts.text());
    if (!context.trainingLogs.empty())
        text += cat(element("h2", "", "Learned from"), tableCard(fileTable(context.trainingLogs)));
    text +=
        cat(heading("The log that it was evaluated on"),
            paragraph("What was found wrong with it while reading; nothing of this is hidden in the numbers above."),
            tableCard(defectTable(evaluation.log)));
    if (!evaluation.log.files.empty())
        text += cat("<details><summary>", std::to_string(evaluation.log.files.size()),
                    " files with their hashes</summary>\n", fileTable(evaluation.log.files), "</details>\n");
    return text;
}

}  // namespace

std::string reportHtml(const Evaluation& evaluation, const ReportContext& context) {
    const std::string title = cat(escaped(evaluation.models.front().name), " on ", escaped(evaluation.log.source),
                                  context.synthetic ? " (synthetic)" : "");
    const std::string body = cat(
        header(evaluation, context), headline(evaluation), tiles(evaluation.models.front().all),
        heading("Models side by side"), tableCard(modelTable(evaluation)), errorSection(evaluation),
        pathSection(evaluation, context), tablesSection(evaluation), barsSection(evaluation), floorSection(evaluation),
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
    const std::string contents[] = {resultsCsv(evaluation), resultsJson(evaluation, context),
                                    windowsCsv(evaluation.log), reportHtml(evaluation, context)};
    std::vector<NamedFile> files;
    for (std::size_t i = 0; i < std::size(contents); ++i) files.push_back({reportFiles[i], contents[i]});
    return writeReportFiles(folder, std::move(files));
}

}  // namespace mrose
