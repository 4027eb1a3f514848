#include "report/localiser_report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "assessment/reading_scores.h"
#include "geometry/pose.h"
#include "io/format.h"
#include "logs/robot_log.h"
#include "report/legend.h"
#include "report/residual_figure.h"
#include "report/results_json.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

constexpr const char* localiserFiles[] = {"report.html", "results.json", "poses.csv"};

/// One error of a pose, as pages show it.
struct ShownError {
    const char *name, *phrase, *unit;  ///< "heading", "error of the heading", "°"
    double factor;                     ///< to that unit
    const char* key;
};
constexpr std::array<ShownError, LocaliserScores::dimensions> shownErrors{
    {{"ahead", "error ahead", "cm", 100, "ahead_m"},
     {"to the left", "error to the left", "cm", 100, "left_m"},
     {"heading", "error of the heading", "°", degrees, "heading_rad"}}};

/// Errors of at most so many poses, evenly chosen, against one of what they depend on.
template <class XOf>
std::string poseErrorFigure(const LocaliserReport& report, const SensorModel& model, std::size_t dimension,
                            const XOf& xOf, const char* xTitle) {
    constexpr std::size_t most = 1500;
    const ShownError& shown = shownErrors[dimension];
    std::size_t sound = 0, next = 0;
    for (const LocaliserCase& one : report.cases) sound += one.sound;
    const std::size_t every = std::max<std::size_t>(1, (sound + most - 1) / most);
    std::vector<ResidualDot> dots;
    for (const LocaliserCase& one : report.cases) {
        if (!one.sound || next++ % every != 0) continue;
        ReadingDistribution predicted;
        model.distributions({&one.state, 1}, one.robot, {&predicted, 1});
        const auto quantile = [&](double share) {
            return errorQuantile(predicted, static_cast<int>(dimension), share);
        };
        const double middle = quantile(0.5);
        dots.push_back({xOf(one.state), shown.factor * (one.error[dimension] - middle),
                        shown.factor * (quantile(0.05) - middle), shown.factor * (quantile(0.95) - middle)});
    }
    return residualFigure(std::move(dots), cat(capitalised(shown.phrase), " less its predicted median"), xTitle,
                          cat(shown.phrase, " less median (", shown.unit, ")"));
}

std::string localiserTable(const LocaliserReport& report) {
    HtmlTable table({{"", {""}},
                     {"CRPS", {"ahead, cm", "to the left, cm", "heading, °"}},
                     {"inside 50 / 90 %", {"ahead", "to the left", "heading"}},
                     {"mean log-likelihood", {"report", "pose"}}});
    for (const LocaliserScores& of : report.scores) {
        std::vector<std::string> cells{escaped(of.name)};
        for (std::size_t d = 0; d < of.error.size(); ++d)
            cells.push_back(fixed(shownErrors[d].factor * of.error[d].crps, 2));
        for (const ErrorScores& error : of.error)
            cells.push_back(cat(fixed(100 * error.inside50, 0), " / ", fixed(100 * error.inside90, 0)));
        cells.push_back(fixedWithMinus(of.detection, 3));
        cells.push_back(std::isfinite(of.logDensity) ? fixedWithMinus(of.logDensity, 2) : "–");
        table.row(cells);
    }
    return table.text();
}

std::string localiserTiles(const LocaliserReport& report) {
    const LocaliserScores &own = report.scores.front(), &noisy = report.scores[report.scores.size() - 2];
    std::string all;
    for (std::size_t d = 0; d < own.error.size(); ++d) {
        const ShownError& shown = shownErrors[d];
        all += tile(cat(shown.name, ": CRPS"), fixed(shown.factor * own.error[d].crps, 2), shown.unit,
                    cat("ideal plus noise ", fixed(shown.factor * noisy.error[d].crps, 2)));
    }
    all += tile("poses reported", std::to_string(own.readings), "", cat("at ", std::to_string(own.cases), " instants"));
    return tileRow(all);
}

std::string posesCsv(const LocaliserReport& report, const SensorModel& model) {
    std::string text = report.synthetic ? "# synthetic: no real robot localised itself\n" : "";
    text += "robot,t,x,y,heading,v,w,reported,predicted_reported,sound";
    for (const ShownError& shown : shownErrors)
        text += cat(",error_", shown.key, ",expected_", shown.key, ",deviation_", shown.key);
    text += '\n';
    for (const LocaliserCase& one : report.cases) {
        ReadingDistribution predicted;
        model.distributions({&one.state, 1}, one.robot, {&predicted, 1});
        text += cat(one.robot, ",", secondsText(one.time));
        for (const double value :
             {one.state.own.x, one.state.own.y, one.state.own.heading, one.state.velocity.v, one.state.velocity.w})
            text += cat(",", numberText(value));
        text += cat(one.reported ? ",1," : ",0,", numberText(predicted.probability()), one.sound ? ",1" : ",0");
        for (std::size_t d = 0; d < shownErrors.size(); ++d) {
            text += one.reported ? cat(",", numberText(one.error[d])) : std::string(",");
            text += cat(",", numberText(predicted.mean(static_cast<int>(d))), ",",
                        numberText(predicted.deviation(static_cast<int>(d))));
        }
        text += '\n';
    }
    return text;
}

}  // namespace

Expected<void> checkLocaliserReportFolder(const std::filesystem::path& folder, bool overwrite) {
    return checkReportFolder(folder, localiserFiles, overwrite);
}

std::string localiserReportHtml(const LocaliserReport& report, const ReportContext& context) {
    const LearnedSensorModel model(report.network);
    const std::string title = "How true a learned localisation is";
    const std::string key = legend(cat(dotEntry("realdot", cat("a ", realWord(report.synthetic), " pose")),
                                       lineEntry("s0", "5 and 95 % of what is predicted")));
    const auto speed = [](const SensedState& state) { return state.velocity.v; };
    const auto turning = [](const SensedState& state) { return degrees * state.velocity.w; };
    const auto figure = [&](std::size_t dimension, const auto& xOf, const char* xTitle) {
        const std::string name = shownErrors[dimension].name;
        return card(capitalised(name), poseErrorFigure(report, model, dimension, xOf, xTitle));
    };
    HtmlTable facts({{"", {"", ""}}}, "words");
    addModelFacts(facts, context);
    if (!context.commandLine.empty()) facts.row({"made by", cat("<code>", escaped(context.commandLine), "</code>")});
    const std::string figures = cat(figure(0, speed, "speed (m/s)"), figure(1, speed, "speed (m/s)"),
                                    figure(1, turning, "rotation (°/s)"), figure(2, turning, "rotation (°/s)"));
    return reportPage(
        title,
        cat(pageHead(title, escaped(report.log), {report.log, report.synthetic}, context, {}), localiserTiles(report),
            tableCard(localiserTable(report)),
            paragraph("CRPS is the mean absolute error of what is predicted as a distribution. Errors are in the "
                      "robot’s true frame when it was measured. Log-likelihoods are of whether there was a report, and "
                      "of the density of all three errors together (1/m²/rad). Gross errors, ten times farther off "
                      "than most, count as reports alone."),
            heading("Errors of poses, less what was expected of them"),
            paragraph(cat("Nine of ten ", realWord(report.synthetic),
                          " poses should lie between the lines, however the robot moved.")),
            key, element("div", "paths", figures), heading("Where this comes from"), tableCard(facts.text()),
            foldedFiles(context.trainingLogs)));
}

std::string localiserScoresJson(const LocaliserReport& report, const ReportContext& context) {
    nlohmann::json json{{"log", report.log},
                        {"synthetic", report.synthetic},
                        {"sensor", report.network.sensor},
                        {"notices", context.notices},
                        {"models", nlohmann::json::array()}};
    for (const LocaliserScores& of : report.scores) {
        nlohmann::json model{{"name", of.name},
                             {"instants", of.cases},
                             {"poses", of.readings},
                             {"sound", of.sound},
                             {"report_log_likelihood", of.detection},
                             {"pose_log_likelihood", finiteOrNull(of.logDensity)}};
        for (std::size_t d = 0; d < of.error.size(); ++d)
            model[shownErrors[d].key] = {{"crps", of.error[d].crps},
                                         {"rmse", of.error[d].rmse},
                                         {"inside_50", of.error[d].inside50},
                                         {"inside_90", of.error[d].inside90},
                                         {"below", of.below[d]}};
        json["models"].push_back(std::move(model));
    }
    return json.dump(2);
}

Expected<void> writeLocaliserReport(const LocaliserReport& report, const ReportContext& context,
                                    const std::filesystem::path& folder) {
    return writeReportFiles(folder, {{localiserFiles[0], localiserReportHtml(report, context)},
                                     {localiserFiles[1], localiserScoresJson(report, context)},
                                     {localiserFiles[2], posesCsv(report, LearnedSensorModel(report.network))}});
}

}  // namespace mrose
