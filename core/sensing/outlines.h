#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/shape.h"

namespace mrose {

struct SensorView;

/// What of the surroundings a sensor of ranges can meet at the instant SensorView::measured: the exact outlines of
/// obstacles and of all bodies but its own, in one frame. Kept from measurement to measurement for its memory.
class Outlines {
public:
    /// Of outlines, `owner` is whose it is: a body's number, or one of Environment::obstacles beyond all bodies'.

    /// A convex polygon. Its corners are counter-clockwise: seen from outside an edge goes from left to right.
    struct Polygon {
        std::uint32_t first = 0, end = 0;  ///< among corners()
        std::uint32_t owner = 0;
    };
    struct Circle {
        Point centre;
        double radius = 0;
        std::uint32_t owner = 0;
    };

    /// Where one looks: a sector about the frame's x, which begins at its origin.
    struct Sector {
        double range = 0;       ///< m
        double halfAngle = 10;  ///< rad; pi or more: all round
    };

    /// Gathers at least all that lies in the sector of a frame, given in the robot's own.
    void find(const SensorView& view, const Pose& frame_B, const Sector& sector);

    std::span<const Point> corners() const { return corners_; }
    std::span<const Polygon> polygons() const { return polygons_; }
    std::span<const Circle> circles() const { return circles_; }
    /// Where the frame was, in the world's.
    const Placement& frame() const { return frame_; }

private:
    /// Whether a disc is not wholly outside.
    bool inSector(const Point& centre, double reach) const;
    void add(const ConvexPiece& piece, const Placement& placement, std::uint32_t owner);
    void addObstacles(const SensorView& view);
    void addBodies(const SensorView& view);

    Placement frame_;  ///< in the world's
    Sector sector_;
    double halfCosine_ = -1, halfSine_ = 0;
    std::vector<Point> corners_;
    std::vector<Polygon> polygons_;
    std::vector<Circle> circles_;
};

}  // namespace mrose
