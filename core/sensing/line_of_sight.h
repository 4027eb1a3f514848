#pragma once

#include <cmath>
#include <cstddef>

#include "geometry/shape.h"
#include "sensing/sensor_view.h"

namespace mrose {

/// Whether the straight line between two points passes through the inside of a piece, all in one frame.
bool crosses(const ConvexPiece& piece, const Point& from, const Point& to);

/// The line from a robot's reference point to a body's, when `map` was.
class SightLine {
public:
    /// `widest`: Scene::widestReach().
    SightLine(const SensorView& view, const BodyMap& map, std::size_t body, double widest)
        : view_(view),
          map_(map),
          body_(body),
          widest_(widest),
          eye_(map.positions[view.robot]),
          target_(map.positions[body]),
          line_(target_ - eye_),
          squaredLength_(dot(line_, line_)),
          length_(std::sqrt(squaredLength_)) {}

    /// Whether it passes through the inside of another body.
    bool hits(std::size_t other) const;
    /// Of any other.
    bool hitsBody() const;
    /// Of an obstacle.
    bool hitsObstacle() const;

private:
    bool passesNear(const Point& offset, double reach) const {
        const double across = cross(offset, line_);
        return across * across <= reach * reach * squaredLength_;
    }

    const SensorView& view_;
    const BodyMap& map_;
    std::size_t body_;
    double widest_;
    Point eye_, target_, line_;
    double squaredLength_, length_;
};

}  // namespace mrose
