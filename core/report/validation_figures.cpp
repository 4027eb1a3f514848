#include "report/validation_figures.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "drawing/svg_plot.h"
#include "report/legend.h"
#include "report/measure_label.h"

namespace mrose {
namespace {

constexpr const char *simulatedMark = "sample", *realMark = "realmark";

double factorOf(const ValidatedMeasure& measure) { return measure.yesNo ? 100 : 1; }

std::string unitOf(const ValidatedMeasure& measure, bool gain) {
    const std::string unit = measure.yesNo ? (gain ? "points" : "%") : measure.unit;
    return unit.empty() ? "" : " (" + unit + ")";
}

std::string axisOf(const ValidatedMeasure& measure) {
    const bool hasUnit = measure.yesNo || !measure.unit.empty();
    return hasUnit ? measureName(measure.name) + unitOf(measure, false) : measureLabel(measure.name);
}

/// What holds all values, and 0 where it is asked for, with room around them.
PlotRange rangeOf(const std::vector<double>& values, bool withZero) {
    double low = withZero ? 0 : values.front(), high = low;
    for (const double value : values)
        if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
    const double room = 0.06 * std::max(high - low, 1e-9);
    return {low - room, high + room};
}

/// Of the middle 98 of 100, lest a few draw all others together. What is beyond is put on the edge.
PlotRange rangeOfMost(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t beyond = values.size() / 100;
    return rangeOf(
        {values.begin() + static_cast<std::ptrdiff_t>(beyond), values.end() - static_cast<std::ptrdiff_t>(beyond)},
        true);
}

std::vector<double> gainsOf(const MeasureValidation& of, bool real) {
    std::vector<double> gains;
    for (const TrialValues& trial : of.trials) gains.push_back(factorOf(of.measure) * trial.gain(of.measure, real));
    return gains;
}

}  // namespace

std::string cellFigure(const Validation& validation, const MeasureValidation& of) {
    const double factor = factorOf(of.measure);
    std::vector<double> values;
    for (const Estimate& cell : of.cells)
        for (const double value : {cell.value, cell.low, cell.high}) values.push_back(factor * value);
    PlotRange range = rangeOf(values, false);
    range.low -= 0.14 * (range.high - range.low);  // for the names
    SvgPlot plot({}, {0, 5}, range, of.measure.name + " of the four cells");
    plot.uprightAxis(axisOf(of.measure));
    for (const bool real : {true, false}) {
        const std::string line = real ? "line realmiss edge" : "line s0";
        Point ends[2];
        for (const bool after : {false, true}) {
            const Estimate& cell = of.cells[ValidationCell{after, real}.place()];
            const double x = (after ? 3.6 : 1.3) + (real ? 0.12 : -0.12);
            const Point whisker[] = {{x, factor * cell.low}, {x, factor * cell.high}};
            plot.line(whisker, line);
            ends[after ? 1 : 0] = {x, factor * cell.value};
        }
        plot.line(ends, line);
        for (const Point& end : ends) plot.circle(end, 5, real ? realMark : simulatedMark);
    }
    plot.label({1.3, range.low}, 0, -9, validation.before, "title middle");
    plot.label({3.6, range.low}, 0, -9, validation.after, "title middle");
    return plot.text();
}

std::string pairedGainFigure(const Validation& validation, const MeasureValidation& of) {
    const std::vector<double> simulated = gainsOf(of, false), real = gainsOf(of, true);
    std::vector<double> all = simulated;
    all.insert(all.end(), real.begin(), real.end());
    const PlotRange range = rangeOfMost(all);
    SvgPlot plot({}, range, range, "Gain in the simulator and in the reality, by trial");
    plot.axes("gain in " + validation.simulation + unitOf(of.measure, true),
              "gain in " + validation.reality + unitOf(of.measure, true));
    const Point same[] = {{range.low, range.low}, {range.high, range.high}};
    const Point none[] = {{range.low, 0}, {range.high, 0}}, noneAcross[] = {{0, range.low}, {0, range.high}};
    plot.line(same, "floorline");
    plot.line(none, "miss");
    plot.line(noneAcross, "miss");
    const auto within = [&](double gain) { return std::clamp(gain, range.low, range.high); };
    for (std::size_t i = 0; i < real.size(); ++i) {
        const Point at{within(simulated[i]), within(real[i])};
        plot.circle(at, 2.5, at == Point{simulated[i], real[i]} ? "sample" : "realmark");
    }
    return plot.text();
}

std::string gainDistributionFigure(const Validation& validation, const MeasureValidation& of) {
    std::vector<double> sorted[2] = {gainsOf(of, false), gainsOf(of, true)};
    std::vector<double> all = sorted[0];
    all.insert(all.end(), sorted[1].begin(), sorted[1].end());
    const PlotRange range = rangeOfMost(all);
    SvgPlot plot({}, range, {0, 100}, "Cumulative distribution of gains");
    plot.axes("gain of " + validation.after + unitOf(of.measure, true), "trials up to it (%)");
    const Point none[] = {{0, 0}, {0, 100}};
    plot.line(none, "miss");
    for (const std::size_t real : {1u, 0u}) {
        std::ranges::sort(sorted[real]);
        std::vector<Point> points{{range.low, 0}};
        for (std::size_t i = 0; i < sorted[real].size(); ++i)
            points.push_back(
                {sorted[real][i], 100 * static_cast<double>(i + 1) / static_cast<double>(sorted[real].size())});
        points.push_back({range.high, 100});
        plot.steps(points, real == 1 ? "line realmiss edge" : "line s0");
    }
    return plot.text();
}

std::string placeLegend(const Validation& validation) {
    return legend(dotEntry(simulatedMark, validation.simulation) + dotEntry(realMark, validation.reality));
}

}  // namespace mrose
