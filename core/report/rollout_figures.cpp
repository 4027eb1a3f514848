#include "report/rollout_figures.h"

#include <algorithm>
#include <cmath>

#include "drawing/markup.h"
#include "drawing/rollout_drawing.h"
#include "drawing/svg_plot.h"
#include "io/format.h"
#include "report/evaluation_figures.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

constexpr int sceneArrows = 6, cardArrows = 12;  // of a path

/// A robot's median errors, from the start on; not a number where none is known.
std::vector<PlotPoint> medianErrors(const Comparison& comparison, std::size_t robot, ErrorKind kind) {
    const bool position = kind == ErrorKind::position;
    std::vector<std::vector<double>> known;
    for (const ComparedRollout& rollout : comparison.rollouts) {
        if (rollout.robot != robot || rollout.simulated.empty()) continue;
        const std::vector<double>& errors = position ? rollout.errors.position : rollout.errors.heading;
        known.resize(std::max(known.size(), errors.size()));
        for (std::size_t k = 0; k < errors.size(); ++k)
            if (std::isfinite(errors[k])) known[k].push_back(errors[k]);
    }
    const double step = toSeconds(comparison.log.options.step);
    std::vector<PlotPoint> points{{0, 0}};
    for (std::size_t k = 0; k < known.size(); ++k)
        points.push_back({static_cast<double>(k + 1) * step, (position ? 100 : degrees) * quantile(known[k], 0.5)});
    return points;
}

/// Between heading arrows, so that a path has about `most` of them: a round number of seconds, less than one where
/// rollouts are short.
Nanoseconds arrowInterval(const Comparison& comparison, int most) {
    int steps = 0;
    for (const RolloutRequest& request : comparison.requests) steps = std::max(steps, request.steps);
    const Nanoseconds longest = steps * comparison.log.options.step;
    constexpr Nanoseconds second = nanosecondsPerSecond;
    for (const Nanoseconds interval :
         {second / 5, second, 2 * second, 5 * second, 10 * second, 20 * second, 30 * second})
        if (longest <= most * interval) return interval;
    return longest / most / (60 * second) * (60 * second) + 60 * second;
}

/// "second", "4 s".
std::string intervalText(Nanoseconds interval) {
    return interval == nanosecondsPerSecond ? "second"
                                            : cat(secondsText(interval, interval < nanosecondsPerSecond ? 1 : 0), " s");
}

/// The step after which a rollout has left the real one: an index into its errors and its simulated poses.
std::optional<std::size_t> stepLeft(const Comparison& comparison, std::size_t rollout,
                                    const ComparedDivergences* divergences) {
    const RolloutDivergence* const diverging = divergences == nullptr ? nullptr : divergences->of(rollout);
    if (diverging == nullptr) return std::nullopt;
    return static_cast<std::size_t>(diverging->divergence.time / comparison.log.options.step) - 1;
}

void drawBound(SvgPlot& plot, double bound, PlotPoint most, const char* text) {
    if (bound > most.y) return;
    const PlotPoint ends[] = {{0, bound}, {most.x, bound}};
    plot.line(ends, "floorline");
    plot.label({0, bound}, 6, -5, text, "tick");
}

}  // namespace

std::string errorLinesLegend(const Comparison& comparison, const ComparedDivergences* divergences) {
    std::string entries;
    for (std::size_t i = 0; i < comparison.robots.size(); ++i)
        entries += lineEntry(seriesClass(i), comparison.robots[i].name);
    if (divergences != nullptr && !divergences->rollouts.empty() && comparison.requests.size() == 1)
        entries += leavesEntry();
    return element("div", "legend", entries);
}

std::string errorLinesFigure(const Comparison& comparison, ErrorKind kind, const ComparedDivergences* divergences) {
    const bool position = kind == ErrorKind::position;
    std::vector<std::vector<PlotPoint>> lines;
    PlotPoint most{0, 0};
    for (std::size_t i = 0; i < comparison.robots.size(); ++i) {
        lines.push_back(medianErrors(comparison, i, kind));
        for (const PlotPoint& point : lines.back())
            if (std::isfinite(point.y)) most = {std::max(most.x, point.x), std::max(most.y, point.y)};
    }
    SvgPlot plot({}, {0, most.x}, {0, 1.06 * most.y},
                 position ? "Position error against time" : "Heading error against time");
    plot.axes("time since the start (s)", position ? "position error (cm)" : "heading error (°)");
    if (divergences != nullptr && !divergences->fromHeldOut) {
        const DivergenceBound::At& bound = divergences->bound.constant;
        drawBound(plot, position ? 100 * bound.position : degrees * bound.heading, most, "bound");
    }
    for (std::size_t i = lines.size(); i-- > 0;) plot.line(lines[i], seriesClass(i));
    for (std::size_t i = 0; i < comparison.rollouts.size() && comparison.requests.size() == 1; ++i) {
        const RolloutDivergence* of = divergences != nullptr ? divergences->of(i) : nullptr;
        const auto left = stepLeft(comparison, i, divergences);
        if (of == nullptr || !left) continue;
        if (position ? of->divergence.byPosition : of->divergence.byHeading)
            plot.circle(lines[comparison.rollouts[i].robot][*left + 1], 5.5, "leaves");
    }
    return plot.text();
}

std::string rolloutFigure(const Comparison& comparison, std::size_t request, const Environment& environment,
                          const ComparedDivergences* divergences) {
    std::vector<DrawnRollout> drawn;
    std::string absent;
    for (std::size_t i = 0; i < comparison.rollouts.size(); ++i) {
        const ComparedRollout& rollout = comparison.rollouts[i];
        if (rollout.request != request) continue;
        if (rollout.simulated.empty()) {
            absent += (absent.empty() ? "; no ground truth then of " : ", ") + comparison.robots[rollout.robot].name;
            continue;
        }
        DrawnRollout shown{comparison.robots[rollout.robot].name, rollout.real.truth, {rollout.real.measuredPose}, {}};
        shown.simulated.insert(shown.simulated.end(), rollout.simulated.begin(), rollout.simulated.end());
        if (std::isfinite(rollout.errors.positionFinal))
            shown.miss = fixed(100 * rollout.errors.positionFinal, 1) + " cm";
        if (const auto left = stepLeft(comparison, i, divergences)) shown.leaves = *left + 1;
        drawn.push_back(std::move(shown));
    }
    const RolloutRequest& shown = comparison.requests[request];
    const Nanoseconds step = comparison.log.options.step, between = arrowInterval(comparison, sceneArrows);
    return drawRollouts(environment,
                        {.title = comparison.scenario + ", rollout " + std::to_string(request + 1),
                         .subtitle = secondsText(shown.steps * step, 0) + " s of driving, from " +
                                     secondsText(shown.start, 0) + " s after the log’s start" + absent,
                         .arrowEvery = static_cast<std::size_t>(std::max<Nanoseconds>(1, between / step)),
                         .arrowInterval = "every " + intervalText(between)},
                        drawn);
}

std::string robotFigure(const Comparison& comparison, std::size_t index, const ComparedDivergences* divergences) {
    const ComparedRollout& rollout = comparison.rollouts[index];
    const Nanoseconds every = arrowInterval(comparison, cardArrows) / comparison.log.options.step;
    return pathFigure({.real = rollout.real.truth,
                       .start = rollout.real.measuredPose,
                       .predicted = {rollout.simulated},
                       .arrowEvery = static_cast<std::size_t>(std::max<Nanoseconds>(1, every)),
                       .leaves = stepLeft(comparison, index, divergences)});
}

std::string robotFigureLegend(const Comparison& comparison, bool divergences) {
    return element(
        "div", "legend",
        cat(lineEntry("real", "real path"), lineEntry(seriesClass(0), "simulated path"),
            pathMarkEntries(intervalText(arrowInterval(comparison, cardArrows))), divergences ? leavesEntry() : ""));
}

}  // namespace mrose
