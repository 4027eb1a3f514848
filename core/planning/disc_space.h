#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/nearest_point.h"

namespace mrose {

/// Where the centre of a disc may be: among convex pieces that stand still, each grown by the disc's radius (its
/// configuration space; Lozano-Perez 1983).
class DiscSpace {
public:
    /// m: what touches a piece counts as free, also where it was rounded.
    static constexpr double slack = 1e-6;

    DiscSpace(std::vector<ConvexPiece> pieces, double radius) : pieces_(std::move(pieces)), radius_(radius) {}

    /// With further pieces behind its own.
    DiscSpace with(std::span<const ConvexPiece> more) const;

    std::span<const ConvexPiece> pieces() const { return pieces_; }
    double radius() const { return radius_; }

    /// To the nearest piece from a place of the disc's centre, or from all of a straight way of it, m; at most `most`.
    /// Of a place within a piece negative, of a way through one 0.
    double distance(const Point& place, double most) const;
    double distance(const Point& a, const Point& b, double most) const;

    bool free(const Point& place) const { return distance(place, radius_) >= radius_ - slack; }
    bool free(const Point& a, const Point& b) const { return !inTheWay(a, b); }
    /// The piece that a straight way meets first, by where it comes nearest to its centre; nullopt: the way is free.
    std::optional<std::size_t> firstInTheWay(const Point& a, const Point& b) const;

    /// The place itself where it is free; otherwise a free one close by: the nearest, where only one piece is too near.
    /// nullopt: none within four radii.
    std::optional<Point> freed(const Point& place) const;

private:
    bool inTheWay(const Point& a, const Point& b) const;
    bool bars(const ConvexPiece& piece, const Point& a, const Point& b) const;

    std::vector<ConvexPiece> pieces_;
    double radius_;  ///< m
};

}  // namespace mrose
