#include "planning/potential_field.h"

#include <algorithm>
#include <limits>

namespace mrose {
namespace {

constexpr int patience = 12;        // steps without getting nearer
constexpr double leastGap = 0.02;   // m, by which forces are computed
constexpr double followGap = 0.03;  // m, to the growth of a piece that is followed
constexpr double thinning = 0.05;   // m, that a thinned path may be off

Point unit(const Point& p) {
    const double far = length(p);
    return far > 0 ? (1 / far) * p : Point{};
}

class FieldDescent {
public:
    FieldDescent(const DiscSpace& space, const Point& start, const Point& goal, const PotentialFieldOptions& options)
        : space_(space), goal_(goal), options_(options), at_(start), points_{start}, nearest_(distance(start, goal)) {}

    bool arrives() {
        for (int i = 0; i < options_.mostSteps; ++i) {
            if (arrived()) return true;
            following_ ? follow() : descend();
            if (stuck_) return false;
        }
        return arrived();
    }
    bool arrived() const { return distance(at_, goal_) <= options_.step && space_.free(at_, goal_); }
    const std::vector<Point>& points() const { return points_; }
    std::size_t minima() const { return minima_; }
    const Point& lastMinimum() const { return minimum_; }

private:
    Point force() {
        Point sum = unit(goal_ - at_);
        room_ = options_.influence;
        for (const ConvexPiece& piece : space_.pieces()) {
            const double reach = space_.radius() + options_.influence;
            if (distance(at_, piece.centre) >= piece.reach + reach) continue;
            const NearestPoint near = nearestPoint(piece, at_);
            if (near.distance >= reach) continue;
            const double gap = std::max(leastGap, near.distance - space_.radius());
            room_ = std::min(room_, near.distance - space_.radius());
            // Near the goal nothing pushes harder than it pulls, or none beside a wall would be reached.
            const double share = std::min(1.0, distance(at_, goal_) / options_.influence);
            sum = sum + (share * options_.repulsion * (1 / gap - 1 / options_.influence) / (gap * gap)) * near.away;
        }
        return sum;
    }

    NearestPoint nearestPiece() {
        room_ = 0;
        NearestPoint nearest;
        nearest.distance = std::numeric_limits<double>::infinity();
        for (const ConvexPiece& piece : space_.pieces())
            if (const NearestPoint near = nearestPoint(piece, at_); near.distance < nearest.distance) nearest = near;
        return nearest;
    }

    /// One step, turned aside as far as it must be to stay free. `side`: to which it is turned first.
    bool stepTowards(const Point& way, double side) {
        const double size = std::min(options_.step, distance(at_, goal_));
        for (int i = 0; i <= 12; ++i)
            for (const double to : {side, -side}) {
                if (i == 0 && to != side) continue;
                const Point next = at_ + size * Placement({0, 0, to * i * 0.2618}).rotate(way);
                if (size >= room_ && !space_.free(at_, next)) continue;
                at_ = next;
                points_.push_back(next);
                return true;
            }
        return false;
    }

    void descend() {
        const bool moved = stepTowards(unit(force()), 1);
        if (const double left = distance(at_, goal_); left < nearest_ - 0.1 * options_.step) {
            nearest_ = left;
            idle_ = 0;
            best_ = points_.size();
        } else {
            ++idle_;
        }
        if (moved && idle_ < patience) return;
        points_.resize(best_);
        at_ = points_.back();
        ++minima_;
        minimum_ = at_;
        followed_ = 0;
        following_ = true;
        side_ = cross(nearestPiece().away, goal_ - at_) >= 0 ? 1 : -1;
        other_ = false;
    }

    /// Along the nearest piece with it on one side, at a small gap.
    void follow() {
        const NearestPoint near = nearestPiece();
        const Point along{-side_ * near.away.y, side_ * near.away.x};
        const double off = std::clamp((space_.radius() + followGap - near.distance) / options_.step, -1.0, 1.0);
        const bool moved = stepTowards(unit(along + off * near.away), side_);
        ++followed_;
        const bool back = followed_ > patience && distance(at_, minimum_) < options_.step;
        if (!moved || back || followed_ > options_.mostSteps / 3) {
            if (other_) {
                stuck_ = true;
                return;
            }
            points_.resize(best_);
            at_ = minimum_;
            side_ = -side_;
            other_ = true;
            followed_ = 0;
            return;
        }
        const NearestPoint now = nearestPiece();
        if (distance(at_, goal_) < distance(minimum_, goal_) - options_.step && dot(goal_ - at_, now.away) > 0) {
            following_ = false;
            nearest_ = distance(at_, goal_);
            idle_ = 0;
            best_ = points_.size();
        }
    }

    const DiscSpace& space_;
    Point goal_;
    const PotentialFieldOptions& options_;
    Point at_;
    std::vector<Point> points_;
    double room_ = 0;       ///< m, at least, until it touches something
    double nearest_;        ///< m, to the goal so far
    std::size_t best_ = 1;  ///< points until there
    int idle_ = 0;          ///< steps since
    std::size_t minima_ = 0;
    Point minimum_;
    bool following_ = false, other_ = false, stuck_ = false;
    double side_ = 1;
    int followed_ = 0;
};

/// Adds of the points behind `from` up to `to` those without which the path would be another one or not free (Douglas,
/// Peucker 1973).
void addThinned(const std::vector<Point>& points, std::size_t from, std::size_t to, const DiscSpace& space,
                std::vector<Point>& kept) {
    std::size_t farthest = from;
    double most = 0;
    for (std::size_t i = from + 1; i < to; ++i)
        if (const double off = distanceToSegment(points[i], points[from], points[to]); off > most) {
            most = off;
            farthest = i;
        }
    if (to == from + 1 || (most <= thinning && space.free(points[from], points[to]))) {
        kept.push_back(points[to]);
        return;
    }
    const std::size_t at = farthest == from ? (from + to) / 2 : farthest;
    addThinned(points, from, at, space, kept);
    addThinned(points, at, to, space, kept);
}

}  // namespace

PotentialFieldPath potentialFieldPath(const DiscSpace& space, const Point& start, const Point& goal,
                                      const PotentialFieldOptions& options) {
    const PathEnds ends = freedEnds(space, start, goal);
    PotentialFieldPath result;
    result.path.outcome = ends.outcome;
    if (!result.path.found()) return result;
    FieldDescent descent(space, ends.start, ends.goal, options);
    result.path.outcome = Path::Outcome::noWay;
    const bool arrives = descent.arrives();
    result.localMinima = descent.minima();
    result.lastMinimum = descent.lastMinimum();
    if (!arrives) return result;
    std::vector<Point> points = descent.points();
    points.push_back(ends.goal);
    std::vector<Point> kept{start, points.front()};
    addThinned(points, 0, points.size() - 1, space, kept);
    kept.push_back(goal);
    result.path = pathThrough(kept);
    return result;
}

}  // namespace mrose
