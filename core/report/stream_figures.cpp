#include "report/stream_figures.h"

#include <algorithm>
#include <cmath>

#include "drawing/svg_plot.h"
#include "io/format.h"

namespace mrose {
namespace {

using Points = std::vector<Point>;
using Shares = RealAndSimulated<BlockShare>;

constexpr double bandErrors = 2;      // standard errors
constexpr double leftOutTail = 0.01;  // of the errors, on each side
constexpr std::size_t mostHistogramBins = 40;
constexpr std::size_t leastInBin = 10;  // subjects: the share of fewer is not drawn

/// Shares of one stream at the middles of the bins, in percent, `errors` standard errors above; not a number where
/// there are too few.
Points sharesAt(const std::vector<ShareBin>& bins, double unit, BlockShare Shares::*which, double errors) {
    Points points;
    for (const ShareBin& bin : bins) {
        const BlockShare& share = bin.reported.*which;
        const double error = std::isnan(share.error) ? 0 : share.error;
        const double high = 100 * std::clamp(share.share + errors * error, 0.0, 1.0);
        points.push_back({unit * (bin.from + bin.to) / 2, share.of < leastInBin ? unknownNumber : high});
    }
    return points;
}

/// A band for each stretch without interruption.
void drawBand(SvgPlot& plot, const Points& low, const Points& high, std::string_view cssClass) {
    for (std::size_t from = 0; from < low.size();) {
        std::size_t to = from;
        while (to < low.size() && isFinite(low[to])) ++to;
        if (to > from)
            plot.band(std::span(low).subspan(from, to - from), std::span(high).subspan(from, to - from), cssClass);
        from = to + 1;
    }
}

void drawShares(SvgPlot& plot, const std::vector<ShareBin>& bins, double unit, BlockShare Shares::*which,
                std::string_view line, std::string_view band) {
    drawBand(plot, sharesAt(bins, unit, which, -bandErrors), sharesAt(bins, unit, which, bandErrors), band);
    plot.line(sharesAt(bins, unit, which, 0), line);
}

std::string reportsFigure(const std::vector<ShareBin>& bins, double unit, std::string_view xTitle,
                          std::string_view description) {
    const PlotRange across = bins.empty() ? PlotRange{} : PlotRange{unit * bins.front().from, unit * bins.back().to};
    SvgPlot plot({}, across, {0, 104}, description);
    plot.axes(xTitle, "reported, of those in view (%)");
    drawShares(plot, bins, unit, &Shares::real, "real", "realband");
    drawShares(plot, bins, unit, &Shares::simulated, "s0", "band");
    return plot.text();
}

std::vector<double> errorsOf(const std::vector<SensedLook>& looks, double SensedSubject::*error, double unit) {
    std::vector<double> errors;
    for (const SensedLook& look : looks)
        for (const SensedSubject& subject : look.subjects)
            if (subject.reported) errors.push_back(unit * (subject.*error));
    std::ranges::sort(errors);
    return errors;
}

double sortedQuantile(const std::vector<double>& sorted, double q) {
    return sorted[static_cast<std::size_t>(q * static_cast<double>(sorted.size() - 1))];
}

/// Intervals of a round width, whole multiples of it, over the middle of both.
struct Intervals {
    double from = -1, width = 2;
    std::size_t count = 1;

    Intervals(const std::vector<double>& real, const std::vector<double>& simulated) {
        double low = 0, high = 0;
        for (const std::vector<double>* errors : {&real, &simulated}) {
            if (errors->empty()) continue;
            low = std::min(low, sortedQuantile(*errors, leftOutTail));
            high = std::max(high, sortedQuantile(*errors, 1 - leftOutTail));
        }
        if (!(high > low)) return;
        width = roundStep((high - low) / static_cast<double>(mostHistogramBins));
        const double first = std::floor(low / width);
        from = first * width;
        count = static_cast<std::size_t>(std::ceil(high / width) - first);
    }
    double end() const { return from + static_cast<double>(count) * width; }
};

/// The outline of a histogram, in percent of all errors.
Points outlineOf(const std::vector<double>& errors, const Intervals& intervals) {
    std::vector<double> counts(intervals.count);
    for (const double error : errors) {
        const double place = std::floor((error - intervals.from) / intervals.width);
        if (place >= 0 && place < static_cast<double>(counts.size())) counts[static_cast<std::size_t>(place)] += 1;
    }
    Points points{{intervals.from, 0}};
    for (std::size_t i = 0; i < counts.size() && !errors.empty(); ++i)
        points.push_back({intervals.from + static_cast<double>(i) * intervals.width,
                          100 * counts[i] / static_cast<double>(errors.size())});
    points.push_back({intervals.end(), 0});
    return points;
}

std::string errorFigure(const ComparedSensor& sensor, double SensedSubject::*error, double unit,
                        std::string_view xTitle, std::string_view description) {
    const std::vector<double> real = errorsOf(sensor.looks.real, error, unit),
                              simulated = errorsOf(sensor.looks.simulated, error, unit);
    const Intervals intervals(real, simulated);
    const Points realOutline = outlineOf(real, intervals), simulatedOutline = outlineOf(simulated, intervals);
    double top = 0;
    for (const Points* outline : {&realOutline, &simulatedOutline})
        for (const Point& point : *outline) top = std::max(top, point.y);
    SvgPlot plot({}, {intervals.from, intervals.end()}, {0, 1.06 * top}, description);
    plot.axes(xTitle, "share of the readings (%)");
    plot.steps(realOutline, "real");
    plot.steps(simulatedOutline, "s0");
    return plot.text();
}

}  // namespace

std::string reportsByRangeFigure(const ComparedSensor& sensor) {
    return reportsFigure(sensor.all.byRange, 1, "range (m)", "Share of subjects reported, by range");
}

std::string reportsByBearingFigure(const ComparedSensor& sensor) {
    return reportsFigure(sensor.all.byBearing, degrees, "bearing (°), left positive",
                         "Share of subjects reported, by bearing");
}

std::string rangeErrorFigure(const ComparedSensor& sensor) {
    return errorFigure(sensor, &SensedSubject::rangeError, 100, "range, reported less true (cm)",
                       "Distribution of range errors");
}

std::string bearingErrorFigure(const ComparedSensor& sensor) {
    return errorFigure(sensor, &SensedSubject::bearingError, 1000, "bearing, reported less true (mrad)",
                       "Distribution of bearing errors");
}

}  // namespace mrose
