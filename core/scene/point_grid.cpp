#include "scene/point_grid.h"

#include <cmath>

namespace mrose {

PointGrid::Axis PointGrid::axisOf(std::span<const Point> points, double Point::*coordinate) {
    const double share = 1 / static_cast<double>(points.size());
    double mean = 0, variance = 0, least = points[0].*coordinate, most = least;
    for (const Point& point : points) mean += point.*coordinate * share;
    for (const Point& point : points) {
        const double value = point.*coordinate;
        variance += (value - mean) * (value - mean) * share;
        least = std::min(least, value);
        most = std::max(most, value);
    }
    slack_ = std::max({slack_, -1e-12 * least, 1e-12 * most});
    const double spread = 3 * std::sqrt(variance);
    const bool all = mean - spread <= least && most <= mean + spread;
    return {std::max(least, mean - spread), std::min(most, mean + spread), all};
}

void PointGrid::layOut(std::span<const Point> points, double leastSide, double cellsPerPoint) {
    x_ = y_ = {};
    side_ = perSide_ = 1;
    slack_ = 0;
    if (points.empty()) return;
    if (!std::isfinite(leastSide)) {
        x_.all = y_.all = false;  // one cell without end
        return;
    }
    x_ = axisOf(points, &Point::x);
    y_ = axisOf(points, &Point::y);
    const double width = x_.most - x_.least, height = y_.most - y_.least;
    if (!std::isfinite(width * height)) return;  // one cell
    const double mostCells = cellsPerPoint * static_cast<double>(points.size());
    side_ = std::max({leastSide, std::sqrt(width * height / mostCells), width / mostCells, height / mostCells});
    if (!(side_ > 1e-300)) side_ = 1;  // all in one place
    perSide_ = 1 / side_;
    setCells(x_);
    setCells(y_);
}

void PointGrid::setCells(Axis& axis) {
    axis.cells = static_cast<std::size_t>((axis.most - axis.least) * perSide_) + 1;
    axis.lastCell = static_cast<double>(axis.cells - 1);
}

void PointGrid::fill(std::span<const Point> points, double leastSide, double cellsPerPoint) {
    layOut(points, leastSide, cellsPerPoint);
    cells_.resize(points.size());
    begins_.assign(x_.cells * y_.cells + 1, 0);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t cell = rowOf(points[i].y) * x_.cells + columnOf(points[i].x);
        cells_[i] = static_cast<std::uint32_t>(cell);
        ++begins_[cell];
    }
    for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
    entries_.resize(points.size());
    // Filling from the back moves each cell's end to where it begins.
    for (std::size_t i = points.size(); i-- > 0;)
        entries_[--begins_[cells_[i]]] = {points[i], static_cast<std::uint32_t>(i)};
}

}  // namespace mrose
