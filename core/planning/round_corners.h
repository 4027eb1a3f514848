#pragma once

#include <span>
#include <vector>

#include "planning/disc_space.h"

namespace mrose {

/// What a shortest way can bend round: a grown corner of a polygon or a grown circle.
struct RoundCorner {
    static constexpr double withinRange = 1e-9;  ///< of an end, by which a normal may be beyond it

    Point centre;
    double radius = 0;
    Point first, last;  ///< its outward normals, length 1, go counter-clockwise from here to there
    bool full = false;  ///< a circle: all directions
    std::size_t piece = 0;
    std::size_t firstNear = 0, countNear = 0;  ///< of RoundCorners::near()

    bool has(const Point& normal) const {
        return full || (cross(first, normal) > -withinRange && cross(normal, last) > -withinRange);
    }
    Point at(const Point& normal) const { return centre + radius * normal; }
};

/// The round corners of a space, without those that lie within another piece: nothing of their growth is free.
class RoundCorners {
public:
    explicit RoundCorners(const DiscSpace& space) { add(space, 0); }
    /// Of a space that begins with the pieces of the one that `fewer` are of.
    RoundCorners(const RoundCorners& fewer, const DiscSpace& space) : RoundCorners(fewer) { add(space, pieces_); }

    std::span<const RoundCorner> all() const { return corners_; }
    /// Other pieces whose growth may cut it.
    std::span<const std::size_t> near(const RoundCorner& corner) const {
        return std::span(near_).subspan(corner.firstNear, corner.countNear);
    }

private:
    void add(const DiscSpace& space, std::size_t from);
    bool noteNear(const DiscSpace& space, std::size_t from, RoundCorner& corner);

    std::vector<RoundCorner> corners_;
    std::vector<std::size_t> near_;  ///< of all corners, each one's side by side
    std::size_t pieces_ = 0;         ///< of which they are
};

}  // namespace mrose
