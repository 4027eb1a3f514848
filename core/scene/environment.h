#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/shape.h"
#include "world/colour_class.h"

namespace mrose {

/// How a surface answers a touch. Between two surfaces friction mixes by the geometric mean, restitution by the larger.
struct Surface {
    double friction = 0.3;
    double restitution = 0.1;
    bool operator==(const Surface&) const = default;
};

/// What stands still: a wall, a post, a cupboard. Its shape lies in the world's frame.
struct Obstacle {
    std::string name;
    Shape shape;
    Surface surface;
    bool wall = false;       ///< was described as one
    std::string landmark{};  ///< the name by which sensors and logs know it; "": it is no landmark
    ColourClass colourClass = ColourClass::obstacle;  ///< as what colour cameras see it
};

/// A line on the floor: a polyline, or a circle; for the eye and for cameras.
struct Marking {
    std::vector<Point> points;
    bool closed = false;
    Point centre;
    double radius = 0;    ///< m, of a circle; 0 for a polyline
    double width = 0.05;  ///< m
    Colour colour{255, 255, 255};
};

/// Where a ball counts.
struct Goal {
    std::string name;
    Polygon area;
};

struct FloorSurface {
    double slidingFriction = 0.3;      ///< coefficient, of balls and boxes
    double traction = 0.6;             ///< coefficient, of driven wheels: how hard robots can push
    double rollingDeceleration = 0.4;  ///< m/s2
    Colour colour{52, 120, 71};
    Polygon area;  ///< drawn; empty: what the obstacles span
};

/// The place in which robots act.
struct Environment {
    std::string name;
    std::vector<Obstacle> obstacles;
    std::vector<Marking> markings;
    std::vector<Goal> goals;
    FloorSurface floor;
};

/// An obstacle that sensors know by its name.
struct Landmark {
    std::string name;
    Point position;              ///< the centre of its circle, the centroid of other shapes
    std::uint32_t obstacle = 0;  ///< in Environment::obstacles
};

/// In the order of the obstacles: sensors report landmarks by their places in this list.
std::vector<Landmark> landmarksOf(const Environment& environment);

}  // namespace mrose
