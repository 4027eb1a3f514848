#include "planning/via_points.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace mrose {
namespace {

using Way = std::vector<Point>;  ///< without its first point

double lengthFrom(const Point& start, const Way& way) {
    double sum = 0;
    Point last = start;
    for (const Point& point : way) {
        sum += distance(last, point);
        last = point;
    }
    return sum;
}

/// How a piece lies along a straight way.
struct Beside {
    double first = std::numeric_limits<double>::infinity(), last = -first;  ///< m, along it
    double farthest = -first;                                               ///< m, to the side
};

Beside besideOf(const ConvexPiece& piece, const Placement& frame, double side) {
    Beside beside;
    for (std::size_t i = 0; i < piece.count; ++i) {
        const Point corner = frame.placeBack(piece.corners[i]);
        beside.first = std::min(beside.first, corner.x - piece.radius);
        beside.last = std::max(beside.last, corner.x + piece.radius);
        beside.farthest = std::max(beside.farthest, side * corner.y + piece.radius);
    }
    return beside;
}

class ViaPointSearch {
public:
    ViaPointSearch(const DiscSpace& space, const ViaPointOptions& options) : space_(space), options_(options) {}

    std::optional<Way> way(const Point& from, const Point& to, int left) const {
        const std::optional<std::size_t> piece = space_.firstInTheWay(from, to);
        if (!piece) return Way{to};
        if (left == 0) return std::nullopt;
        std::optional<Way> best;
        double least = std::numeric_limits<double>::infinity();
        for (const double side : {1.0, -1.0}) {
            const std::optional<Way> round = waySide(from, to, space_.pieces()[*piece], side, left - 1);
            if (!round) continue;
            if (const double length = lengthFrom(from, *round); length < least) {
                least = length;
                best = round;
            }
        }
        return best;
    }

private:
    std::optional<Way> waySide(const Point& from, const Point& to, const ConvexPiece& piece, double side,
                               int left) const {
        Placement frame;
        frame.origin = from;
        const Point line = (1 / distance(from, to)) * (to - from);
        frame.cosine = line.x;
        frame.sine = line.y;
        const Beside beside = besideOf(piece, frame, side);
        const double off = side * (beside.farthest + space_.radius() + options_.spare);
        const Point middle = frame.place({(beside.first + beside.last) / 2, off});
        const double room = space_.radius() - DiscSpace::slack;
        if (distanceToWay(piece, from, middle) >= room && distanceToWay(piece, middle, to) >= room)
            if (auto one = through(from, {middle}, to, left)) return one;
        // So far before and behind it that the legs do not cut its corners.
        const double beyond = (space_.radius() + options_.spare) / 2;
        return through(from, {frame.place({beside.first - beyond, off}), frame.place({beside.last + beyond, off})}, to,
                       left);
    }

    std::optional<Way> through(const Point& from, const Way& vias, const Point& to, int left) const {
        for (const Point& via : vias)
            if (!space_.free(via)) return std::nullopt;
        Way all;
        Point last = from;
        for (std::size_t i = 0; i <= vias.size(); ++i) {
            const Point& next = i < vias.size() ? vias[i] : to;
            const std::optional<Way> leg = way(last, next, left);
            if (!leg) return std::nullopt;
            all.insert(all.end(), leg->begin(), leg->end());
            last = next;
        }
        return all;
    }

    const DiscSpace& space_;
    const ViaPointOptions& options_;
};

}  // namespace

Path viaPointPath(const DiscSpace& space, const Point& start, const Point& goal, const ViaPointOptions& options) {
    const PathEnds ends = freedEnds(space, start, goal);
    if (ends.outcome != Path::Outcome::found) return {.outcome = ends.outcome};
    const std::optional<Way> way = ViaPointSearch(space, options).way(ends.start, ends.goal, options.most);
    if (!way) return {};
    Way points{start, ends.start};
    points.insert(points.end(), way->begin(), way->end());
    points.push_back(goal);
    return pathThrough(points);
}

}  // namespace mrose
