#include "report/error_figures.h"

#include <algorithm>
#include <cmath>

#include "drawing/svg_plot.h"
#include "io/format.h"
#include "report/legend.h"

namespace mrose {
namespace {

using Points = std::vector<Point>;

double inUnit(ErrorChannel channel, double error) {
    return (channel == ErrorChannel::position ? 100 : degrees) * error;
}

SvgPlot plotOverTime(ErrorChannel channel, double lastTime, double highestError) {
    const bool position = channel == ErrorChannel::position;
    SvgPlot plot({}, {0, lastTime}, {0, 1.06 * highestError},
                 position ? "Position error against time" : "Heading error against time");
    plot.axes("time since the start (s)", position ? "position error (cm)" : "heading error (°)");
    return plot;
}

/// From the origin.
Points over(const std::vector<ErrorsAt>& errors, ErrorChannel channel, double Distribution::*part) {
    Points points{{0, 0}};
    for (const ErrorsAt& at : errors)
        points.push_back(
            {at.time, inUnit(channel, (channel == ErrorChannel::position ? at.position : at.heading).*part)});
    return points;
}

/// The last instant with a known error, and the largest one.
Point extent(const std::vector<Points>& lines) {
    Point most{0, 0};
    for (const Points& line : lines)
        for (const Point& point : line)
            if (std::isfinite(point.y)) most = {std::max(most.x, point.x), std::max(most.y, point.y)};
    return most;
}

std::vector<double> perWindow(const LogWindows& log, const Assessment& model, ErrorChannel channel) {
    std::vector<double> values;
    for (std::size_t i = 0; i < model.errors.size(); ++i)
        if (channel == ErrorChannel::heading)
            values.push_back(degrees * model.errors[i].headingFinal);
        else if (drives(log.windows[i], log.options))
            values.push_back(100 * model.errors[i].positionMean / log.windows[i].path);
    std::sort(values.begin(), values.end());
    return values;
}

/// A robot's median errors, from the start on; not a number where none is known.
Points medianErrors(const Comparison& comparison, std::size_t robot, ErrorChannel channel) {
    std::vector<std::vector<double>> known;
    for (const ComparedRollout& rollout : comparison.rollouts) {
        if (rollout.robot != robot || rollout.simulated.empty()) continue;
        const WindowErrors& of = rollout.errors;
        const std::vector<double>& errors = channel == ErrorChannel::position ? of.position : of.heading;
        known.resize(std::max(known.size(), errors.size()));
        for (std::size_t k = 0; k < errors.size(); ++k)
            if (std::isfinite(errors[k])) known[k].push_back(errors[k]);
    }
    const double step = toSeconds(comparison.log.options.step);
    Points points{{0, 0}};
    for (std::size_t k = 0; k < known.size(); ++k)
        points.push_back({static_cast<double>(k + 1) * step, inUnit(channel, quantile(known[k], 0.5))});
    return points;
}

void drawBound(SvgPlot& plot, double bound, const Point& most) {
    if (bound > most.y) return;
    const Point ends[] = {{0, bound}, {most.x, bound}};
    plot.line(ends, "floorline");
    plot.label({0, bound}, 6, -5, "bound", "tick");
}

}  // namespace

std::string sinceDriveStart(const LogWindows& log, std::size_t window) {
    return fixed(toSeconds(log.windows[window].start - log.driveStarts[window]), 1);
}

std::string modelLegend(const Evaluation& evaluation) {
    std::string entries;
    for (std::size_t i = 0; i < evaluation.models.size(); ++i)
        entries += lineEntry(seriesClass(i), evaluation.models[i].name);
    return legend(entries);
}

bool foreseesErrors(const Evaluation& evaluation) {
    return !evaluation.forecasts.empty() && evaluation.forecasts.front().samples > 1 &&
           evaluation.forecasts.front().model == 0;
}

std::string errorOverTimeLegend(const Evaluation& evaluation) {
    std::string entries;
    for (std::size_t i = 0; i < evaluation.models.size(); ++i)
        entries += lineEntry(seriesClass(i), evaluation.models[i].name);
    const bool foreseen = foreseesErrors(evaluation);
    entries += boxEntry("band inner", foreseen ? "25–75 %, foreseen" : "25–75 %") +
               boxEntry("band", foreseen ? "10–90 %, foreseen" : "10–90 %");
    if (foreseen)
        entries +=
            lineEntry("s0 edge", "25 and 75 %, as it was") + lineEntry("s0 edge outer", "10 and 90 %, as it was");
    return legend(entries);
}

std::string manoeuvreLegend() {
    std::string entries;
    for (int kind = 0; kind < manoeuvreCount; ++kind)
        entries += boxEntry(cat("k", std::to_string(kind)), name(static_cast<Manoeuvre>(kind)));
    return legend(entries);
}

std::string robotLegend(const Comparison& comparison, const ComparedDivergences* divergences) {
    std::string entries;
    for (std::size_t i = 0; i < comparison.robots.size(); ++i)
        entries += lineEntry(seriesClass(i), comparison.robots[i].name);
    if (divergences != nullptr && !divergences->rollouts.empty() && comparison.requests.size() == 1)
        entries += dotEntry("leaves", cat("leaves the ", comparison.log.real(), " trajectory"));
    return legend(entries);
}

std::string errorOverTimeFigure(const Evaluation& evaluation, ErrorChannel channel) {
    const std::vector<ErrorsAt>& real = evaluation.models.front().overTime;
    const bool foreseen = foreseesErrors(evaluation);
    const std::vector<ErrorsAt>& banded = foreseen ? evaluation.forecasts.front().expected : real;
    std::vector<Points> lines;
    for (const Assessment& model : evaluation.models)
        lines.push_back(over(model.overTime, channel, &Distribution::median));
    const std::size_t models = lines.size();
    lines.push_back(over(real, channel, &Distribution::p90));
    lines.push_back(over(banded, channel, &Distribution::p90));
    SvgPlot plot = plotOverTime(channel, real.empty() ? 1 : real.back().time, extent(lines).y);
    plot.band(over(banded, channel, &Distribution::p10), lines.back(), "band");
    plot.band(over(banded, channel, &Distribution::p25), over(banded, channel, &Distribution::p75), "band inner");
    if (foreseen) {
        for (const auto share : {&Distribution::p10, &Distribution::p90})
            plot.line(over(real, channel, share), "s0 edge outer");
        for (const auto share : {&Distribution::p25, &Distribution::p75})
            plot.line(over(real, channel, share), "s0 edge");
    }
    for (std::size_t i = models; i-- > 0;) plot.line(lines[i], seriesClass(i));
    return plot.text();
}

std::string cumulativeFigure(const Evaluation& evaluation, ErrorChannel channel) {
    double right = 0;
    std::vector<std::vector<double>> values;
    for (const Assessment& model : evaluation.models) {
        values.push_back(perWindow(evaluation.log, model, channel));
        std::vector<double> reordered = values.back();
        right = std::max(right, 1.15 * quantile(reordered, 0.9));
    }
    const bool position = channel == ErrorChannel::position;
    SvgPlot plot({}, {0, right}, {0, 100},
                 position ? "Cumulative distribution of position errors" : "Cumulative distribution of heading errors");
    plot.axes(position ? "position error, time-mean / path (%)" : "heading error at the end (°)",
              "windows up to it (%)");
    for (std::size_t i = values.size(); i-- > 0;) {
        Points points{{0, 0}};
        for (std::size_t k = 0; k < values[i].size(); ++k)
            points.push_back({values[i][k], 100 * static_cast<double>(k + 1) / static_cast<double>(values[i].size())});
        if (!values[i].empty()) points.push_back({std::max(right, values[i].back()), 100});
        plot.steps(points, seriesClass(i));
    }
    return plot.text();
}

double highestBar(const Evaluation& evaluation) {
    std::vector<double> values;
    for (const WindowErrors& errors : evaluation.models.front().errors) values.push_back(100 * errors.positionMean);
    return 1.02 * quantile(values, 1);
}

std::string barsFigure(const Evaluation& evaluation, std::size_t robot, double top) {
    const LogWindows& log = evaluation.log;
    const auto isHis = [&](const Window& window) { return window.robot == robot; };
    const auto first = std::find_if(log.windows.begin(), log.windows.end(), isHis);
    const double before = static_cast<double>(first - log.windows.begin()) + 0.5;
    SvgPlot plot({.width = 1110, .height = 136, .left = 54, .right = 8, .top = 8, .bottom = 44},
                 {before, before + static_cast<double>(log.robots[robot].windows)}, {0, top},
                 cat("Errors of robot ", log.robots[robot].name));
    plot.axes("window", "error (cm)");
    for (std::size_t i = 0; i < log.windows.size(); ++i) {
        const Window& w = log.windows[i];
        if (!isHis(w)) continue;
        const double error = 100 * evaluation.models.front().errors[i].positionMean;
        plot.bar(static_cast<double>(i) + 0.6, 0.8, error, cat("k", std::to_string(static_cast<int>(w.manoeuvre))),
                 cat("window ", std::to_string(i + 1), ", from ", sinceDriveStart(log, i), " s: ", fixed(error, 1),
                     " cm, ", name(w.manoeuvre)));
    }
    return plot.text();
}

std::optional<std::size_t> stepLeft(const Comparison& comparison, std::size_t rollout,
                                    const ComparedDivergences* divergences) {
    const RolloutDivergence* const diverging = divergences == nullptr ? nullptr : divergences->of(rollout);
    if (diverging == nullptr) return std::nullopt;
    return static_cast<std::size_t>(diverging->divergence.time / comparison.log.options.step) - 1;
}

std::string errorOverTimeFigure(const Comparison& comparison, ErrorChannel channel,
                                const ComparedDivergences* divergences) {
    const bool position = channel == ErrorChannel::position;
    std::vector<Points> lines;
    for (std::size_t i = 0; i < comparison.robots.size(); ++i) lines.push_back(medianErrors(comparison, i, channel));
    const Point most = extent(lines);
    SvgPlot plot = plotOverTime(channel, most.x, most.y);
    if (divergences != nullptr && divergences->source == BoundSource::constant) {
        const DivergenceBound::At& bound = divergences->bound.constant;
        drawBound(plot, inUnit(channel, position ? bound.position : bound.heading), most);
    }
    for (std::size_t i = lines.size(); i-- > 0;) plot.line(lines[i], seriesClass(i));
    for (std::size_t i = 0; i < comparison.rollouts.size() && comparison.requests.size() == 1; ++i) {
        const auto left = stepLeft(comparison, i, divergences);
        if (!left) continue;
        const Divergence& divergence = divergences->of(i)->divergence;
        if (position ? divergence.byPosition : divergence.byHeading)
            plot.circle(lines[comparison.rollouts[i].robot][*left + 1], 5.5, "leaves");
    }
    return plot.text();
}

}  // namespace mrose
