#include "planning/visibility_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace mrose {
namespace {

constexpr double withinRange = 1e-9;  // of an arc's end, by which a tangent's point may be beyond it
constexpr double sameDirection = 1e-7;

/// What a shortest way can bend round: a grown corner of a polygon or a grown circle.
struct RoundCorner {
    Point centre;
    double radius = 0;
    Point first, last;  ///< its outward normals, length 1, go counter-clockwise from here to there
    bool full = false;  ///< a circle: all directions
    std::size_t piece = 0;
    std::vector<std::size_t> near;  ///< other pieces whose growth may cut it

    bool has(const Point& normal) const {
        return full || (cross(first, normal) > -withinRange && cross(normal, last) > -withinRange);
    }
    Point at(const Point& normal) const { return centre + radius * normal; }
};

/// A straight way that touches the corner it comes from and the one it leads to. Start and goal are corners, too: of
/// radius 0.
struct Tangent {
    Point fromNormal, toNormal;  ///< of the corners where it touches them
    Point from, to;
};

/// The tangent that leaves a corner passed with it on the left (sense 1) or on the right (-1) for another one.
std::optional<Tangent> tangentBetween(const RoundCorner& a, int senseA, const RoundCorner& b, int senseB) {
    const Point line = b.centre - a.centre;
    const double squared = dot(line, line), closer = senseA * a.radius - senseB * b.radius,
                 rest = squared - closer * closer;
    if (rest <= 0 || squared == 0) return std::nullopt;
    const double root = std::sqrt(rest);
    const Point normal{(closer * line.x + root * line.y) / squared, (closer * line.y - root * line.x) / squared};
    const Point fromNormal = static_cast<double>(senseA) * normal, toNormal = static_cast<double>(senseB) * normal;
    if (!a.has(fromNormal) || !b.has(toNormal)) return std::nullopt;
    return Tangent{fromNormal, toNormal, a.at(fromNormal), b.at(toNormal)};
}

/// How far round a corner it is from one normal to another in a sense, rad; nullopt: beyond its ends.
std::optional<double> angleRound(const RoundCorner& corner, const Point& from, const Point& to, int sense) {
    const double across = sense * cross(from, to), along = dot(from, to);
    const double angle = arcTangent(across, along);
    if (angle > -sameDirection) return std::max(0.0, angle);
    if (!corner.full) return std::nullopt;
    return angle + 2 * std::numbers::pi;
}

class TangentSearch {
public:
    TangentSearch(const DiscSpace& space, const Point& start, const Point& goal) : space_(space) {
        start_.centre = start;
        goal_.centre = goal;
        start_.full = goal_.full = true;
    }

    std::optional<std::vector<PathPart>> parts() {
        if (space_.free(start_.centre, goal_.centre)) return std::vector<PathPart>{{start_.centre, goal_.centre}};
        makeCorners();
        leave(none);
        while (!open_.empty()) {
            std::pop_heap(open_.begin(), open_.end(), later);
            const std::size_t at = open_.back().second;
            open_.pop_back();
            if (nodes_[at].corner == goalNumber) return partsTo(at);
            if (!dominated(at)) leave(at);
        }
        return std::nullopt;
    }

private:
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max(), goalNumber = none - 1;
    /// A way to where a tangent touches a corner.
    struct Node {
        std::size_t corner, before;  ///< the goal's number; the node before, or none: the start
        int sense;
        Point normal, place, left;  ///< where the tangent touches this corner, and where it left the one before
        double length;
        double angleBefore;  ///< rad, round the corner before, in its sense
    };
    static bool later(const std::pair<double, std::size_t>& a, const std::pair<double, std::size_t>& b) {
        return a > b;
    }

    void makeCorners();
    void add(RoundCorner corner);
    bool cut(const RoundCorner& corner, const Point& from, double angle, int sense) const;
    void leave(std::size_t at);
    void reach(std::size_t at, std::size_t corner, int sense);
    bool dominated(std::size_t at);
    std::vector<PathPart> partsTo(std::size_t at) const;
    const RoundCorner& cornerOf(std::size_t number) const { return number == goalNumber ? goal_ : corners_[number]; }

    const DiscSpace& space_;
    RoundCorner start_, goal_;
    std::vector<RoundCorner> corners_;
    std::vector<Node> nodes_;
    std::vector<std::pair<double, std::size_t>> open_;           ///< heap: length and straight rest, node
    std::vector<std::array<std::vector<std::size_t>, 2>> left_;  ///< nodes from which a corner was left, by sense
};

void TangentSearch::makeCorners() {
    const auto pieces = space_.pieces();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const ConvexPiece& piece = pieces[i];
        for (std::size_t k = 0; k < piece.count; ++k)
            add({.centre = piece.corners[k],
                 .radius = piece.radius + space_.radius(),
                 .first = piece.normals[(k + piece.count - 1) % piece.count],
                 .last = piece.normals[k],
                 .full = piece.isCircle(),
                 .piece = i});
    }
    left_.resize(corners_.size());
}

/// Without those that lie within another piece: nothing of their growth is free.
void TangentSearch::add(RoundCorner corner) {
    const auto pieces = space_.pieces();
    const double reach = corner.radius + space_.radius();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (i == corner.piece || distance(corner.centre, pieces[i].centre) >= pieces[i].reach + reach) continue;
        const double far = nearestPoint(pieces[i], corner.centre).distance;
        if (far < -DiscSpace::slack && !corner.full) return;
        if (far < reach) corner.near.push_back(i);
    }
    corners_.push_back(std::move(corner));
}

/// Whether the arc enters the growth of another piece. It is nearest to one at an end, which is free, or where its
/// normal points at a corner, is opposite to an edge's, or, deep within, points at its middle.
bool TangentSearch::cut(const RoundCorner& corner, const Point& from, double angle, int sense) const {
    const auto within = [&](const ConvexPiece& piece, const Point& way) {
        const double far = length(way);
        if (far == 0) return false;
        const Point normal = (1 / far) * way;
        const std::optional<double> at = angleRound(corner, from, normal, sense);
        return at && *at < angle &&
               nearestPoint(piece, corner.at(normal)).distance < space_.radius() - DiscSpace::slack;
    };
    for (const std::size_t i : corner.near) {
        const ConvexPiece& piece = space_.pieces()[i];
        if (within(piece, piece.centre - corner.centre)) return true;
        for (std::size_t k = 0; k < piece.count; ++k)
            if (within(piece, piece.corners[k] - corner.centre) ||
                (!piece.isCircle() && within(piece, -1.0 * piece.normals[k])))
                return true;
    }
    return false;
}

/// A node where a tangent from the corner of node `at` reaches another one, if it is free.
void TangentSearch::reach(std::size_t at, std::size_t corner, int sense) {
    const bool fromStart = at == none;
    const RoundCorner& from = fromStart ? start_ : corners_[nodes_[at].corner];
    const int fromSense = fromStart ? 1 : nodes_[at].sense;
    const std::optional<Tangent> tangent = tangentBetween(from, fromSense, cornerOf(corner), sense);
    if (!tangent) return;
    double length = distance(tangent->from, tangent->to), angle = 0;
    if (!fromStart) {
        const auto round = angleRound(from, nodes_[at].normal, tangent->fromNormal, fromSense);
        if (!round || cut(from, nodes_[at].normal, *round, fromSense)) return;
        angle = *round;
        length += nodes_[at].length + angle * from.radius;
    }
    if (!space_.free(tangent->from, tangent->to)) return;
    nodes_.push_back({corner, at, sense, tangent->toNormal, tangent->to, tangent->from, length, angle});
    open_.emplace_back(length + distance(tangent->to, goal_.centre), nodes_.size() - 1);
    std::push_heap(open_.begin(), open_.end(), later);
}

void TangentSearch::leave(std::size_t at) {
    for (std::size_t corner = 0; corner < corners_.size(); ++corner)
        if (at == none || corner != nodes_[at].corner)
            for (const int sense : {1, -1}) reach(at, corner, sense);
    if (at != none) reach(at, goalNumber, 1);
}

/// Whether the same corner was left, in the same sense, by a way that comes past here and is no longer.
bool TangentSearch::dominated(std::size_t at) {
    const Node& node = nodes_[at];
    const RoundCorner& corner = corners_[node.corner];
    std::vector<std::size_t>& others = left_[node.corner][node.sense > 0 ? 0 : 1];
    for (const std::size_t i : others) {
        const auto round = angleRound(corner, nodes_[i].normal, node.normal, node.sense);
        if (round && nodes_[i].length + *round * corner.radius <= node.length + DiscSpace::slack &&
            !cut(corner, nodes_[i].normal, *round, node.sense))
            return true;
    }
    others.push_back(at);
    return false;
}

std::vector<PathPart> TangentSearch::partsTo(std::size_t at) const {
    std::vector<PathPart> parts;
    for (; at != none; at = nodes_[at].before) {
        const Node& node = nodes_[at];
        parts.push_back({node.left, node.place});
        if (node.before == none) continue;
        const Node& before = nodes_[node.before];
        parts.push_back({before.place, node.left, corners_[before.corner].centre, before.sense * node.angleBefore});
    }
    std::reverse(parts.begin(), parts.end());
    return parts;
}

}  // namespace

Path shortestPath(const DiscSpace& space, const Point& start, const Point& goal) {
    const PathEnds ends = freedEnds(space, start, goal);
    if (ends.outcome != Path::Outcome::found) return {.outcome = ends.outcome};
    auto parts = TangentSearch(space, ends.start, ends.goal).parts();
    if (!parts) return {};
    parts->insert(parts->begin(), {start, ends.start});
    parts->push_back({ends.goal, goal});
    return pathOf(std::move(*parts), space);
}

}  // namespace mrose
