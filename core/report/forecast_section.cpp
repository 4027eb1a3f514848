#include "report/forecast_section.h"

#include <algorithm>
#include <array>

#include "io/format.h"
#include "report/error_figures.h"
#include "report/legend.h"
#include "report/page.h"
#include "report/share_plot.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

constexpr std::array<const char*, ForecastAt::errors> errorNames{"along its heading", "across it", "heading"};

bool isSampled(const Forecast& forecast) { return forecast.samples > 1; }

std::string secondsOf(const ForecastAt& at) {
    return cat(secondsText(at.time, at.time % nanosecondsPerSecond ? 1 : 0), " s");
}

/// Of all instants and errors together, in %.
double insideOf(const Forecast& forecast, double share) {
    double inside = 0, all = 0;
    for (const ForecastAt& at : forecast.at) {
        const auto windows = static_cast<double>(at.ranks.size());
        inside += windows * at.inside(share);
        all += windows;
    }
    return 100 * inside / all;
}

std::string forecastTable(const Evaluation& evaluation) {
    const std::vector<Forecast>& forecasts = evaluation.forecasts;
    std::vector<std::string> instants, widths{"along cm", "across cm", "heading °"};
    for (const ForecastAt& at : forecasts.front().at) instants.push_back(secondsOf(at));
    instants.emplace_back("sum");
    const std::string last = secondsOf(forecasts.front().at.back());
    HtmlTable table({{"", {""}},
                     {"position: energy score, cm", instants},
                     {"", {"heading:<br/>CRPS, sum °", "moves:<br/>energy, cm"}},
                     {"inside the central", {"50 %", "90 %", "off at most"}},
                     {cat("width of 90 % after ", last), widths}},
                    "dense");
    std::size_t series = 0;
    for (const Forecast& forecast : forecasts) {
        std::vector<std::string> cells{seriesName(forecast.name, series++)};
        for (const ForecastAt& at : forecast.at) cells.push_back(fixed(100 * at.energy, 2));
        for (const double value : {100 * forecast.energy(), degrees * forecast.heading(), 100 * forecast.moves})
            cells.push_back(fixed(value, 2));
        if (isSampled(forecast)) {
            for (const double share : {0.5, 0.9}) cells.push_back(fixed(insideOf(forecast, share), 1));
            cells.push_back(fixed(forecast.miss(), 1));
            const ForecastAt::PerError& wide = forecast.at.back().nineTenths;
            for (const double width : {100 * wide[0], 100 * wide[1], degrees * wide[2]})
                cells.push_back(fixed(width, 1));
        } else {
            cells.insert(cells.end(), 6, "–");
        }
        table.row(cells);
    }
    return table.text();
}

/// Of all instants together: samples have gaps before, between and behind them, and the central ones make up a part.
std::vector<Point> insideLine(const Forecast& forecast, std::size_t error) {
    const int gaps = forecast.samples + 1;
    std::vector<Point> points{{0, 0}};
    for (int central = 2 - gaps % 2; central <= gaps; central += 2) {
        const double part = static_cast<double>(central) / gaps;
        double inside = 0, all = 0;
        for (const ForecastAt& at : forecast.at) {
            const auto windows = static_cast<double>(at.ranks.size());
            inside += windows * at.inside(part, error);
            all += windows;
        }
        points.push_back({100 * part, 100 * inside / all});
    }
    return points;
}

std::string insideFigure(const Evaluation& evaluation, std::size_t error) {
    SvgPlot plot =
        sharePlot(cat(capitalised(evaluation.log.real()), " values inside the central part, ", errorNames[error]),
                  "central part of the samples (%)", cat(evaluation.log.real(), " values inside (%)"));
    const std::vector<Forecast>& forecasts = evaluation.forecasts;
    for (std::size_t i = forecasts.size(); i-- > 0;)
        if (isSampled(forecasts[i])) plot.line(insideLine(forecasts[i], error), seriesClass(i));
    return plot.text();
}

std::string forecastLegend(const Evaluation& evaluation) {
    std::string entries;
    for (std::size_t i = 0; i < evaluation.forecasts.size(); ++i)
        if (isSampled(evaluation.forecasts[i])) entries += lineEntry(seriesClass(i), evaluation.forecasts[i].name);
    return legend(entries);
}

}  // namespace

std::string forecastHeadline(const Evaluation& evaluation) {
    if (!foreseesErrors(evaluation)) return {};
    const Forecast& forecast = evaluation.forecasts.front();
    return cat(" Of where the robot is to be expected it says the central 50 and 90\u00a0%: ",
               fixed(insideOf(forecast, 0.5), 0), " and ", fixed(insideOf(forecast, 0.9), 0), "\u00a0% of what the ",
               evaluation.log.real(), " robot did lie <a href=\"#doubt\">inside</a>.");
}

std::string forecastSection(const Evaluation& evaluation) {
    if (evaluation.forecasts.empty()) return {};
    std::string figures;
    for (std::size_t e = 0; e < errorNames.size(); ++e)
        figures += card(capitalised(errorNames[e]), insideFigure(evaluation, e));
    return cat(
        element("h2", {{"id", "doubt"}}, "What its doubt is worth"),
        paragraph(cat("A network that knows its noise was asked for ",
                      std::to_string(evaluation.forecasts.front().samples),
                      " runs of each window, as simulated robots would drive them. Scores are proper and in the units "
                      "of the errors: lower is better, and only who knows how the robot strays can be lowest. Of the "
                      "mean alone they are its mean errors. The constant noise is drawn anew in each period, in "
                      "proportion to what is driven, and as large as suits what was held out in learning best.")),
        tableCard(forecastTable(evaluation)),
        paragraph(
            "How much of what happened lies in the central part of the samples, seen from their mean pose, all "
            "instants of the table together. On the dashed diagonal a model says what happens; below it, its runs "
            "differ too little, above it, too much."),
        forecastLegend(evaluation), element("div", "paths", figures));
}

}  // namespace mrose
