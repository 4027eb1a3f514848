#include "report/kick_report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "assessment/reading_scores.h"
#include "geometry/pose.h"
#include "io/format.h"
#include "logs/robot_log.h"
#include "report/kick_text.h"
#include "report/legend.h"
#include "report/residual_figure.h"

namespace mrose {
namespace {

constexpr const char* kickFiles[] = {"report.html", "results.json", "kicks.csv"};

/// One quantity of a kick, as pages show it.
struct ShownQuantity {
    const char *name, *unit;
    double factor;  ///< to that unit
    bool ofDelay;
    int dimension;
};
constexpr std::array<ShownQuantity, 3> shownQuantities{
    {{"delay", "ms", 1000, true, 0}, {"speed", "m/s", 1, false, 0}, {"direction", "°", degrees, false, 1}}};

ReadingDistribution predictedOf(const KickReport& report, const KickSample& kick, const ShownQuantity& shown) {
    return shown.ofDelay ? report.kicker.delay(kick.commanded()) : report.kicker.departure(kick.state);
}

double happened(const KickReport& report, const KickSample& kick, std::size_t quantity) {
    if (quantity == 0) return kick.delay;
    return quantity == 1 ? kick.speed : wrapAngle(kick.direction - report.kicker.network().direction);
}

/// Each hit's quantity against one of what it depends on.
std::string kickFigure(const KickReport& report, std::size_t quantity, std::size_t input, double xFactor,
                       const char* xTitle) {
    const ShownQuantity& shown = shownQuantities[quantity];
    std::vector<ResidualDot> dots;
    for (const KickSample& kick : report.kicks) {
        if (!kick.hit) continue;
        const ReadingDistribution predicted = predictedOf(report, kick, shown);
        const auto quantile = [&](double share) { return errorQuantile(predicted, shown.dimension, share); };
        const double middle = quantile(0.5);
        dots.push_back({xFactor * kick.state.values()[input],
                        shown.factor * (happened(report, kick, quantity) - middle),
                        shown.factor * (quantile(0.05) - middle), shown.factor * (quantile(0.95) - middle)});
    }
    return residualFigure(std::move(dots), cat(shown.name, " less its predicted median"), xTitle,
                          cat(shown.name, " less predicted median (", shown.unit, ")"));
}

std::string kickScoreTable(const KickReport& report) {
    HtmlTable table({{"", {""}},
                     {"CRPS", {"delay, ms", "speed, cm/s", "direction, °"}},
                     {"inside 50 / 90 %", {"delay", "speed", "direction"}},
                     {"mean log-likelihood", {"hit", "delay", "departure"}}});
    const auto inside = [](const KickScores::Quantity& of) {
        return cat(fixed(100 * of.inside50, 0), " / ", fixed(100 * of.inside90, 0));
    };
    for (const KickScores& of : report.scores) {
        const auto& q = of.quantities;
        table.row({escaped(of.name), fixed(1000 * q[0].crps, 2), fixed(100 * q[1].crps, 2),
                   fixed(degrees * q[2].crps, 2), inside(q[0]), inside(q[1]), inside(q[2]), fixedWithMinus(of.hit, 3),
                   fixedWithMinus(of.delay, 2), fixedWithMinus(of.departure, 2)});
    }
    return table.text();
}

std::string kickTiles(const KickReport& report) {
    const KickScores &own = report.scores[0], &noisy = report.scores[1];
    std::string all;
    constexpr std::array<double, 3> factors{1000, 100, degrees};
    constexpr std::array<const char*, 3> units{"ms", "cm/s", "°"};
    for (std::size_t i = 0; i < 3; ++i)
        all += tile(cat(shownQuantities[i].name, ": CRPS"), fixed(factors[i] * own.quantities[i].crps, 2), units[i],
                    cat("analytic plus noise ", fixed(factors[i] * noisy.quantities[i].crps, 2)));
    all += tile("kicks that met the ball", std::to_string(own.hits), "", cat("of ", std::to_string(own.kicks)));
    return tileRow(all);
}

std::string kicksCsv(const KickReport& report) {
    std::string text = report.synthetic ? "# synthetic: no real kicker kicked\n" : "";
    text += "power,robot_v,robot_w,ball_x,ball_y,hit,predicted_hit,delay_s,speed_mps,direction_rad";
    for (const char* name : {"delay_s", "speed_mps", "direction_rad"})
        for (const char* share : {"05", "50", "95"}) text += cat(",predicted_", name, "_", share);
    text += '\n';
    for (const KickSample& kick : report.kicks) {
        for (const double value : kick.state.values()) text += cat(numberText(value), ",");
        text += cat(kick.hit ? "1," : "0,", numberText(report.kicker.departure(kick.state).probability()));
        for (std::size_t i = 0; i < 3; ++i)
            text += kick.hit ? cat(",", numberText(happened(report, kick, i))) : std::string(",");
        for (const ShownQuantity& shown : shownQuantities)
            for (const double share : {0.05, 0.5, 0.95})
                text += cat(",", numberText(errorQuantile(predictedOf(report, kick, shown), shown.dimension, share)));
        text += '\n';
    }
    return text;
}

}  // namespace

Expected<void> checkKickReportFolder(const std::filesystem::path& folder, bool overwrite) {
    return checkReportFolder(folder, kickFiles, overwrite);
}

std::string kickReportHtml(const KickReport& report, const ReportContext& context) {
    const std::string_view word = realWord(report.synthetic);
    const std::string title = "How true a learned kicker is";
    const std::string key = legend(cat(dotEntry("realdot", cat("a ", word, " kick that met the ball")),
                                       lineEntry("s0", "5 and 95 % of what is predicted")));
    HtmlTable facts({{"", {"", ""}}}, "words");
    addModelFacts(facts, context);
    if (!context.commandLine.empty()) facts.row({"made by", cat("<code>", escaped(context.commandLine), "</code>")});
    const std::string first =
        cat(card("Delay", kickFigure(report, 0, 0, 1, "power")), card("Speed", kickFigure(report, 1, 0, 1, "power")));
    const std::string second =
        cat(card("Speed", kickFigure(report, 1, 4, 100, "ball left of the robot's middle (cm)")),
            card("Direction", kickFigure(report, 2, 4, 100, "ball left of the robot's middle (cm)")));
    return reportPage(
        title,
        cat(pageHead(title, escaped(report.log), {report.log, report.synthetic}, context, {}), kickTiles(report),
            tableCard(kickScoreTable(report)),
            paragraph("CRPS is the mean absolute error of what is predicted as a distribution. Directions are from the "
                      "one in which it kicks. Log-likelihoods are of whether the ball left, and of the densities of "
                      "delay (1/s) and of speed and direction (s/m/rad)."),
            heading("What a kick did, less what was expected of it"),
            paragraph(cat("Nine of ten ", word,
                          " kicks should lie between the lines, whatever power they had and "
                          "wherever the ball lay.")),
            key, element("div", "paths", cat(first, second)), heading("Where this comes from"), tableCard(facts.text()),
            foldedFiles(context.trainingLogs)));
}

Expected<void> writeKickReport(const KickReport& report, const ReportContext& context,
                               const std::filesystem::path& folder) {
    return writeReportFiles(folder, {{kickFiles[0], kickReportHtml(report, context)},
                                     {kickFiles[1], kickScoresJson(report.scores, report.synthetic, context.notices)},
                                     {kickFiles[2], kicksCsv(report)}});
}

}  // namespace mrose
