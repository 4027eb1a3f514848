#include "planning/voronoi_roadmap.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include <boost/polygon/voronoi.hpp>

namespace mrose {
namespace {

constexpr double unitsInMetre = 1e4;
constexpr double samplesApart = 0.36;  // m, at most, along an outline ...
constexpr double roomFor = 1.2;        // m, from where to any other piece every second one is enough
constexpr double covered = 0.001;      // m: what is no farther from another piece lies on its outline
constexpr double nodesApart = 0.5;     // m, at most, along an edge of the diagram
constexpr std::size_t mostJoined = 6;  // nodes to which start and goal are joined
constexpr std::size_t noNode = VoronoiRoadmap::none;

using Diagram = boost::polygon::voronoi_diagram<double>;

/// A point of a piece's outline.
struct OutlineSample {
    Point place;
    std::size_t piece = 0;
};

/// A circle's are those of a polygon within it, whose sides need no samples between.
std::vector<Point> cornersOf(const ConvexPiece& piece) {
    std::vector<Point> corners(piece.corners.begin(), piece.corners.begin() + static_cast<std::ptrdiff_t>(piece.count));
    if (!piece.isCircle()) return corners;
    const int sides = std::max(6, static_cast<int>(std::ceil(2 * std::numbers::pi * piece.radius / samplesApart)));
    corners.clear();
    for (int i = 0; i < sides; ++i)
        corners.push_back(piece.centre + piece.radius * towards(2 * std::numbers::pi * (i + 0.3) / sides));
    return corners;
}

/// Whether all other pieces are far from a place of an outline: between points s apart a bisector is off by about
/// s^2 / 8d at the distance d.
bool hasRoom(std::span<const ConvexPiece> pieces, std::size_t own, const Point& place) {
    for (std::size_t k = 0; k < pieces.size(); ++k)
        if (k != own && leastDistance(pieces[k], place) < roomFor) return false;
    return true;
}

/// Points along the sides of all pieces, without those that another piece covers and those of sides that no other piece
/// lies before: no way leads between pieces there.
std::vector<OutlineSample> outlineSamples(std::span<const ConvexPiece> pieces) {
    std::vector<std::vector<Point>> polygons;
    for (const ConvexPiece& piece : pieces) polygons.push_back(cornersOf(piece));
    std::vector<OutlineSample> samples;
    const auto add = [&](const Point& place, std::size_t piece) {
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            if (k == piece || leastDistance(pieces[k], place) >= covered) continue;
            // Of outlines that lie on one another one is left.
            if (nearestPoint(pieces[k], place).distance < (k < piece ? covered : -covered)) return;
        }
        samples.push_back({place, piece});
    };
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const std::vector<Point>& polygon = polygons[i];
        for (std::size_t side = 0; side < polygon.size(); ++side) {
            const Point &a = polygon[side], &b = polygon[(side + 1) % polygon.size()], line = b - a;
            const auto before = [&](const ConvexPiece& piece) {
                return cross(piece.centre - a, line) > -piece.reach * length(line);
            };
            bool faces = false;
            for (std::size_t k = 0; k < pieces.size() && !faces; ++k) {
                if (k == i || !before(pieces[k])) continue;
                for (const Point& corner : polygons[k])
                    faces = faces || cross(corner - a, line) > covered * length(line);
            }
            if (!faces) continue;
            const int parts = static_cast<int>(std::ceil(length(line) / samplesApart));
            const auto at = [&](int part) { return a + (static_cast<double>(part) / parts) * line; };
            bool room = false;  // also of where the next part begins
            for (int part = 0; part < parts;) {
                add(at(part), i);
                room = part + 2 <= parts && (room || hasRoom(pieces, i, at(part))) && hasRoom(pieces, i, at(part + 2));
                part += room ? 2 : 1;
            }
        }
    }
    return samples;
}

std::int32_t inUnits(double metres) { return static_cast<std::int32_t>(nearestWhole(metres * unitsInMetre)); }
Point inMetres(const Diagram::vertex_type& vertex) { return {vertex.x() / unitsInMetre, vertex.y() / unitsInMetre}; }

}  // namespace

VoronoiRoadmap::VoronoiRoadmap(DiscSpace space) : space_(std::move(space)) { makeNodes(); }

/// Of a place that is nearest to one of two pieces; none beyond all outlines.
std::size_t VoronoiRoadmap::node(const Point& place, std::size_t onePiece, std::size_t otherPiece) {
    if (place.x < low_.x || place.y < low_.y || place.x > high_.x || place.y > high_.y) return noNode;
    const auto pieces = space_.pieces();
    const double far = space_.distance(place, std::min(nearestPoint(pieces[onePiece], place).distance,
                                                       nearestPoint(pieces[otherPiece], place).distance));
    if (far < space_.radius()) return noNode;
    nodes_.push_back({place, far});
    return nodes_.size() - 1;
}

void VoronoiRoadmap::join(std::size_t a, std::size_t b) {
    if (a == noNode || b == noNode) return;
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
        ways_.push_back({to, nodes_[from].ways});
        nodes_[from].ways = ways_.size() - 1;
    }
}

void VoronoiRoadmap::makeNodes() {
    const std::vector<OutlineSample> samples = outlineSamples(space_.pieces());
    if (samples.empty()) return;
    low_ = high_ = samples.front().place;
    for (const OutlineSample& sample : samples) {
        low_ = {std::min(low_.x, sample.place.x), std::min(low_.y, sample.place.y)};
        high_ = {std::max(high_.x, sample.place.x), std::max(high_.y, sample.place.y)};
    }
    boost::polygon::voronoi_builder<std::int32_t> builder;
    for (const OutlineSample& sample : samples) builder.insert_point(inUnits(sample.place.x), inUnits(sample.place.y));
    Diagram diagram;
    builder.construct(&diagram);
    nodes_.reserve(2 * diagram.num_vertices());
    ways_.reserve(4 * diagram.num_vertices());
    constexpr std::size_t unmade = noNode - 1;
    std::vector<std::size_t> made(diagram.num_vertices(), unmade);
    const Diagram::vertex_type* const begin = diagram.vertices().data();
    const auto nodeOf = [&](const Diagram::vertex_type* vertex, std::size_t one, std::size_t other) {
        std::size_t& number = made[static_cast<std::size_t>(vertex - begin)];
        if (number == unmade) number = node(inMetres(*vertex), one, other);
        return number;
    };
    for (const Diagram::edge_type& edge : diagram.edges()) {
        if (edge.is_infinite() || &edge > edge.twin()) continue;
        const std::size_t one = samples[edge.cell()->source_index()].piece,
                          other = samples[edge.twin()->cell()->source_index()].piece;
        if (one == other) continue;
        const Point from = inMetres(*edge.vertex0()), to = inMetres(*edge.vertex1());
        std::size_t last = nodeOf(edge.vertex0(), one, other);
        const int parts = static_cast<int>(std::ceil(distance(from, to) / nodesApart));
        for (int i = 1; i < parts; ++i) {
            const std::size_t next = node(from + (static_cast<double>(i) / parts) * (to - from), one, other);
            join(last, next);
            last = next;
        }
        join(last, nodeOf(edge.vertex1(), one, other));
    }
}

/// Whether the straight way between two places is free whose distances from the nearest piece are known.
bool VoronoiRoadmap::joined(const Point& a, double distanceA, const Point& b, double distanceB) const {
    return (distanceA + distanceB - distance(a, b)) / 2 > space_.radius() || space_.free(a, b);
}

/// The nearest ones to which the straight way is free.
std::vector<std::size_t> VoronoiRoadmap::nearby(const Point& place) const {
    std::vector<std::pair<double, std::size_t>> order;  // by the square of the distance
    order.reserve(nodes_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const Point way = nodes_[i].place - place;
        if (nodes_[i].ways != none) order.emplace_back(dot(way, way), i);
    }
    const double room = space_.distance(place, farthestDistance);
    std::vector<std::size_t> found;
    for (std::size_t sorted = 0; sorted < order.size() && found.size() < mostJoined;) {
        const std::size_t end = std::min(order.size(), sorted + 2 * mostJoined);
        std::partial_sort(order.begin() + static_cast<std::ptrdiff_t>(sorted),
                          order.begin() + static_cast<std::ptrdiff_t>(end), order.end());
        for (; sorted < end && found.size() < mostJoined; ++sorted)
            if (const Node& node = nodes_[order[sorted].second]; joined(place, room, node.place, node.distance))
                found.push_back(order[sorted].second);
    }
    return found;
}

Path VoronoiRoadmap::path(const Point& start, const Point& goal) const {
    const PathEnds ends = freedEnds(space_, start, goal);
    if (ends.outcome != Path::Outcome::found) return {.outcome = ends.outcome};
    constexpr double far = std::numeric_limits<double>::infinity();
    std::vector<double> length(nodes_.size() + 1, far),
        last(nodes_.size(), far);  // the goal's number is that behind all
    std::vector<std::size_t> before(nodes_.size() + 1, noNode);
    const std::size_t goalNode = nodes_.size();
    using Open = std::pair<double, std::size_t>;
    std::vector<Open> open;
    const auto reach = [&](std::size_t to, std::size_t from, double way) {
        if (way >= length[to]) return;
        length[to] = way;
        before[to] = from;
        open.emplace_back(way + (to == goalNode ? 0 : distance(nodes_[to].place, ends.goal)), to);
        std::push_heap(open.begin(), open.end(), std::greater<>());
    };
    for (const std::size_t i : nearby(ends.start)) reach(i, noNode, distance(ends.start, nodes_[i].place));
    for (const std::size_t i : nearby(ends.goal)) last[i] = distance(nodes_[i].place, ends.goal);
    if (distance(ends.start, ends.goal) < nodesApart && space_.free(ends.start, ends.goal))
        reach(goalNode, noNode, distance(ends.start, ends.goal));
    std::vector<char> done(nodes_.size() + 1, 0);
    while (!open.empty()) {
        std::pop_heap(open.begin(), open.end(), std::greater<>());
        const std::size_t at = open.back().second;
        open.pop_back();
        if (at == goalNode) break;
        if (done[at] != 0) continue;
        done[at] = 1;
        if (last[at] < far) reach(goalNode, at, length[at] + last[at]);
        const Node& here = nodes_[at];
        for (std::size_t way = here.ways; way != none; way = ways_[way].next) {
            const std::size_t next = ways_[way].to;
            const double there = length[at] + distance(here.place, nodes_[next].place);
            if (there < length[next] && joined(here.place, here.distance, nodes_[next].place, nodes_[next].distance))
                reach(next, at, there);
        }
    }
    if (length[goalNode] == far) return {};
    std::vector<Point> points{goal, ends.goal};
    for (std::size_t at = before[goalNode]; at != noNode; at = before[at]) points.push_back(nodes_[at].place);
    points.push_back(ends.start);
    points.push_back(start);
    std::reverse(points.begin(), points.end());
    return pathThrough(points);
}

}  // namespace mrose
