#include "simulation/touch_search.h"

#include <algorithm>
#include <cmath>

namespace mrose {
namespace {

// Up to here all pairs are tried, which is quicker than a grid.
constexpr std::size_t fewBodies = 24;

/// How far a turning body's points get off their chords.
double sagOf(const SweptBody& body) {
    const double turn = body.planned.heading - body.pose.heading;
    return body.shape->reach * turn * turn / 8;
}

constexpr std::uint32_t notPlaced = 0xffffffff;

}  // namespace

SweptBody SweptBody::of(const Shape& shape, const Pose& pose, const Pose& planned) {
    return {&shape, pose, planned,
            distance(position(pose), position(planned)) + shape.reach * std::abs(planned.heading - pose.heading)};
}

std::span<const ConvexPiece> TouchSearch::placedPieces(const SweptBody& body, std::uint32_t index) {
    if (placedFrom_[index] == notPlaced) {
        placedFrom_[index] = static_cast<std::uint32_t>(placed_.size());
        const Placement frame(body.pose);
        for (const ConvexPiece& piece : body.shape->pieces) placed_.push_back(placed(piece, frame));
        const Placement after(body.planned);
        for (const ConvexPiece& piece : body.shape->pieces) placed_.push_back(placed(piece, after));
    }
    return {placed_.data() + placedFrom_[index], 2 * body.shape->pieces.size()};
}

void TouchSearch::consider(std::span<const SweptBody> bodies, std::uint32_t a, std::uint32_t b) {
    const Reach &own = reaches_[a], &their = reaches_[b];
    const double reach = own.radius + their.radius, dx = their.x - own.x, dy = their.y - own.y;
    if (dx * dx + dy * dy <= reach * reach) considerNear(bodies[a], a, bodies[b], b);
}

void TouchSearch::considerNear(const SweptBody& first, std::uint32_t a, const SweptBody& second, std::uint32_t b) {
    const double limit = first.travel + second.travel + margin;
    placedPieces(first, a);  // placing the second may move the first's pieces in memory
    const std::span<const ConvexPiece> theirs = placedPieces(second, b), own = placedPieces(first, a);
    const std::size_t x1 = own.size() / 2, y1 = theirs.size() / 2;
    bool near = false, meet = false;
    for (std::size_t x = 0; x < x1 && !meet; ++x)
        for (std::size_t y = 0; y < y1 && !meet; ++y) {
            if (!mayBeNearer(own[x], theirs[y], limit)) continue;
            near = true;
            const double sag = sagOf(first) + sagOf(second);
            meet = !stayApart(own[x], theirs[y], own[x1 + x], theirs[y1 + y], margin + sag, pressed + sag);
        }
    if (near) bodyPairs_.push_back({a, b, meet});
}

void TouchSearch::considerObstacle(const SweptBody& body, std::uint32_t index, std::uint32_t piece,
                                   const ConvexPiece& obstacle) {
    const double limit = body.travel + margin;
    const Point centre = position(body.pose);
    // How far the middle is outside the obstacle's edges tells most bodies apart from it.
    double outside = length(obstacle.centre - centre) - obstacle.reach;
    for (std::size_t i = 0; i < obstacle.count && !obstacle.isCircle(); ++i)
        outside = std::max(outside, dot(obstacle.normals[i], centre - obstacle.corners[i]));
    if (outside > body.shape->reach + limit) return;
    const std::span<const ConvexPiece> own = placedPieces(body, index);
    const std::size_t after = own.size() / 2;
    bool near = false, meet = false;
    for (std::size_t x = 0; x < after && !meet; ++x) {
        if (!mayBeNearer(own[x], obstacle, limit)) continue;
        near = true;
        const double sag = sagOf(body);
        meet = !stayApart(own[x], obstacle, own[after + x], obstacle, margin + sag, pressed + sag);
    }
    if (near) obstaclePairs_.push_back({index, piece, meet});
}

void TouchSearch::findNear(std::span<const SweptBody> bodies) {
    const auto count = static_cast<std::uint32_t>(bodies.size());
    for (std::uint32_t a = 0; a < count; ++a)
        for (std::uint32_t b = a + 1; b < count; ++b) consider(bodies, a, b);
}

TouchSearch::Axis TouchSearch::axisOf(double Reach::*coordinate) const {
    const auto count = static_cast<double>(reaches_.size());
    double mean = 0, variance = 0, least = reaches_[0].*coordinate, most = least;
    for (const Reach& reach : reaches_) mean += reach.*coordinate / count;
    for (const Reach& reach : reaches_) {
        const double value = reach.*coordinate;
        variance += (value - mean) * (value - mean) / count;
        least = std::min(least, value);
        most = std::max(most, value);
    }
    const double spread = 3 * std::sqrt(variance);
    return {std::max(least, mean - spread), std::min(most, mean + spread)};
}

/// Cells are so wide that bodies of one touch only those of it and of its neighbours, and so many that each has few
/// bodies. Who is far from all others counts for the cell at the grid's edge, which keeps neighbours neighbours.
void TouchSearch::findNearInGrid(std::span<const SweptBody> bodies) {
    double widest = 0;
    for (const Reach& reach : reaches_) widest = std::max(widest, reach.radius);
    const Axis x = axisOf(&Reach::x), y = axisOf(&Reach::y);
    const double width = x.most - x.least, height = y.most - y.least;
    const double mostCells = 4 * static_cast<double>(bodies.size());
    const double side =
        std::max({2 * widest, std::sqrt(width * height / mostCells), width / mostCells, height / mostCells});
    const auto columns = static_cast<std::size_t>(width / side) + 1, rows = static_cast<std::size_t>(height / side) + 1;
    const auto cellOn = [&](const Axis& axis, double value, std::size_t count) {
        const double cell = (value - axis.least) / side;
        return static_cast<std::size_t>(std::min(std::max(0.0, cell), static_cast<double>(count - 1)));
    };
    cells_.clear();
    begins_.assign(columns * rows + 1, 0);
    for (const Reach& reach : reaches_) {
        const std::size_t cell = cellOn(y, reach.y, rows) * columns + cellOn(x, reach.x, columns);
        cells_.push_back(static_cast<std::uint32_t>(cell));
        ++begins_[cell];
    }
    for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
    order_.resize(bodies.size());
    // Filling from the back moves each cell's end to where it begins.
    for (std::size_t i = bodies.size(); i-- > 0;) order_[--begins_[cells_[i]]] = static_cast<std::uint32_t>(i);
    for (std::size_t k = 0; k < order_.size(); ++k) {
        const std::uint32_t a = order_[k];
        const std::size_t cell = cells_[a], column = cell % columns, right = column + 1 < columns ? 1 : 0;
        const auto tryAll = [&](std::size_t from, std::size_t to) {
            for (std::size_t i = from; i < to; ++i) consider(bodies, std::min(a, order_[i]), std::max(a, order_[i]));
        };
        // What lies before it has met it already: the rest of its cell and the next one, and three of the next row.
        tryAll(k + 1, begins_[cell + right + 1]);
        if (cell + columns + 1 < begins_.size())
            tryAll(begins_[cell + columns - (column > 0 ? 1 : 0)], begins_[cell + columns + right + 1]);
    }
    std::sort(bodyPairs_.begin(), bodyPairs_.end(),
              [](const Pair& p, const Pair& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
}

void TouchSearch::find(std::span<const SweptBody> bodies, const ObstacleIndex& obstacles) {
    bodyPairs_.clear();
    obstaclePairs_.clear();
    placed_.clear();
    placedFrom_.assign(bodies.size(), notPlaced);
    reaches_.clear();
    for (const SweptBody& body : bodies)
        reaches_.push_back({body.pose.x, body.pose.y, body.shape->reach + body.travel + margin / 2});
    if (bodies.size() <= fewBodies)
        findNear(bodies);
    else
        findNearInGrid(bodies);
    for (std::uint32_t i = 0; i < bodies.size(); ++i) {
        const SweptBody& body = bodies[i];
        const auto tryPiece = [&](std::uint32_t piece) { considerObstacle(body, i, piece, obstacles.pieces()[piece]); };
        if (body.shape->reach + body.travel + margin <= obstacles.margin()) {
            for (const std::uint32_t piece : obstacles.near(position(body.pose))) tryPiece(piece);
        } else {
            for (std::uint32_t piece = 0; piece < obstacles.pieces().size(); ++piece) tryPiece(piece);
        }
    }
}

}  // namespace mrose
