#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/shape.h"
#include "scene/environment.h"

namespace mrose {

/// All obstacles' convex pieces in one list, and which of them are near a point: a grid whose cells know the pieces
/// within `margin` of them.
class ObstacleIndex {
public:
    ObstacleIndex(const Environment& environment, double margin);

    const std::vector<ConvexPiece>& pieces() const { return pieces_; }
    const Surface& surfaceOf(std::uint32_t piece) const { return surfaces_[piece]; }
    std::uint32_t obstacleOf(std::uint32_t piece) const { return obstacles_[piece]; }

    double margin() const { return margin_; }
    /// At least those pieces nearer than `margin` to `point`, ascending.
    std::span<const std::uint32_t> near(const Point& point) const;

private:
    struct Box {
        Point least, most;
    };
    static Box boxOf(const ConvexPiece& piece);
    std::size_t cellOf(std::size_t column, std::size_t row) const { return row * columns_ + column; }
    template <class Visit>
    void visitCells(const ConvexPiece& piece, Visit visit) const;

    std::vector<ConvexPiece> pieces_;
    std::vector<Surface> surfaces_;
    std::vector<std::uint32_t> obstacles_;
    double margin_;
    Point corner_;     ///< of the grid, lower left
    double cell_ = 1;  ///< m
    std::size_t columns_ = 0, rows_ = 0;
    std::vector<std::uint32_t> begins_;  ///< of each cell's pieces in `entries_`; one more than there are cells
    std::vector<std::uint32_t> entries_;
};

}  // namespace mrose
