#include "report/sweep_figure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "drawing/markup.h"
#include "drawing/svg_plot.h"

namespace mrose {
namespace {

/// Points that follow one another, all of them known.
struct Stretch {
    std::vector<Point> line, low, high;
};

}  // namespace

std::string sweepFigure(std::span<const SweptMean> means, std::string_view xTitle, std::string_view yTitle,
                        PlotRange possible) {
    std::vector<SweptMean> sorted(means.begin(), means.end());
    std::ranges::sort(sorted, {}, &SweptMean::at);
    std::vector<Stretch> stretches(1);
    PlotRange x{0, 0}, y{0, 0};
    bool any = false;
    for (const SweptMean& one : sorted) {
        x = {sorted.front().at, one.at};
        if (!std::isfinite(one.mean.value)) {
            stretches.emplace_back();
            continue;
        }
        const bool interval = std::isfinite(one.mean.low);
        const double low = interval ? one.mean.low : one.mean.value, high = interval ? one.mean.high : one.mean.value;
        y = {any ? std::min(y.low, low) : low, any ? std::max(y.high, high) : high};
        any = true;
        stretches.back().line.push_back({one.at, one.mean.value});
        stretches.back().low.push_back({one.at, low});
        stretches.back().high.push_back({one.at, high});
    }
    y = withRoom(y, 0.06, possible);
    SvgPlot plot({.width = 460, .height = 250, .left = 70, .right = 30}, withRoom(x, 0.03), y,
                 cat(yTitle, " over ", xTitle));
    plot.axes(xTitle, yTitle);
    for (const Stretch& stretch : stretches) {
        plot.band(stretch.low, stretch.high, "band");
        plot.line(stretch.line, "s0");
        for (const Point& point : stretch.line) plot.dot(point, 3.8, "mark");
    }
    for (const SweptMean& one : sorted)
        if (!std::isfinite(one.mean.value)) plot.dot({one.at, y.low}, 3.8, "unreported");
    return plot.text();
}

}  // namespace mrose
