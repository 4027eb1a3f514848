#include "report/path_figures.h"

#include <algorithm>
#include <cmath>

#include "drawing/rollout_drawing.h"
#include "drawing/svg_plot.h"
#include "geometry/area.h"
#include "io/format.h"
#include "report/error_figures.h"
#include "report/legend.h"
#include "report/page.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

constexpr int sceneArrows = 6, cardArrows = 12;  // of a path
constexpr double width = 340;                    // pixels, of a path's figure

using Poses = std::vector<Pose>;

/// The first prediction is the one that matters; paths are interrupted where a pose is not finite.
struct PathFigure {
    const char* what;  ///< "real", "logged": LogWindows::real()
    const Poses& real;
    Pose start;  ///< of the predictions
    std::vector<const Poses*> predicted;
    std::vector<std::size_t> series;  ///< of each
    Nanoseconds arrowInterval = 0, step = 1;
    std::span<const PoseRegion> regions = {};  ///< where the first one may be
    std::optional<std::size_t> leaves = {};    ///< where the first prediction leaves the real path, in it: a ring
};

std::vector<Point> positions(std::span<const Pose> poses) {
    std::vector<Point> points;
    for (const Pose& pose : poses) points.push_back(position(pose));
    return points;
}

/// The start and the prediction's poses, so that a path has its begin.
Poses withStart(const Pose& start, const Poses& predicted) {
    Poses poses{start};
    poses.insert(poses.end(), predicted.begin(), predicted.end());
    return poses;
}

void include(Area& area, const Poses& poses) {
    for (const Pose& pose : poses)
        if (std::isfinite(pose.x)) area.include(position(pose));
}

/// Room for arrows, and at least 5 cm of field where a robot turns on the spot.
PlotRange widened(double low, double high, double most) {
    const double margin = 0.09 * most, lacking = std::max(0.0, 0.05 - (high - low)) / 2;
    return {low - margin - lacking, high + margin + lacking};
}

std::string barText(double metres) {
    return metres < 0.995 ? cat(fixed(100 * metres, 0), " cm") : cat(fixed(metres, 0), " m");
}

std::size_t stride(Nanoseconds interval, Nanoseconds step) {
    return static_cast<std::size_t>(std::max<Nanoseconds>(1, interval / step));
}

std::string drawn(const PathFigure& figure) {
    Area area{position(figure.start), position(figure.start)};
    include(area, figure.real);
    for (const Poses* predicted : figure.predicted) include(area, *predicted);
    for (const PoseRegion& region : figure.regions)
        for (const Point& corner : region.outline(RegionShare::most)) area.include(corner);
    const Point size = area.most - area.least;
    const double most = std::max({size.x, size.y, 0.05});
    SvgPlot plot =
        SvgPlot::equalScale({.width = width, .height = 290, .left = 0, .right = 0, .top = 0, .bottom = 28},
                            widened(area.least.x, area.most.x, most), widened(area.least.y, area.most.y, most),
                            cat(capitalised(figure.what), " and predicted path"));
    const double bar = axisTicks({0, width * plot.unitsPerPixel()}, 5).step;
    plot.grid(bar);
    plot.area(swathOf(figure.regions, RegionShare::most), "band");
    plot.area(swathOf(figure.regions, RegionShare::half), "band inner");
    for (std::size_t i = figure.predicted.size(); i-- > 1;)
        plot.line(positions(withStart(figure.start, *figure.predicted[i])),
                  cat(seriesClass(figure.series[i]), " thin"));
    const Poses& predicted = *figure.predicted.front();
    const Poses shown = withStart(figure.start, predicted);
    const Point ends[] = {position(figure.real.back()), position(predicted.back())};
    plot.line(positions(figure.real), "real");
    plot.line(positions(shown), seriesClass(0));
    plot.line(ends, "miss");
    const auto drawArrows = [&](const Poses& poses, std::string_view cssClass) {
        for (std::size_t i = 0; i < poses.size(); i += stride(figure.arrowInterval, figure.step))
            plot.arrow(position(poses[i]), poses[i].heading, 15, cssClass);
    };
    drawArrows(figure.real, "arrow real");
    drawArrows(shown, "arrow s0");
    plot.circle(position(figure.real[0]), 4.5, "start");
    if (figure.leaves) plot.circle(position(predicted[*figure.leaves]), 5.5, "leaves");
    plot.scaleBar(bar, barText(bar));
    return plot.text();
}

/// Between heading arrows: a second, less where windows are short.
Nanoseconds arrowInterval(const LogWindows& log) {
    int most = 0;
    for (const Window& window : log.windows) most = std::max(most, window.steps());
    return most * log.options.step >= 5 * nanosecondsPerSecond ? nanosecondsPerSecond : nanosecondsPerSecond / 5;
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

/// "heading, every second", "heading, every 4 s".
std::string everyText(Nanoseconds interval) {
    if (interval == nanosecondsPerSecond) return "every second";
    return cat("every ", secondsText(interval, interval < nanosecondsPerSecond ? 1 : 0), " s");
}

std::string markEntries(Nanoseconds interval) {
    return cat(dotEntry("start", "start"), arrowEntry("s0", cat("heading, ", everyText(interval))),
               lineEntry("miss", "error at the end"));
}

}  // namespace

std::vector<std::size_t> drawnModels(const Evaluation& evaluation) {
    const auto& models = evaluation.models;
    std::vector<std::size_t> drawn{0};
    const auto best = std::min_element(models.begin() + 1, models.end(),
                                       [](const auto& a, const auto& b) { return a.all.p < b.all.p; });
    if (best != models.end()) drawn.push_back(static_cast<std::size_t>(best - models.begin()));
    return drawn;
}

std::string pathLegend(const Evaluation& evaluation) {
    std::string entries = lineEntry("real", cat(evaluation.log.real(), " path"));
    for (const std::size_t i : drawnModels(evaluation)) {
        const std::string& name = evaluation.models[i].name;
        entries += i == 0 ? lineEntry(seriesClass(i), name)
                          : lineEntry(cat(seriesClass(i), " thin"),
                                      evaluation.models.size() > 2 ? cat(name, " (best of the others by P)") : name);
    }
    if (foreseesErrors(evaluation)) entries += boxEntry("band inner", "50 % of its runs") + boxEntry("band", "90 %");
    return legend(entries + markEntries(arrowInterval(evaluation.log)));
}

std::string pathFigure(const Evaluation& evaluation, std::size_t index) {
    const LogWindows& log = evaluation.log;
    const Window& window = log.windows[index];
    PathFigure figure{log.real(), window.truth, window.measuredPose, {}, drawnModels(evaluation)};
    for (const std::size_t i : figure.series) figure.predicted.push_back(&evaluation.models[i].predicted[index]);
    figure.arrowInterval = arrowInterval(log);
    figure.step = log.options.step;
    if (foreseesErrors(evaluation)) figure.regions = evaluation.forecasts.front().regions[index];
    return drawn(figure);
}

std::string pathFigure(const Comparison& comparison, std::size_t index, const ComparedDivergences* divergences) {
    const ComparedRollout& rollout = comparison.rollouts[index];
    return drawn({.what = comparison.log.real(),
                  .real = rollout.real.truth,
                  .start = rollout.real.measuredPose,
                  .predicted = {&rollout.simulated},
                  .series = {0},
                  .arrowInterval = arrowInterval(comparison, cardArrows),
                  .step = comparison.log.options.step,
                  .leaves = stepLeft(comparison, index, divergences)});
}

std::string pathLegend(const Comparison& comparison, const ComparedDivergences* divergences) {
    const char* const real = comparison.log.real();
    const bool anyLeaves = divergences != nullptr && !divergences->rollouts.empty();
    return legend(cat(lineEntry("real", cat(real, " path")), lineEntry(seriesClass(0), "simulated path"),
                      markEntries(arrowInterval(comparison, cardArrows)),
                      anyLeaves ? dotEntry("leaves", cat("leaves the ", real, " trajectory")) : ""));
}

std::string rolloutFigure(const Comparison& comparison, std::size_t request, const Environment& environment,
                          const ComparedDivergences* divergences) {
    std::vector<DrawnRollout> drawn;
    std::string absent;
    for (std::size_t i = 0; i < comparison.rollouts.size(); ++i) {
        const ComparedRollout& rollout = comparison.rollouts[i];
        if (rollout.request != request) continue;
        const std::string& name = comparison.robots[rollout.robot].name;
        if (rollout.simulated.empty()) {
            absent += (absent.empty() ? "; no ground truth then of " : ", ") + name;
            continue;
        }
        DrawnRollout shown{name, rollout.real.truth, withStart(rollout.real.measuredPose, rollout.simulated), {}};
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
                         .arrowEvery = stride(between, step),
                         .arrowInterval = everyText(between),
                         .real = comparison.log.real()},
                        drawn);
}

}  // namespace mrose
