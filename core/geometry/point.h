#pragma once

#include <cmath>

#include "geometry/elementary.h"
#include "geometry/pose.h"

namespace mrose {

/// A position or a vector in the plane, metres unless said.
struct Point {
    double x = 0, y = 0;
    bool operator==(const Point&) const = default;
};

inline Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y}; }
inline Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y}; }
inline Point operator*(double factor, const Point& a) { return {factor * a.x, factor * a.y}; }
inline double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y; }
inline double cross(const Point& a, const Point& b) { return a.x * b.y - a.y * b.x; }
inline double length(const Point& a) { return std::sqrt(dot(a, a)); }
inline bool isFinite(const Point& a) { return std::isfinite(a.x) && std::isfinite(a.y); }
inline double distance(const Point& a, const Point& b) { return length(b - a); }

/// The angle of a vector in (-pi, pi], counter-clockwise from x; 0 for no vector.
inline double direction(const Point& vector) { return arcTangent(vector.y, vector.x); }
/// The vector of length 1 in a direction.
inline Point towards(double direction) {
    const auto [s, c] = sineCosine(direction);
    return {c, s};
}

/// A frame with its heading's cosine and sine at hand, for placing many points.
struct Placement {
    Point origin;
    double cosine = 1, sine = 0;

    Placement() = default;
    explicit Placement(const Pose& pose) : origin{pose.x, pose.y} {
        const SineCosine turned = sineCosine(pose.heading);
        cosine = turned.cosine;
        sine = turned.sine;
    }

    Point rotate(const Point& p) const { return {cosine * p.x - sine * p.y, sine * p.x + cosine * p.y}; }
    Point rotateBack(const Point& p) const { return {cosine * p.x + sine * p.y, cosine * p.y - sine * p.x}; }
    /// A point of the frame as seen from outside, and the inverse.
    Point place(const Point& p) const { return origin + rotate(p); }
    Point placeBack(const Point& p) const { return rotateBack(p - origin); }
};

inline Point position(const Pose& pose) { return {pose.x, pose.y}; }

}  // namespace mrose
