#include "planning/disc_space.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

namespace mrose {
namespace {

constexpr int pushes = 8;          // away from the nearest piece, before all round is searched
constexpr double freedWithin = 4;  // radii
constexpr int freedBearings = 48, freedRings = 40;

}  // namespace

DiscSpace DiscSpace::with(std::span<const ConvexPiece> more) const {
    std::vector<ConvexPiece> pieces;
    pieces.reserve(pieces_.size() + more.size());
    pieces.insert(pieces.end(), pieces_.begin(), pieces_.end());
    pieces.insert(pieces.end(), more.begin(), more.end());
    return {std::move(pieces), radius_};
}

double DiscSpace::distance(const Point& place, double most) const {
    for (const ConvexPiece& piece : pieces_)
        if (leastDistance(piece, place) < most) most = std::min(most, nearestPoint(piece, place).distance);
    return most;
}

double DiscSpace::distance(const Point& a, const Point& b, double most) const {
    for (const ConvexPiece& piece : pieces_)
        if (distanceToSegment(piece.centre, a, b) < piece.reach + most)
            most = std::min(most, distanceToWay(piece, a, b));
    return most;
}

bool DiscSpace::bars(const ConvexPiece& piece, const Point& a, const Point& b) const {
    // On the far side of one of its edges' lines is the usual case.
    for (std::size_t i = 0; i < piece.count && !piece.isCircle(); ++i)
        if (const Point& corner = piece.corners[i], &out = piece.normals[i];
            std::min(dot(a - corner, out), dot(b - corner, out)) - piece.radius >= radius_)
            return false;
    return distanceToSegment(piece.centre, a, b) < piece.reach + radius_ - slack &&
           distanceToWay(piece, a, b) < radius_ - slack;
}

bool DiscSpace::inTheWay(const Point& a, const Point& b) const {
    return std::any_of(pieces_.begin(), pieces_.end(), [&](const ConvexPiece& piece) { return bars(piece, a, b); });
}

std::optional<std::size_t> DiscSpace::firstInTheWay(const Point& a, const Point& b) const {
    std::optional<std::size_t> first;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        if (!bars(pieces_[i], a, b)) continue;
        const double along = dot(pieces_[i].centre - a, b - a);
        if (along >= least && first) continue;
        least = along;
        first = i;
    }
    return first;
}

std::optional<Point> DiscSpace::freed(const Point& place) const {
    Point at = place;
    for (int i = 0; i < pushes; ++i) {
        NearestPoint worst;
        worst.distance = radius_ - slack;
        bool found = false;
        for (const ConvexPiece& piece : pieces_) {
            if (mrose::distance(at, piece.centre) >= piece.reach + worst.distance) continue;
            const NearestPoint near = nearestPoint(piece, at);
            if (near.distance >= worst.distance) continue;
            worst = near;
            found = true;
        }
        if (!found) return at;
        at = worst.nearest + radius_ * worst.away;
        if (mrose::distance(at, place) > freedWithin * radius_) break;
    }
    for (int ring = 1; ring <= freedRings; ++ring)
        for (int k = 0; k < freedBearings; ++k) {
            const Point way = towards(2 * std::numbers::pi * k / freedBearings);
            at = place + (freedWithin * ring / freedRings * radius_) * way;
            if (free(at)) return at;
        }
    return std::nullopt;
}

}  // namespace mrose
