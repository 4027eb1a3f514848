#include "report/sensor_report.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/format.h"
#include "report/detection_figure.h"
#include "report/error_link_section.h"
#include "report/legend.h"
#include "report/look_figure.h"
#include "report/sensor_figures.h"
#include "report/sensor_files.h"

namespace mrose {
namespace {

constexpr const char* sensorFiles[] = {"results.csv", "results.json", "cases.csv", "report.html"};

enum class Better { less, more };

/// A column of figures with the best in bold.
std::vector<std::string> bestBold(const std::vector<double>& values, int decimals, Better better) {
    std::vector<std::string> cells;
    double best = NAN;
    for (const double value : values)
        if (!std::isnan(value) && (std::isnan(best) || (better == Better::less ? value < best : value > best)))
            best = value;
    for (const double value : values) {
        const std::string text = fixedWithMinus(value, decimals);
        cells.push_back(values.size() > 1 && text == fixedWithMinus(best, decimals) && std::isfinite(value)
                            ? cat("<b>", text, "</b>")
                            : text);
    }
    return cells;
}

std::string insideText(const ErrorScores& error) {
    return cat(fixed(100 * error.inside50, 1), " / ", fixed(100 * error.inside90, 1));
}

/// A table of models: their scores over all cases, or over parts of them.
class ScoreTable {
public:
    explicit ScoreTable(const SensorEvaluation& evaluation) : evaluation_(evaluation) {}

    void part(std::string_view content) { table_.part(content); }

    /// The models' scores of the same cases.
    void rows(const std::vector<const SensorScores*>& scores) {
        std::vector<std::vector<std::string>> columns;
        const auto column = [&](auto value, int decimals, Better better) {
            std::vector<double> values;
            for (const SensorScores* of : scores) values.push_back(value(*of));
            columns.push_back(bestBold(values, decimals, better));
        };
        for (std::size_t d = 0; d < readingDimensions; ++d) {
            const double factor = shownDimension(d).factor;
            column([&](const SensorScores& s) { return factor * s.error[d].crps; }, 2, Better::less);
            column([&](const SensorScores& s) { return factor * s.error[d].rmse; }, 2, Better::less);
            columns.emplace_back();
            for (const SensorScores* of : scores) columns.back().push_back(insideText(of->error[d]));
        }
        column([](const SensorScores& s) { return s.logDensity; }, 3, Better::more);
        column([](const SensorScores& s) { return s.detection; }, 4, Better::more);
        column([](const SensorScores& s) { return 100 * s.off; }, 1, Better::less);
        for (std::size_t i = 0; i < scores.size(); ++i) {
            std::vector<std::string> cells{seriesName(evaluation_.models[i].name, i)};
            for (const auto& of : columns) cells.push_back(of[i]);
            table_.row(cells);
        }
    }

    std::string text() const { return table_.text(); }

private:
    const SensorEvaluation& evaluation_;
    HtmlTable table_{{{"", {""}},
                      {"range", {"CRPS cm", "RMSE cm", "inside 50 / 90 %"}},
                      {"bearing", {"CRPS mrad", "RMSE mrad", "inside 50 / 90 %"}},
                      {"both", {"log density"}},
                      {"detection", {"log-likelihood", "worst group off, %"}}},
                     "dense"};
};

std::string modelScores(const SensorEvaluation& evaluation) {
    std::vector<const SensorScores*> scores;
    for (const SensorAssessment& model : evaluation.models) scores.push_back(&model.all);
    ScoreTable table(evaluation);
    table.rows(scores);
    return table.text();
}

std::string robotsOf(const LoggedCases& log) {
    std::string text = log.robots.size() == 1 ? "robot " : "robots ";
    for (std::size_t i = 0; i < log.robots.size(); ++i)
        text += cat(i == 0 ? "" : i + 1 == log.robots.size() ? " and " : ", ", escaped(log.robots[i].name));
    return text;
}

const char* subjectsOf(const LoggedCases& log) {
    return log.rule.subjects == SubjectKind::landmark ? "landmarks" : "other robots";
}

std::string sensorHeader(const SensorEvaluation& evaluation, const ReportContext& context) {
    const LoggedCases& log = evaluation.log;
    std::vector<std::string> notices = context.notices;
    if (log.synthetic)
        notices.insert(notices.begin(),
                       "The log comes from a simulated robot. Nothing here says how true the model is of a real one.");
    return pageHead(cat("How true is ", escaped(evaluation.models.front().name), "?"),
                    cat(counted(log.looks.size(), "look"), " of the ", escaped(log.sensor), " of ", robotsOf(log)),
                    {log.source, log.synthetic}, context, notices);
}

/// "31 % less than".
std::string lessText(double value, double than) {
    const double percent = 100 * (1 - value / than);
    return cat(fixed(std::abs(percent), 0), "\u00a0% ", percent >= 0 ? "less" : "more", " than");
}

/// What is no file by its noun.
std::string calledInText(const std::string& name) {
    if (name == "ideal") return "an ideal sensor";
    if (name == "ideal plus noise") return "an ideal sensor with constant noise";
    const bool family = name == "network" || name == "lookup table" || name == "decision trees";
    return cat(family ? "the " : "", escaped(name));
}

std::string comparisonText(const SensorEvaluation& evaluation) {
    const SensorScores& first = evaluation.models.front().all;
    std::string text;
    for (std::size_t i = 1; i < evaluation.models.size(); ++i) {
        const SensorScores& other = evaluation.models[i].all;
        text += cat(i == 1                              ? " Its score of the range (less is better) is "
                    : i + 1 == evaluation.models.size() ? " and "
                                                        : ", ",
                    lessText(first.error[0].crps, other.error[0].crps), " that of ",
                    calledInText(evaluation.models[i].name));
    }
    return text.empty() ? text : text + ".";
}

std::string sensorHeadline(const SensorEvaluation& evaluation) {
    const LoggedCases& log = evaluation.log;
    const SensorScores& all = evaluation.models.front().all;
    return element(
        "p", "lead",
        cat("Given only where the robot and everything about it truly were, the model says how likely each of the ",
            subjectsOf(log), " is reported, and what range and bearing would be read. In ", std::to_string(all.cases),
            " cases, of which ", std::to_string(all.readings), " (",
            fixed(100 * static_cast<double>(all.readings) / static_cast<double>(all.cases), 0),
            "\u00a0%) were reported, its distribution of the range is off by <b>", fixed(100 * all.error[0].crps, 1),
            "\u00a0cm</b> and that of the bearing by <b>", fixed(1000 * all.error[1].crps, 1),
            "\u00a0mrad</b> (CRPS), and <b>", fixed(100 * all.error[0].inside90, 0), "\u00a0%</b> of the ", log.real(),
            " ranges and <b>", fixed(100 * all.error[1].inside90, 0),
            "\u00a0%</b> of the bearings lie in the central 90\u00a0% of what it predicts.",
            comparisonText(evaluation)));
}

std::string sensorTiles(const SensorEvaluation& evaluation) {
    const SensorScores& all = evaluation.models.front().all;
    std::string tiles;
    for (std::size_t d = 0; d < readingDimensions; ++d) {
        const ShownDimension& shown = shownDimension(d);
        const ErrorScores& error = all.error[d];
        tiles += tile(cat(shown.name, ": CRPS"), fixed(shown.factor * error.crps, 2), shown.unit,
                      cat("inside the central 50\u00a0%: ", fixed(100 * error.inside50, 1),
                          ", 90\u00a0%: ", fixed(100 * error.inside90, 1)));
    }
    tiles += tile("detection: log-likelihood", fixedWithMinus(all.detection, 4), "",
                  cat("of ", std::to_string(all.cases), " ", subjectsOf(evaluation.log)));
    tiles += tile("detection: worst group off by", fixed(100 * all.off, 1), "%",
                  cat("of ", std::to_string(all.groups.size()), " groups, between predicted and ",
                      evaluation.log.real(), " share"));
    return tileRow(tiles);
}

std::string bandSection(const SensorEvaluation& evaluation) {
    std::string text =
        cat(heading("Errors against range and bearing"),
            paragraph("What was read less what is true, by where the subject is. Areas are the readings that there "
                      "were, lines what the first model says they would be: where it is right, its lines run along "
                      "the edges of the areas."),
            errorBandLegend(evaluation));
    for (std::size_t d = 0; d < readingDimensions; ++d) {
        const std::string name = shownDimension(d).name;
        text += cardPair(
            card(cat(capitalised(name), " error against range"), errorBandFigure(evaluation, d, BandAxis::range)),
            card(cat(capitalised(name), " error against bearing"), errorBandFigure(evaluation, d, BandAxis::bearing)));
    }
    return text;
}

std::string detectionSection(const SensorEvaluation& evaluation) {
    return cat(
        heading("Detection over the field of view"),
        paragraph("From above: the robot is the dot at the bottom and looks up. Each cell holds the subjects "
                  "that were there at a look, hidden ones too."),
        shareLegend(evaluation),
        cardPair(card(capitalised(evaluation.log.real()), detectionFigure(evaluation, DetectionSide::real)),
                 card(escaped(evaluation.models.front().name), detectionFigure(evaluation, DetectionSide::predicted))));
}

std::string reliabilitySection(const SensorEvaluation& evaluation) {
    std::string coverage, below;
    for (std::size_t d = 0; d < readingDimensions; ++d) {
        const std::string name = shownDimension(d).name;
        coverage += card(capitalised(name), coverageFigure(evaluation, d));
        below += card(capitalised(name), belowFigure(evaluation, d));
    }
    return cat(heading("Are the probabilities true?"),
               paragraph("Left: subjects in ten equal groups by how likely a report is predicted, and how many of "
                         "them were reported. Middle and right: how many readings lie in the central part of what is "
                         "predicted. On the dashed diagonal a model says what happens; below it on the right two, its "
                         "distributions are too narrow, above it too wide."),
               sensorLegend(evaluation),
               element("div", "paths", cat(card("Detection", reliabilityFigure(evaluation)), coverage)),
               paragraph("Of the first model, how many readings fall into each twentieth of its probability: even, at "
                         "the dashed line, where it is calibrated; high at both ends where it is too narrow, slanted "
                         "where it is biased."),
               cardPair(below, ""));
}

std::string lookSection(const SensorEvaluation& evaluation) {
    const LoggedCases& log = evaluation.log;
    const LoggedLook& look = log.looks[evaluation.shown.look];
    return cat(heading("One look"),
               paragraph(cat("The look with the most readings, of robot ", escaped(log.robots[look.robot].name), " at ",
                             fixed(toSeconds(evaluation.shown.sinceStart), 1),
                             " s. Left: all from above, as far as there were subjects. Right: those that were reported "
                             "or are at least ",
                             fixed(100 * leastShownChance, 0),
                             "\u00a0% likely to be, each enlarged in a scale of its own and seen from the robot, up is "
                             "away from it; with ",
                             std::to_string(shownDraws), " readings drawn from the model.")),
               lookLegend(evaluation),
               cardPair(card(capitalised(log.real()), lookFigure(evaluation)),
                        card(escaped(evaluation.models.front().name), lookCloseUps(evaluation))));
}

std::string robotSection(const SensorEvaluation& evaluation) {
    if (evaluation.log.robots.size() < 2) return {};
    ScoreTable table(evaluation);
    for (std::size_t i = 0; i < evaluation.log.robots.size(); ++i) {
        const LoggedCases::Robot& robot = evaluation.log.robots[i];
        table.part(cat("robot ", escaped(robot.name), ": ", std::to_string(robot.readings), " of ",
                       std::to_string(robot.cases), " ", subjectsOf(evaluation.log), " reported"));
        std::vector<const SensorScores*> scores;
        for (const SensorAssessment& model : evaluation.models) scores.push_back(&model.byRobot[i]);
        table.rows(scores);
    }
    return cat(heading("By robot"), tableCard(table.text()));
}

std::string sensorDefinitions(const LoggedCases& log) {
    const CaseRule& rule = log.rule;
    std::string list;
    list += definition("look", "An instant at which the sensor looked, also where it reported nothing then.");
    list += definition(
        subjectsOf(log),
        cat("Judged are those at most ", fixed(rule.range, 1), " m away and ", fixed(degrees * rule.bearing, 0),
            "° to either side at a look’s stamp, hidden or not, while it is known where the robot was."));
    list += definition("prediction",
                       "Knows the ground truth of all robots and landmarks up to 0.2 s after the stamp, and none of "
                       "the log’s readings. Independent of what was reported before.");
    list += definition("CRPS",
                       "Continuous ranked probability score: how far a predicted distribution is from what was read, "
                       "in the unit of the reading. Of a single number it is the absolute error; less is better.");
    list += definition("RMSE", "Root mean square error of the predicted median.");
    list += definition("inside",
                       "Share of the readings in the central 50 and 90 % of what is predicted: 50 and 90 is "
                       "right, less is overconfident.");
    list += definition("log density",
                       "Mean logarithm of the density of range and bearing together, in 1/(m rad); more is better.");
    list += definition("detection",
                       "Mean logarithm of the predicted probability of what happened, report or none. "
                       "Probabilities count as 0.0001 at least; 0 would be perfect.");
    list += definition("worst group off", cat("The largest difference between the predicted and the ", log.real(),
                                              " share of reports among ten equal groups by predicted probability."));
    list += definition("gross errors",
                       cat("Readings more than ", fixed(rule.grossRange, 1), " m or ", fixed(rule.grossBearing, 2),
                           " rad off count as reported; their errors are left out."));
    list += definition("ideal", "Reports exactly, and all that is in the field of view with no body before it.");
    list += definition("ideal plus noise",
                       "The same with one probability of a report in view and one elsewhere, and "
                       "errors of constant spread, all fitted to the logs learned from.");
    return element("dl", "", list);
}

std::string caseTable(const LoggedCases& log) {
    HtmlTable table({{"", {"", "looks", "subjects", "reported", "gross errors", "looks without truth"}},
                     {"found in the log", {"empty looks", "unknown subjects", "repeated", "joined stamps"}}});
    for (const LoggedCases::Robot& robot : log.robots) {
        std::vector<std::string> cells{cat("robot ", escaped(robot.name))};
        for (const std::size_t count : {robot.looks, robot.cases, robot.readings, robot.gross, robot.withoutTruth})
            cells.push_back(std::to_string(count));
        for (const std::int64_t count : {robot.defects.emptyLooks, robot.defects.unknownSubjects,
                                         robot.defects.repeated, robot.defects.joinedStamps})
            cells.push_back(std::to_string(count));
        table.row(cells);
    }
    return table.text();
}

std::string sensorProvenance(const SensorEvaluation& evaluation, const ReportContext& context) {
    const LoggedCases& log = evaluation.log;
    HtmlTable facts({{"", {"", ""}}}, "words");
    if (context.modelFacts.empty()) facts.row({"model", escaped(evaluation.models.front().name)});
    addModelFacts(facts, context);
    facts.row(
        {"evaluated on", cat(escaped(log.source), " (", escaped(log.format), ")", log.synthetic ? ", synthetic" : "")});
    if (!context.commandLine.empty()) facts.row({"made by", cat("<code>", escaped(context.commandLine), "</code>")});
    std::string text = cat(heading("Where this comes from"), tableCard(facts.text()));
    if (!context.trainingLogs.empty()) text += cat(heading("Learned from"), foldedFiles(context.trainingLogs));
    return cat(text, heading("The log that it was evaluated on"), tableCard(caseTable(log)), foldedFiles(log.files));
}

}  // namespace

std::string sensorReportHtml(const SensorEvaluation& evaluation, const ReportContext& context) {
    const std::string title = cat(escaped(evaluation.models.front().name), " on ", escaped(evaluation.log.source),
                                  evaluation.log.synthetic ? " (synthetic)" : "");
    return reportPage(title,
                      cat(sensorHeader(evaluation, context), sensorHeadline(evaluation), sensorTiles(evaluation),
                          heading("Models side by side"), tableCard(modelScores(evaluation)), lookSection(evaluation),
                          bandSection(evaluation), errorLinkSection(evaluation), detectionSection(evaluation),
                          reliabilitySection(evaluation), robotSection(evaluation), heading("What the numbers mean"),
                          sensorDefinitions(evaluation.log), sensorProvenance(evaluation, context)));
}

Expected<void> checkSensorReportFolder(const std::filesystem::path& folder, bool overwrite) {
    return checkReportFolder(folder, sensorFiles, overwrite);
}

Expected<void> writeSensorReport(const SensorEvaluation& evaluation, const ReportContext& context,
                                 const std::filesystem::path& folder) {
    return writeReportFiles(folder, {{sensorFiles[0], sensorResultsCsv(evaluation)},
                                     {sensorFiles[1], sensorResultsJson(evaluation, context)},
                                     {sensorFiles[2], sensorCasesCsv(evaluation)},
                                     {sensorFiles[3], sensorReportHtml(evaluation, context)}});
}

}  // namespace mrose
