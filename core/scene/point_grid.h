#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
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

    struct Box {
        Point least, most;
    };
    struct Spreading {
        /// Some neighbouring cells.
        struct Block {
            std::uint32_t column, row;
            double nearest;  ///< m, how far it is at least from where the spreading began
        };
        std::vector<Block> blocks;  ///< reached so far, in the order in which they are entered
        std::vector<char> reached;  ///< by block; all 0 between two spreadings
    };
    /// Calls enter(box, nearest) for the block of cells with `from`, and for the neighbours farther out of each block
    /// that it is true for, and then visit(entries) for runs of entries that are all its points: those of a box, which
    /// is at least `nearest` away. What lies at the edge of those far from all others has no end. Now and then
    /// advance(nearest) says that so far away all that follow are.
    template <class Enter, class Visit, class Advance>
    void spread(const Point& from, Spreading& memory, Enter enter, Visit visit, Advance advance) const;

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
    static constexpr std::size_t blockSide = 2;  ///< cells
    static std::size_t blocksOf(const Axis& axis) { return (axis.cells + blockSide - 1) / blockSide; }
    Extent extentOf(const Axis& axis, std::size_t block) const {
        constexpr double farthest = std::numeric_limits<double>::infinity();
        const double side = blockSide * side_, least = axis.least + static_cast<double>(block) * side;
        return {block == 0 && !axis.all ? -farthest : least - slack_,
                block + 1 == blocksOf(axis) && !axis.all ? farthest : least + side + slack_};
    }
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

template <class Enter, class Visit, class Advance>
void PointGrid::spread(const Point& from, Spreading& memory, Enter enter, Visit visit, Advance advance) const {
    std::vector<Spreading::Block>& blocks = memory.blocks;
    const std::size_t columns = blocksOf(x_), rows = blocksOf(y_);
    memory.reached.resize(columns * rows, 0);
    // Blocks nearer than `limit` are entered as they are reached; the others wait behind them.
    double limit = 0;
    std::size_t ready = 0;
    const auto boxOf = [&](std::size_t column, std::size_t row) {
        const Extent x = extentOf(x_, column), y = extentOf(y_, row);
        return Box{{x.least, y.least}, {x.most, y.most}};
    };
    const auto reach = [&](std::size_t column, std::size_t row) {
        if (std::exchange(memory.reached[row * columns + column], 1) != 0) return;
        const Box box = boxOf(column, row);
        const double x = std::max({0.0, box.least.x - from.x, from.x - box.most.x});
        const double y = std::max({0.0, box.least.y - from.y, from.y - box.most.y});
        blocks.push_back({static_cast<std::uint32_t>(column), static_cast<std::uint32_t>(row), length(Point{x, y})});
        if (blocks.back().nearest < limit) std::swap(blocks[ready++], blocks.back());
    };
    const std::size_t column = columnOf(from.x) / blockSide, row = rowOf(from.y) / blockSide;
    reach(column, row);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (i >= ready) {
            const auto waiting = blocks.begin() + static_cast<std::ptrdiff_t>(i);
            const auto nearer = [](const auto& a, const auto& b) { return a.nearest < b.nearest; };
            const double nearest = std::min_element(waiting, blocks.end(), nearer)->nearest;
            advance(nearest);
            limit = nearest + side_;
            const auto later = std::partition(waiting, blocks.end(), [&](const auto& b) { return b.nearest < limit; });
            ready = std::max(i + 1, static_cast<std::size_t>(later - blocks.begin()));
        }
        const auto [c, r, nearest] = blocks[i];
        if (!enter(boxOf(c, r), nearest)) continue;
        const std::size_t left = c * blockSide, right = std::min(left + blockSide, x_.cells);
        for (std::size_t y = r * blockSide; y < std::min((r + 1) * blockSide, y_.cells); ++y)
            visit(entries(begins_[y * x_.cells + left], begins_[y * x_.cells + right]));
        if (c <= column && c > 0) reach(c - 1, r);
        if (c >= column && c + 1 < columns) reach(c + 1, r);
        if (r <= row && r > 0) reach(c, r - 1);
        if (r >= row && r + 1 < rows) reach(c, r + 1);
    }
    for (const Spreading::Block& block : blocks) memory.reached[block.row * columns + block.column] = 0;
    blocks.clear();
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
