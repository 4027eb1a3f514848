#include "report/sweep_figure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "drawing/markup.h"
#include "drawing/svg_plot.h"

namespace mrose {

std::string sweepFigure(std::span<const SweptMean> means, std::string_view xTitle, std::string_view yTitle) {
    std::vector<SweptMean> known;
    for (const SweptMean& one : means)
        if (std::isfinite(one.mean.value)) known.push_back(one);
    std::ranges::sort(known, {}, &SweptMean::at);
    std::vector<Point> line, low, high;
    PlotRange x{0, 0}, y{0, 0};
    for (const SweptMean& one : known) {
        const bool interval = std::isfinite(one.mean.low);
        line.push_back({one.at, one.mean.value});
        low.push_back({one.at, interval ? one.mean.low : one.mean.value});
        high.push_back({one.at, interval ? one.mean.high : one.mean.value});
        const bool first = line.size() == 1;
        x = {first ? one.at : x.low, one.at};
        y = {first ? low.back().y : std::min(y.low, low.back().y),
             first ? high.back().y : std::max(y.high, high.back().y)};
    }
    const double aside = 0.02 * (x.high - x.low), above = 0.06 * std::max(y.high - y.low, 1e-9);
    SvgPlot plot({.width = 440, .height = 250}, {x.low - aside, x.high + aside}, {y.low - above, y.high + above},
                 cat(yTitle, " over ", xTitle));
    plot.axes(xTitle, yTitle);
    plot.band(low, high, "band");
    plot.line(line, "s0");
    for (const Point& point : line) plot.circle(point, 3.5, "sample");
    return plot.text();
}

}  // namespace mrose
