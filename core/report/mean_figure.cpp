#include "report/mean_figure.h"

#include <algorithm>
#include <cmath>

#include "drawing/svg_plot.h"

namespace mrose {
namespace {

constexpr double rowHeight = 26, letterWidth = 7.2, plotWidth = 420;  // px

}  // namespace

std::string meanFigure(std::span<const NamedMean> means, std::string_view title, PlotRange possible) {
    double low = 0, high = 0;
    std::size_t longest = 0;
    bool any = false;
    for (const NamedMean& row : means) {
        longest = std::max(longest, row.name.size());
        for (const double value : {row.mean.value, row.mean.low, row.mean.high}) {
            if (!std::isfinite(value)) continue;
            low = any ? std::min(low, value) : value;
            high = any ? std::max(high, value) : value;
            any = true;
        }
    }
    const double rows = static_cast<double>(means.size()), left = 24 + letterWidth * static_cast<double>(longest);
    const SvgPlot::Layout layout{.width = left + plotWidth + 16, .height = rowHeight * rows + 58, .left = left};
    SvgPlot plot(layout, withRoom({low, high}, 0.08, possible), {0, rows}, title);
    plot.levelAxis(title);
    for (std::size_t i = 0; i < means.size(); ++i) {
        const Estimate& mean = means[i].mean;
        const double y = rows - 0.5 - static_cast<double>(i);
        plot.rowName(y, means[i].name);
        const Point whisker[] = {{mean.low, y}, {mean.high, y}};
        plot.line(whisker, "s0");
        plot.dot({mean.value, y}, 4.5, means[i].cssClass);
    }
    return plot.text();
}

}  // namespace mrose
