#include "planning/visibility_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

namespace mrose {
namespace {

constexpr double sameDirection = 1e-7;

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
    const Point across{line.y, -line.x};
    if (closer == 0) {  // the normal is across it: that a corner has no such one mostly shows without a root
        const double certain = -1e-6 * (std::abs(line.x) + std::abs(line.y));
        const auto lacks = [&](const RoundCorner& corner, int sense) {
            return !corner.full &&
                   (sense * cross(corner.first, across) < certain || sense * cross(across, corner.last) < certain);
        };
        if (lacks(a, senseA) || lacks(b, senseB)) return std::nullopt;
    }
    const double root = std::sqrt(rest);
    const Point normal{(closer * line.x + root * across.x) / squared, (closer * line.y + root * across.y) / squared};
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
    TangentSearch(const DiscSpace& space, const RoundCorners& corners, const Point& start, const Point& goal)
        : space_(space), round_(corners), corners_(corners.all()), passings_(2 * corners_.size()) {
        start_.centre = start;
        goal_.centre = goal;
        start_.full = goal_.full = true;
        nodes_.reserve(many);
        open_.reserve(many);
    }

    std::optional<std::vector<PathPart>> parts() {
        if (space_.free(start_.centre, goal_.centre)) return std::vector<PathPart>{{start_.centre, goal_.centre}};
        leave(none);
        while (!open_.empty()) {
            std::pop_heap(open_.begin(), open_.end(), later);
            const std::size_t at = open_.back().second;
            open_.pop_back();
            if (!free(nodes_[at])) continue;
            if (nodes_[at].by->corner == goalNumber) return partsTo(at);
            if (!dominated(at)) leave(at);
        }
        return std::nullopt;
    }

private:
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max(), goalNumber = none - 1;
    static constexpr std::size_t many = 256;  ///< nodes of most searches
    /// A tangent to another corner.
    struct Exit {
        std::size_t corner;  ///< or the goal's number
        int sense;           ///< in which that is passed
        Tangent tangent;
        double length;
        std::optional<bool> free;  ///< once it was asked
    };
    /// A way to where a tangent touches a corner. Whether its last part is free is seen to when it is its turn: most
    /// never come to it.
    struct Node {
        Exit* by;
        std::size_t before;  ///< the node before, or none: the start
        double length;
        double angleBefore;  ///< rad, round the corner before, in its sense
    };
    /// What leaves a corner, or comes to it, in one sense.
    struct Passing {
        std::vector<Exit> exits;
        bool known = false;             ///< the exits are
        std::vector<std::size_t> left;  ///< nodes from which it was left
    };
    static bool later(const std::pair<double, std::size_t>& a, const std::pair<double, std::size_t>& b) {
        return a > b;
    }

    bool cut(const RoundCorner& corner, const Point& from, double angle, int sense) const;
    Passing& passing(std::size_t corner, int sense) { return passings_[2 * corner + (sense > 0 ? 0 : 1)]; }
    void findExits(const RoundCorner& from, int fromSense, std::size_t number, std::vector<Exit>& exits) const;
    void reach(std::size_t at, Exit& exit);
    bool free(const Node& node);
    void leave(std::size_t at);
    bool dominated(std::size_t at);
    std::vector<PathPart> partsTo(std::size_t at) const;

    const DiscSpace& space_;
    const RoundCorners& round_;
    std::span<const RoundCorner> corners_;  ///< its
    RoundCorner start_, goal_;
    std::vector<Exit> starts_;       ///< exits of the start
    std::vector<Passing> passings_;  ///< by corner and sense
    std::vector<Node> nodes_;
    std::vector<std::pair<double, std::size_t>> open_;  ///< heap: length and straight rest, node
};

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
    for (const std::size_t i : round_.near(corner)) {
        const ConvexPiece& piece = space_.pieces()[i];
        if (within(piece, piece.centre - corner.centre)) return true;
        for (std::size_t k = 0; k < piece.count; ++k)
            if (within(piece, piece.corners[k] - corner.centre) ||
                (!piece.isCircle() && within(piece, -1.0 * piece.normals[k])))
                return true;
    }
    return false;
}

void TangentSearch::findExits(const RoundCorner& from, int fromSense, std::size_t number,
                              std::vector<Exit>& exits) const {
    const auto add = [&](const RoundCorner& corner, std::size_t to, int sense) {
        if (const auto tangent = tangentBetween(from, fromSense, corner, sense))
            exits.push_back({to, sense, *tangent, distance(tangent->from, tangent->to), std::nullopt});
    };
    exits.reserve(corners_.size());
    for (std::size_t to = 0; to < corners_.size(); ++to)
        if (to != number)
            for (const int sense : {1, -1}) add(corners_[to], to, sense);
    if (number != none) add(goal_, goalNumber, 1);
}

/// A node where a tangent from the corner of node `at` reaches another one.
void TangentSearch::reach(std::size_t at, Exit& exit) {
    double length = exit.length, angle = 0;
    if (at != none) {
        const Exit& by = *nodes_[at].by;
        const RoundCorner& from = corners_[by.corner];
        const auto round = angleRound(from, by.tangent.toNormal, exit.tangent.fromNormal, by.sense);
        if (!round) return;
        angle = *round;
        length += nodes_[at].length + angle * from.radius;
    }
    nodes_.push_back({&exit, at, length, angle});
    open_.emplace_back(length + distance(exit.tangent.to, goal_.centre), nodes_.size() - 1);
    std::push_heap(open_.begin(), open_.end(), later);
}

/// Whether nothing cuts the tangent and the arc before it.
bool TangentSearch::free(const Node& node) {
    Exit& by = *node.by;
    if (!by.free) by.free = space_.free(by.tangent.from, by.tangent.to);
    if (!*by.free || node.before == none) return *by.free;
    const Exit& before = *nodes_[node.before].by;
    return !cut(corners_[before.corner], before.tangent.toNormal, node.angleBefore, before.sense);
}

void TangentSearch::leave(std::size_t at) {
    if (at == none) {
        findExits(start_, 1, none, starts_);
        for (Exit& exit : starts_) reach(none, exit);
        return;
    }
    const Exit& by = *nodes_[at].by;
    Passing& here = passing(by.corner, by.sense);
    if (!here.known) findExits(corners_[by.corner], by.sense, by.corner, here.exits);
    here.known = true;
    for (Exit& exit : here.exits)
        if (exit.free.value_or(true)) reach(at, exit);
}

/// Whether the same corner was left, in the same sense, by a way that comes past here and is no longer.
bool TangentSearch::dominated(std::size_t at) {
    const Node& node = nodes_[at];
    const Exit& by = *node.by;
    const RoundCorner& corner = corners_[by.corner];
    std::vector<std::size_t>& others = passing(by.corner, by.sense).left;
    for (const std::size_t i : others) {
        const Point& normal = nodes_[i].by->tangent.toNormal;
        const auto round = angleRound(corner, normal, by.tangent.toNormal, by.sense);
        if (round && nodes_[i].length + *round * corner.radius <= node.length + DiscSpace::slack &&
            !cut(corner, normal, *round, by.sense))
            return true;
    }
    others.push_back(at);
    return false;
}

std::vector<PathPart> TangentSearch::partsTo(std::size_t at) const {
    std::vector<PathPart> parts;
    for (; at != none; at = nodes_[at].before) {
        const Node& node = nodes_[at];
        const Tangent& tangent = node.by->tangent;
        parts.push_back({tangent.from, tangent.to});
        if (node.before == none) continue;
        const Exit& before = *nodes_[node.before].by;
        parts.push_back(
            {before.tangent.to, tangent.from, corners_[before.corner].centre, before.sense * node.angleBefore});
    }
    std::reverse(parts.begin(), parts.end());
    return parts;
}

}  // namespace

Path shortestPath(const DiscSpace& space, const RoundCorners& corners, const Point& start, const Point& goal) {
    const PathEnds ends = freedEnds(space, start, goal);
    if (ends.outcome != Path::Outcome::found) return {.outcome = ends.outcome};
    auto parts = TangentSearch(space, corners, ends.start, ends.goal).parts();
    if (!parts) return {};
    parts->insert(parts->begin(), {start, ends.start});
    parts->push_back({ends.goal, goal});
    return pathOf(std::move(*parts));
}

Path shortestPath(const DiscSpace& space, const Point& start, const Point& goal) {
    return shortestPath(space, RoundCorners(space), start, goal);
}

}  // namespace mrose
