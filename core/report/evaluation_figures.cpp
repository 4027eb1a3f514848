#include "report/evaluation_figures.h"

#include <algorithm>
#include <cmath>

#include "drawing/markup.h"
#include "drawing/svg_plot.h"
#include "io/format.h"
#include "report/page_style.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

using Points = std::vector<PlotPoint>;

std::string swatch(std::string_view marks) {
    return cat("<svg width=\"34\" height=\"12\" viewBox=\"0 0 34 12\" aria-hidden=\"true\">", marks, "</svg>");
}

std::string boxEntry(std::string_view cssClass, std::string_view label) {
    return cat("<span>", swatch(cat("<rect class=\"", cssClass, "\" x=\"1\" y=\"0\" width=\"32\" height=\"12\"/>")),
               escaped(label), "</span>\n");
}

Points over(const std::vector<ErrorsAt>& errors, Channel channel, double Distribution::*part) {
    Points points;
    for (const ErrorsAt& at : errors)
        points.push_back(
            {at.time, channel == Channel::position ? 100 * (at.position.*part) : degrees * (at.heading.*part)});
    return points;
}

double highest(const Points& points) {
    double high = 0;
    for (const PlotPoint& p : points)
        if (std::isfinite(p.y)) high = std::max(high, p.y);
    return high;
}

Points fromOrigin(Points points) {
    points.insert(points.begin(), PlotPoint{0, 0});
    return points;
}

std::vector<double> perWindow(const Evaluation& evaluation, const Assessment& model, Channel channel) {
    std::vector<double> values;
    for (std::size_t i = 0; i < model.errors.size(); ++i) {
        const double path = evaluation.log.windows[i].path;
        if (channel == Channel::heading)
            values.push_back(degrees * model.errors[i].headingFinal);
        else if (path >= evaluation.log.options.leastPath * evaluation.log.windows[i].steps() *
                             toSeconds(evaluation.log.options.step) / 10)
            values.push_back(100 * model.errors[i].positionMean / path);
    }
    std::sort(values.begin(), values.end());
    return values;
}

Points positions(std::span<const Pose> poses) {
    Points points;
    for (const Pose& pose : poses) points.push_back({pose.x, pose.y});
    return points;
}

/// The start and the prediction's poses, so that a path has its begin.
std::vector<Pose> withStart(const Pose& start, std::span<const Pose> predicted) {
    std::vector<Pose> poses{start};
    poses.insert(poses.end(), predicted.begin(), predicted.end());
    return poses;
}

struct Extent {
    PlotRange x, y;

    void include(std::span<const Pose> poses) {
        for (const Pose& pose : poses) {
            if (!std::isfinite(pose.x)) continue;
            x = {std::min(x.low, pose.x), std::max(x.high, pose.x)};
            y = {std::min(y.low, pose.y), std::max(y.high, pose.y)};
        }
    }
    /// Room for arrows, and at least 5 cm of field where a robot turns on the spot.
    void widen() {
        const double most = std::max({x.high - x.low, y.high - y.low, 0.05});
        const double margin = 0.09 * most;
        for (PlotRange* range : {&x, &y}) {
            const double lacking = std::max(0.0, 0.05 - (range->high - range->low)) / 2;
            *range = {range->low - margin - lacking, range->high + margin + lacking};
        }
    }
};

std::string lengthText(double metres) {
    return metres < 0.995 ? cat(fixed(100 * metres, 0), " cm") : cat(fixed(metres, 0), " m");
}

/// Between heading arrows: a second, less where windows are short.
Nanoseconds arrowInterval(const Evaluation& evaluation) {
    int most = 0;
    for (const Window& window : evaluation.log.windows) most = std::max(most, window.steps());
    const Nanoseconds longest = most * evaluation.log.options.step;
    return longest >= 5 * nanosecondsPerSecond ? nanosecondsPerSecond : nanosecondsPerSecond / 5;
}

std::size_t arrowStride(const Evaluation& evaluation) {
    const Nanoseconds every = arrowInterval(evaluation) / evaluation.log.options.step;
    return static_cast<std::size_t>(std::max<Nanoseconds>(1, every));
}

void drawArrows(SvgPlot& plot, std::size_t every, std::span<const Pose> poses, std::string_view css) {
    for (std::size_t i = 0; i < poses.size(); i += every)
        plot.arrow({poses[i].x, poses[i].y}, poses[i].heading, 15, css);
}

}  // namespace

std::string seriesClass(std::size_t model) {
    return cat("s", std::to_string(model < seriesStyles ? model : 1 + (model - 1) % (seriesStyles - 1)));
}

std::string lineEntry(std::string_view cssClass, std::string_view label) {
    return cat("<span>", swatch(cat("<path class=\"line ", cssClass, "\" d=\"M1 6H33\"/>")), escaped(label),
               "</span>\n");
}

std::string pathMarkEntries(std::string_view interval) {
    return cat("<span>", swatch("<circle class=\"start\" cx=\"17\" cy=\"6\" r=\"4.5\"/>"), "start</span>\n", "<span>",
               swatch("<path class=\"arrow s0\" d=\"M6 6H22M22 3L28 6L22 9Z\"/>"), "heading, every ", interval,
               "</span>\n", "<span>", swatch("<path class=\"line miss\" d=\"M1 6H33\"/>"), "error at the end</span>\n");
}

std::string leavesEntry() {
    return cat("<span>", swatch("<circle class=\"leaves\" cx=\"17\" cy=\"6\" r=\"4.5\"/>"),
               "leaves the real trajectory</span>\n");
}

std::vector<std::size_t> drawnModels(const Evaluation& evaluation) {
    const auto& models = evaluation.models;
    std::vector<std::size_t> drawn{0};
    const auto best = std::min_element(models.begin() + 1, models.end(),
                                       [](const auto& a, const auto& b) { return a.all.p < b.all.p; });
    if (best != models.end()) drawn.push_back(static_cast<std::size_t>(best - models.begin()));
    return drawn;
}

std::string sinceDriveStart(const Evaluation& evaluation, std::size_t window) {
    return fixed(toSeconds(evaluation.log.windows[window].start - evaluation.log.driveStarts[window]), 1);
}

std::string modelName(const Evaluation& evaluation, std::size_t model) {
    return cat("<span class=\"model\">", swatch(cat("<path class=\"line ", seriesClass(model), "\" d=\"M1 6H33\"/>")),
               escaped(evaluation.models[model].name), "</span>");
}

std::string modelLegend(const Evaluation& evaluation) {
    std::string entries;
    for (std::size_t i = 0; i < evaluation.models.size(); ++i)
        entries += lineEntry(seriesClass(i), evaluation.models[i].name);
    return element("div", "legend", entries);
}

std::string pathLegend(const Evaluation& evaluation) {
    const Nanoseconds between = arrowInterval(evaluation);
    const std::string interval = between == nanosecondsPerSecond ? "second" : cat(secondsText(between), " s");
    std::string entries = lineEntry("real", "real path");
    for (const std::size_t i : drawnModels(evaluation)) {
        const std::string& name = evaluation.models[i].name;
        entries += i == 0 ? lineEntry(seriesClass(i), name)
                          : lineEntry(cat(seriesClass(i), " thin"),
                                      evaluation.models.size() > 2 ? cat(name, " (best of the others by P)") : name);
    }
    entries += pathMarkEntries(interval);
    return element("div", "legend", entries);
}

std::string manoeuvreLegend() {
    std::string entries;
    for (int kind = 0; kind < manoeuvreCount; ++kind)
        entries += boxEntry(cat("k", std::to_string(kind)), name(static_cast<Manoeuvre>(kind)));
    return element("div", "legend", entries);
}

std::string errorOverTimeFigure(const Evaluation& evaluation, Channel channel) {
    const auto& first = evaluation.models.front().overTime;
    const Points p90 = over(first, channel, &Distribution::p90);
    double top = highest(p90);
    for (const Assessment& model : evaluation.models)
        top = std::max(top, highest(over(model.overTime, channel, &Distribution::median)));
    const bool position = channel == Channel::position;
    SvgPlot plot({}, {0, first.empty() ? 1 : first.back().time}, {0, 1.06 * top},
                 position ? "Position error against time" : "Heading error against time");
    plot.axes("time since the start (s)", position ? "position error (cm)" : "heading error (°)");
    plot.band(fromOrigin(over(first, channel, &Distribution::p10)), fromOrigin(p90), "band");
    plot.band(fromOrigin(over(first, channel, &Distribution::p25)),
              fromOrigin(over(first, channel, &Distribution::p75)), "band inner");
    for (std::size_t i = evaluation.models.size(); i-- > 0;)
        plot.line(fromOrigin(over(evaluation.models[i].overTime, channel, &Distribution::median)), seriesClass(i));
    return plot.text();
}

std::string cumulativeFigure(const Evaluation& evaluation, Channel channel) {
    double right = 0;
    std::vector<std::vector<double>> values;
    for (const Assessment& model : evaluation.models) {
        values.push_back(perWindow(evaluation, model, channel));
        std::vector<double> reordered = values.back();
        right = std::max(right, 1.15 * quantile(reordered, 0.9));
    }
    const bool position = channel == Channel::position;
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
    const auto isHis = [&](const Window& window) { return window.robot == robot; };
    const auto first = std::find_if(evaluation.log.windows.begin(), evaluation.log.windows.end(), isHis);
    const double before = static_cast<double>(first - evaluation.log.windows.begin()) + 0.5;
    SvgPlot plot({.width = 1110, .height = 136, .left = 54, .right = 8, .top = 8, .bottom = 44},
                 {before, before + static_cast<double>(evaluation.log.robots[robot].windows)}, {0, top},
                 cat("Errors of robot ", evaluation.log.robots[robot].name));
    plot.axes("window", "error (cm)");
    for (std::size_t i = 0; i < evaluation.log.windows.size(); ++i) {
        const Window& w = evaluation.log.windows[i];
        if (!isHis(w)) continue;
        const double error = 100 * evaluation.models.front().errors[i].positionMean;
        plot.bar(static_cast<double>(i) + 0.6, 0.8, error, cat("k", std::to_string(static_cast<int>(w.manoeuvre))),
                 cat("window ", std::to_string(i + 1), ", from ", sinceDriveStart(evaluation, i),
                     " s: ", fixed(error, 1), " cm, ", name(w.manoeuvre)));
    }
    return plot.text();
}

std::string pathFigure(const PathFigure& figure) {
    Extent extent{{figure.start.x, figure.start.x}, {figure.start.y, figure.start.y}};
    extent.include(figure.real);
    for (const auto& predicted : figure.predicted) extent.include(predicted);
    extent.widen();
    SvgPlot plot = SvgPlot::equalScale({.width = 340, .height = 290, .left = 0, .right = 0, .top = 0, .bottom = 28},
                                       extent.x, extent.y, "Real and predicted path");
    const double bar = niceTicks({0, 340 * plot.unitsPerPixel()}, 5).step;
    plot.grid(bar);
    for (std::size_t i = figure.predicted.size(); i-- > 1;)
        plot.line(positions(withStart(figure.start, figure.predicted[i])), cat(seriesClass(figure.models[i]), " thin"));
    const auto& predicted = figure.predicted.front();
    const PlotPoint ends[] = {{figure.real.back().x, figure.real.back().y}, {predicted.back().x, predicted.back().y}};
    plot.line(positions(figure.real), "real");
    plot.line(positions(withStart(figure.start, predicted)), seriesClass(0));
    plot.line(ends, "miss");
    drawArrows(plot, figure.arrowEvery, figure.real, "arrow real");
    drawArrows(plot, figure.arrowEvery, withStart(figure.start, predicted), "arrow s0");
    plot.circle({figure.real[0].x, figure.real[0].y}, 4.5, "start");
    if (figure.leaves) plot.circle({predicted[*figure.leaves].x, predicted[*figure.leaves].y}, 5.5, "leaves");
    plot.scaleBar(bar, lengthText(bar));
    return plot.text();
}

std::string pathFigure(const Evaluation& evaluation, std::size_t index) {
    const Window& window = evaluation.log.windows[index];
    PathFigure figure{window.truth, window.measuredPose, {}, drawnModels(evaluation), arrowStride(evaluation)};
    for (const std::size_t i : figure.models) figure.predicted.push_back(evaluation.models[i].predicted[index]);
    return pathFigure(figure);
}

}  // namespace mrose
