#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/point.h"

namespace mrose {

/// Points sorted into the cells of a plain grid, to find those that are near each other, in a box or along a line. The
/// grid lies where most points are; points far from all others count for the cell at its edge, which keeps neighbours
/// neighbours. Memory is kept from filling to filling.
class PointGrid {
public:
    struct Entry {
        Point point;
        std::uint32_t number = 0;  ///< in the list that the grid was filled from
    };

    /// Cells are at least `leastSide` wide, m, and there are at most about `cellsPerPoint` for each point.
    void fill(std::span<const Point> points, double leastSide, double cellsPerPoint);

    /// visit(a, b), a < b, once for each two points of a cell or of neighbouring ones: at least for those that are
    /// nearer than the least side.
    template <class Visit>
    void visitNeighbours(Visit visit) const;

    /// visit(entries) for runs of entries that hold at least all points of the box.
    template <class Visit>
    void visitBox(const Point& least, const Point& most, Visit visit) const;

    /// Calls visit(least, most, entries) for the cell of `from`, and for the neighbours of each cell that it is true
    /// for: the points of the box between two corners. What lies at the edge of those far from all others has no end.
    struct Spreading {
        std::vector<std::uint32_t> cells;
        std::vector<char> reached;
    };
    template <class Visit>
    void spread(const Point& from, Spreading& memory, Visit visit) const;

    /// Whether found(entry) holds for a point, asked for at least all those within `reach` of the line between two
    /// points, which lie among the grid's.
    template <class Found>
    bool anyAlong(const Point& from, const Point& to, double reach, Found found) const;

    /// m, more than what rounding moves a point by.
    double slack() const { return slack_; }

private:
    /// Where most points are, m.
    struct Axis {
        double least = 0, most = 0;
        bool all = true;  ///< none is elsewhere
        std::size_t cells = 1;
        double lastCell = 0;  ///< cells - 1
    };
    struct Extent {
        double least, most;
    };
    Extent extentOf(const Axis& axis, std::size_t cell) const;
    Axis axisOf(std::span<const Point> points, double Point::*coordinate);
    void layOut(std::span<const Point> points, double leastSide, double cellsPerPoint);
    void setCells(Axis& axis);
    std::size_t cellOn(const Axis& axis, double value) const {
        const double cell = std::min(std::max(0.0, (value - axis.least) * perSide_), axis.lastCell);
        return static_cast<std::size_t>(static_cast<std::int64_t>(cell));  // which processors turn doubles into at once
    }
    std::size_t columnOf(double x) const { return cellOn(x_, x); }
    std::size_t rowOf(double y) const { return cellOn(y_, y); }
    std::span<const Entry> entries(std::size_t from, std::size_t to) const {
        return {entries_.data() + from, to - from};
    }
    std::span<const Entry> inRow(std::size_t row, double least, double most) const {
        const std::size_t begin = row * x_.cells;
        return entries(begins_[begin + columnOf(least)], begins_[begin + columnOf(most) + 1]);
    }

    Axis x_, y_;
    double side_ = 1, perSide_ = 1;  ///< m, of a cell; 1/m
    double slack_ = 0;
    std::vector<std::uint32_t> cells_;   ///< by point
    std::vector<std::uint32_t> begins_;  ///< of each cell's entries; one more than there are cells
    std::vector<Entry> entries_;         ///< cell by cell, row by row; in a cell by their numbers
};

template <class Visit>
void PointGrid::visitNeighbours(Visit visit) const {
    const auto columns = static_cast<std::uint32_t>(x_.cells);
    for (std::size_t k = 0; k < entries_.size(); ++k) {
        const std::uint32_t a = entries_[k].number;
        const std::uint32_t cell = cells_[a], column = cell % columns, right = column + 1 < columns ? 1 : 0;
        const auto visitAll = [&](std::size_t from, std::size_t to) {
            for (const Entry& b : entries(from, to)) visit(std::min(a, b.number), std::max(a, b.number));
        };
        // What lies before it has met it already: the rest of its cell and the next one, and three of the next row.
        visitAll(k + 1, begins_[cell + right + 1]);
        if (cell + columns + 1 < begins_.size())
            visitAll(begins_[cell + columns - (column > 0 ? 1 : 0)], begins_[cell + columns + right + 1]);
    }
}

template <class Visit>
void PointGrid::visitBox(const Point& least, const Point& most, Visit visit) const {
    const std::size_t last = rowOf(most.y + slack_);
    for (std::size_t row = rowOf(least.y - slack_); row <= last; ++row)
        visit(inRow(row, least.x - slack_, most.x + slack_));
}

template <class Visit>
void PointGrid::spread(const Point& from, Spreading& memory, Visit visit) const {
    memory.cells.clear();
    memory.reached.assign(x_.cells * y_.cells, 0);
    const auto reach = [&](std::size_t cell) {
        if (std::exchange(memory.reached[cell], 1) == 0) memory.cells.push_back(static_cast<std::uint32_t>(cell));
    };
    reach(rowOf(from.y) * x_.cells + columnOf(from.x));
    for (std::size_t i = 0; i < memory.cells.size(); ++i) {
        const std::size_t cell = memory.cells[i], column = cell % x_.cells, row = cell / x_.cells;
        const Extent x = extentOf(x_, column), y = extentOf(y_, row);
        if (!visit(Point{x.least, y.least}, Point{x.most, y.most}, entries(begins_[cell], begins_[cell + 1]))) continue;
        if (column > 0) reach(cell - 1);
        if (column + 1 < x_.cells) reach(cell + 1);
        if (row > 0) reach(cell - x_.cells);
        if (row + 1 < y_.cells) reach(cell + x_.cells);
    }
}

template <class Found>
bool PointGrid::anyAlong(const Point& from, const Point& to, double reach, Found found) const {
    reach += slack_;
    const Point line = to - from;
    const std::size_t first = rowOf(std::min(from.y, to.y) - reach), last = rowOf(std::max(from.y, to.y) + reach);
    const auto where = [&](double y) { return std::clamp((y - from.y) / line.y, 0.0, 1.0); };
    for (std::size_t i = 0; i <= last - first; ++i) {
        const std::size_t row = line.y < 0 ? last - i : first + i;
        // Between which shares of its length the line is that near to the row. Rows at the edge have no end.
        double enters = 0, leaves = 1;
        if (line.y != 0) {
            const double low = y_.least + static_cast<double>(row) * side_ - reach, high = low + side_ + 2 * reach;
            const double atLow = row == 0 ? (line.y > 0 ? 0 : 1) : where(low);
            const double atHigh = row + 1 == y_.cells ? (line.y > 0 ? 1 : 0) : where(high);
            enters = std::min(atLow, atHigh);
            leaves = std::max(atLow, atHigh);
        }
        const double x0 = from.x + enters * line.x, x1 = from.x + leaves * line.x;
        for (const Entry& entry : inRow(row, std::min(x0, x1) - reach, std::max(x0, x1) + reach))
            if (found(entry)) return true;
    }
    return false;
}

}  // namespace mrose
