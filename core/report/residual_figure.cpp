#include "report/residual_figure.h"

#include <algorithm>
#include <cmath>

#include "drawing/svg_plot.h"
#include "report/page.h"

namespace mrose {

std::string residualFigure(std::vector<ResidualDot> dots, std::string_view title, std::string_view xTitle,
                           std::string_view yTitle) {
    if (dots.empty()) return element("p", "soft", "Nothing to show.");
    std::ranges::sort(dots, {}, &ResidualDot::x);
    std::vector<Point> low, high;
    const std::size_t parts = std::min<std::size_t>(12, dots.size());
    double most = 0;
    for (std::size_t part = 0; part < parts; ++part) {
        const std::size_t from = dots.size() * part / parts, to = dots.size() * (part + 1) / parts;
        ResidualDot mean{};
        for (std::size_t i = from; i < to; ++i) {
            const double share = 1 / static_cast<double>(to - from);
            mean.x += share * dots[i].x, mean.low += share * dots[i].low, mean.high += share * dots[i].high;
        }
        low.push_back({mean.x, mean.low});
        high.push_back({mean.x, mean.high});
    }
    for (const ResidualDot& dot : dots) most = std::max({most, std::abs(dot.off), -dot.low, dot.high});
    // Dots at the ends are within the frame.
    const double beside = 0.02 * (dots.back().x - dots.front().x);
    SvgPlot plot({.width = 440, .height = 300}, usable({dots.front().x - beside, dots.back().x + beside}),
                 {-1.05 * most, 1.05 * most}, std::string(title));
    plot.axes(std::string(xTitle), std::string(yTitle));
    for (const ResidualDot& dot : dots) plot.circle({dot.x, dot.off}, 2.4, "realdot");
    plot.line(low, "s0");
    plot.line(high, "s0");
    return plot.text();
}

}  // namespace mrose
