#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/shape.h"
#include "scene/environment.h"
#include "scene/point_grid.h"

namespace mrose {

/// All obstacles' convex pieces in one list, and which of them are near a point: a grid whose cells know the pieces
/// within `margin` of them. And the landmarks, in a grid of their own.
class ObstacleIndex {
public:
    ObstacleIndex(const Environment& environment, double margin);

    const std::vector<ConvexPiece>& pieces() const { return pieces_; }
    const Surface& surfaceOf(std::uint32_t piece) const { return surfaces_[piece]; }
    std::uint32_t obstacleOf(std::uint32_t piece) const { return obstacles_[piece]; }
    bool ofWall(std::uint32_t piece) const { return ofWall_[piece] != 0; }

    std::span<const Landmark> landmarks() const { return landmarks_; }
    const PointGrid& landmarkGrid() const { return landmarkGrid_; }  ///< of their positions

    double margin() const { return margin_; }
    /// At least those pieces nearer than `margin` to `point`, ascending.
    std::span<const std::uint32_t> near(const Point& point) const {
        const Point in = inCells(point);
        if (!(in.x >= 0 && in.y >= 0 && in.x < size_.x && in.y < size_.y)) return {};
        // As signed numbers: processors turn doubles into those at once.
        const auto column = static_cast<std::int64_t>(in.x), row = static_cast<std::int64_t>(in.y);
        const std::size_t cell = cellOf(static_cast<std::size_t>(column), static_cast<std::size_t>(row));
        return {entries_.data() + begins_[cell], begins_[cell + 1] - begins_[cell]};
    }
    /// At least those nearer than `reach`, however far that is.
    std::span<const std::uint32_t> near(const Point& point, double reach) const {
        return reach <= margin_ ? near(point) : std::span<const std::uint32_t>(all_);
    }

    /// visit(piece) once for each of at least those that meet the box between two corners.
    template <class Visit>
    void visitBox(const Point& least, const Point& most, Visit visit) const;

private:
    struct Box {
        Point least, most;
    };
    /// Coarse cells for whoever looks far: each lists the pieces whose boxes meet it.
    struct CoarseGrid {
        Point corner;  ///< lower left
        double perCell = 1;
        std::size_t columns = 1, rows = 1;
        std::vector<std::uint32_t> begins, entries;  ///< as those of the fine grid below

        std::size_t columnOf(double x) const { return cellOn(x - corner.x, columns); }
        std::size_t rowOf(double y) const { return cellOn(y - corner.y, rows); }
        std::size_t cellOn(double offset, std::size_t cells) const {
            return static_cast<std::size_t>(std::clamp(offset * perCell, 0.0, static_cast<double>(cells - 1)));
        }
    };
    static Box boxOf(const ConvexPiece& piece);
    void makeCoarseGrid(const Box& all);
    /// A point seen from the grid's corner, in cells.
    Point inCells(const Point& point) const { return perCell_ * (point - corner_); }
    std::size_t cellOf(std::size_t column, std::size_t row) const { return row * columns_ + column; }
    template <class Visit>
    void visitCells(const ConvexPiece& piece, Visit visit) const;

    std::vector<ConvexPiece> pieces_;
    std::vector<Surface> surfaces_;
    std::vector<std::uint32_t> obstacles_;
    std::vector<char> ofWall_;
    std::vector<Box> boxes_;
    CoarseGrid coarse_;
    std::vector<Landmark> landmarks_;
    PointGrid landmarkGrid_;
    std::vector<std::uint32_t> all_;  ///< the pieces' numbers
    double margin_;
    Point corner_;                   ///< of the grid, lower left
    double cell_ = 1, perCell_ = 1;  ///< m, 1/m
    std::size_t columns_ = 0, rows_ = 0;
    Point size_;                         ///< the same as numbers
    std::vector<std::uint32_t> begins_;  ///< of each cell's pieces in `entries_`; one more than there are cells
    std::vector<std::uint32_t> entries_;
};

template <class Visit>
void ObstacleIndex::visitBox(const Point& least, const Point& most, Visit visit) const {
    const auto meets = [&](const Box& box) {
        return box.least.x <= most.x && box.most.x >= least.x && box.least.y <= most.y && box.most.y >= least.y;
    };
    if (coarse_.begins.empty()) {
        for (std::uint32_t piece = 0; piece < pieces_.size(); ++piece)
            if (meets(boxes_[piece])) visit(piece);
        return;
    }
    const std::size_t left = coarse_.columnOf(least.x), right = coarse_.columnOf(most.x);
    const std::size_t low = coarse_.rowOf(least.y), high = coarse_.rowOf(most.y);
    for (std::size_t row = low; row <= high; ++row)
        for (std::size_t column = left; column <= right; ++column) {
            const std::size_t cell = row * coarse_.columns + column;
            for (std::uint32_t i = coarse_.begins[cell]; i < coarse_.begins[cell + 1]; ++i) {
                const std::uint32_t piece = coarse_.entries[i];
                const Box& box = boxes_[piece];
                // A piece of several cells is met in the first of those that the box has as well.
                const bool first = column == std::max(left, coarse_.columnOf(box.least.x)) &&
                                   row == std::max(low, coarse_.rowOf(box.least.y));
                if (first && meets(box)) visit(piece);
            }
        }
}

}  // namespace mrose
