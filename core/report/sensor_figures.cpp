#include "report/sensor_figures.h"

#include <algorithm>
#include <cmath>

#include "drawing/svg_plot.h"
#include "io/format.h"
#include "report/legend.h"
#include "report/share_plot.h"

namespace mrose {
namespace {

constexpr ShownDimension shownDimensions[readingDimensions] = {{"range", "cm", 100}, {"bearing", "mrad", 1000}};

using BandPart = std::array<double, bandShares.size()> ErrorBand::*;

/// One of bandShares over the middles of the bands.
std::vector<Point> bandLine(const std::vector<ErrorBand>& bands, BandPart part, std::size_t share, double xFactor,
                            double yFactor) {
    std::vector<Point> points;
    for (const ErrorBand& band : bands)
        points.push_back({0.5 * xFactor * (band.from + band.to), yFactor * (band.*part)[share]});
    return points;
}

PlotRange extentOf(const std::vector<ErrorBand>& bands, double factor) {
    PlotRange range{0, 0};
    for (const ErrorBand& band : bands)
        for (const BandPart part : {&ErrorBand::real, &ErrorBand::predicted}) {
            range.low = std::min(range.low, factor * (band.*part).front());
            range.high = std::max(range.high, factor * (band.*part).back());
        }
    const double margin = 0.06 * (range.high - range.low);
    return {range.low - margin, range.high + margin};
}

/// Groups of the same prediction as one.
std::vector<CalibrationGroup> distinct(const std::vector<CalibrationGroup>& groups) {
    std::vector<CalibrationGroup> joined;
    for (const CalibrationGroup& group : groups) {
        if (joined.empty() || group.predicted - joined.back().predicted > 1e-6) {
            joined.push_back(group);
            continue;
        }
        CalibrationGroup& same = joined.back();
        const double before = static_cast<double>(same.cases), more = static_cast<double>(group.cases);
        same.reported = (before * same.reported + more * group.reported) / (before + more);
        same.cases += group.cases;
    }
    return joined;
}

std::vector<Point> coverageLine(const std::vector<std::size_t>& below) {
    double all = 0;
    for (const std::size_t count : below) all += static_cast<double>(count);
    std::vector<Point> points{{0, 0}};
    const std::size_t half = below.size() / 2;
    double inside = 0;
    for (std::size_t k = 1; k <= half; ++k) {
        inside += static_cast<double>(below[half - k] + below[half + k - 1]);
        points.push_back({100 * static_cast<double>(k) / static_cast<double>(half), 100 * inside / all});
    }
    return points;
}

}  // namespace

const ShownDimension& shownDimension(std::size_t dimension) { return shownDimensions[dimension]; }

std::string errorBandFigure(const SensorEvaluation& evaluation, std::size_t dimension, BandAxis axis) {
    const std::vector<ErrorBand>& bands = evaluation.bands[dimension][static_cast<std::size_t>(axis)];
    const ShownDimension& shown = shownDimension(dimension);
    const double xFactor = axis == BandAxis::range ? 1 : degrees;
    if (bands.empty()) return element("p", {{"class", "soft"}}, "Too few readings for bands.");
    SvgPlot plot({}, {xFactor * bands.front().from, xFactor * bands.back().to}, extentOf(bands, shown.factor),
                 cat("Errors of the ", shown.name, " against ", axis == BandAxis::range ? "range" : "bearing"));
    plot.axes(axis == BandAxis::range ? "range (m)" : "bearing (°, left is positive)",
              cat(shown.name, " error (", shown.unit, ")"));
    const auto line = [&](BandPart part, std::size_t share) {
        return bandLine(bands, part, share, xFactor, shown.factor);
    };
    plot.band(line(&ErrorBand::real, 0), line(&ErrorBand::real, 4), "realband");
    plot.band(line(&ErrorBand::real, 1), line(&ErrorBand::real, 3), "realband inner");
    plot.line(line(&ErrorBand::real, 2), "real");
    for (const std::size_t share : {std::size_t{0}, std::size_t{4}})
        plot.line(line(&ErrorBand::predicted, share), "s0 edge outer");
    for (const std::size_t share : {std::size_t{1}, std::size_t{3}})
        plot.line(line(&ErrorBand::predicted, share), "s0 edge");
    plot.line(line(&ErrorBand::predicted, 2), "s0");
    return plot.text();
}

std::string errorBandLegend(const SensorEvaluation& evaluation) {
    const std::string real = evaluation.log.real(), model = evaluation.models.front().name;
    return legend(cat(lineEntry("real", cat(real, ": median")), boxEntry("realband inner", "25–75 %"),
                      boxEntry("realband", "5–95 %"), lineEntry("s0", cat(model, ": median")),
                      lineEntry("s0 edge", "25 and 75 %"), lineEntry("s0 edge outer", "5 and 95 %")));
}

std::string reliabilityFigure(const SensorEvaluation& evaluation) {
    SvgPlot plot = sharePlot("Reported against predicted share", "predicted to be reported (%)", "reported (%)");
    for (std::size_t i = evaluation.models.size(); i-- > 0;) {
        std::vector<Point> points;
        for (const CalibrationGroup& group : distinct(evaluation.models[i].all.groups))
            points.push_back({100 * group.predicted, 100 * group.reported});
        plot.line(points, seriesClass(i));
        if (i == 0)
            for (const Point& point : points) plot.circle(point, 4, "sample");
    }
    return plot.text();
}

std::string coverageFigure(const SensorEvaluation& evaluation, std::size_t dimension) {
    const ShownDimension& shown = shownDimension(dimension);
    SvgPlot plot = sharePlot(cat("Readings inside the central part, ", shown.name),
                             cat("central part of the predicted ", shown.name, " (%)"), "readings inside (%)");
    for (std::size_t i = evaluation.models.size(); i-- > 0;)
        plot.line(coverageLine(belowHistogram(evaluation.log.cases, evaluation.models[i].scores, dimension, 200)),
                  seriesClass(i));
    return plot.text();
}

std::string belowFigure(const SensorEvaluation& evaluation, std::size_t dimension) {
    const std::vector<std::size_t>& below = evaluation.models.front().below[dimension];
    double all = 0, most = 0;
    for (const std::size_t count : below) all += static_cast<double>(count);
    for (const std::size_t count : below) most = std::max(most, 100 * static_cast<double>(count) / all);
    const double width = 100.0 / static_cast<double>(below.size());
    const ShownDimension& shown = shownDimension(dimension);
    SvgPlot plot({.width = 540, .height = 220}, {0, 100}, {0, 1.1 * std::max(most, width)},
                 cat("Where the ", evaluation.log.real(), " ", shown.name, " lies in what is predicted"));
    plot.axes(cat("predicted probability of a smaller ", shown.name, " (%)"), "readings (%)");
    for (std::size_t i = 0; i < below.size(); ++i) {
        const double share = 100 * static_cast<double>(below[i]) / all, from = width * static_cast<double>(i);
        plot.bar(from + 0.08 * width, 0.84 * width, share, "even",
                 cat(fixed(from, 0), " to ", fixed(from + width, 0), " %: ", fixed(share, 1), " % of the readings"));
    }
    const Point even[] = {{0, width}, {100, width}};
    plot.line(even, "floorline");
    return plot.text();
}

std::string sensorLegend(const SensorEvaluation& evaluation) {
    std::string entries;
    for (std::size_t i = 0; i < evaluation.models.size(); ++i)
        entries += lineEntry(seriesClass(i), evaluation.models[i].name);
    return legend(entries);
}

}  // namespace mrose
