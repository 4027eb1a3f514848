#include "planning/voronoi_roadmap.h"

#include <algorithm>
#include <array>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>

namespace mrose {
namespace {

constexpr double unitsInMetre = 1e4;
constexpr double outlinesApart = 0.001;  // m, that outlines are cut off before others: rounded, they must not cross
constexpr double leastOutline = 0.002;   // m
constexpr double nodesApart = 0.5;       // m, at most, along a straight edge of the diagram
constexpr int curvedParts = 3;           // straight ways that stand in for a curved edge
constexpr std::size_t mostJoined = 6;    // nodes to which start and goal are joined
constexpr std::size_t noNode = std::numeric_limits<std::size_t>::max();

using Diagram = boost::polygon::voronoi_diagram<double>;

struct Outline {
    Point from, to;
    std::size_t piece = 0;
};

std::vector<Point> cornersOf(const ConvexPiece& piece) {
    if (!piece.isCircle()) return {piece.corners.begin(), piece.corners.begin() + static_cast<std::ptrdiff_t>(piece.count)};
    constexpr int sides = 8;
    const double turn = 2 * std::numbers::pi / sides, reach = piece.radius * std::sqrt(turn / sine(turn));
    std::vector<Point> corners;
    for (int i = 0; i < sides; ++i) corners.push_back(piece.centre + reach * towards((i + 0.5) * turn));
    return corners;
}

/// Of the line from a to b the share [first, last] that lies within a piece, a little larger; nullopt: none.
std::optional<std::pair<double, double>> within(const std::vector<Point>& polygon, const Point& a, const Point& b) {
    double first = 0, last = 1;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point side = polygon[(i + 1) % polygon.size()] - polygon[i];
        const Point normal = (1 / length(side)) * Point{side.y, -side.x};
        const double atA = dot(normal, a - polygon[i]) - outlinesApart, atB = dot(normal, b - polygon[i]) - outlinesApart;
        if (atA >= 0 && atB >= 0) return std::nullopt;
        if (atA > 0) first = std::max(first, atA / (atA - atB));
        if (atB > 0) last = std::min(last, atA / (atA - atB));
    }
    if (first >= last) return std::nullopt;
    return std::pair{first, last};
}

/// The sides of all pieces, without what lies in another piece.
std::vector<Outline> outlinesOf(std::span<const ConvexPiece> pieces) {
    std::vector<std::vector<Point>> polygons;
    for (const ConvexPiece& piece : pieces) polygons.push_back(cornersOf(piece));
    std::vector<Outline> outlines;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        std::vector<std::size_t> near;
        for (std::size_t k = 0; k < pieces.size(); ++k)
            if (k != i && distance(pieces[i].centre, pieces[k].centre) <
                              1.1 * (pieces[i].reach + pieces[k].reach) + outlinesApart)
                near.push_back(k);
        for (std::size_t side = 0; side < polygons[i].size(); ++side) {
            const Point a = polygons[i][side], b = polygons[i][(side + 1) % polygons[i].size()];
            std::vector<std::pair<double, double>> left{{0, 1}};
            for (const std::size_t k : near) {
                const auto covered = within(polygons[k], a, b);
                if (!covered) continue;
                std::vector<std::pair<double, double>> rest;
                for (const auto& [first, last] : left) {
                    if (first < covered->first) rest.emplace_back(first, std::min(last, covered->first));
                    if (last > covered->second) rest.emplace_back(std::max(first, covered->second), last);
                }
                left = std::move(rest);
            }
            for (const auto& [first, last] : left)
                if ((last - first) * distance(a, b) > leastOutline)
                    outlines.push_back({a + first * (b - a), a + last * (b - a), i});
        }
    }
    return outlines;
}

std::int32_t inUnits(double metres) { return static_cast<std::int32_t>(nearestWhole(metres * unitsInMetre)); }
Point inMetres(const Diagram::vertex_type& vertex) { return {vertex.x() / unitsInMetre, vertex.y() / unitsInMetre}; }

/// Points on the way of an edge between `from` and `to`, without these: of a parabola some, of a line so many that they
/// are not far apart.
std::vector<Point> pointsBetween(const Diagram::edge_type& edge, const Point& from, const Point& to,
                                 const std::vector<Outline>& outlines) {
    std::vector<Point> points;
    if (edge.is_linear()) {
        const int parts = static_cast<int>(std::ceil(distance(from, to) / nodesApart));
        for (int i = 1; i < parts; ++i) points.push_back(from + (static_cast<double>(i) / parts) * (to - from));
        return points;
    }
    const Diagram::cell_type& one = *edge.cell();
    const Diagram::cell_type& other = *edge.twin()->cell();
    const Diagram::cell_type& pointed = one.contains_point() ? one : other;
    const Outline &of = outlines[pointed.source_index()],
                  &line = outlines[(one.contains_point() ? other : one).source_index()];
    const Point focus =
        pointed.source_category() == boost::polygon::SOURCE_CATEGORY_SEGMENT_START_POINT ? of.from : of.to;
    Placement frame;
    frame.origin = line.from;
    const Point along = (1 / distance(line.from, line.to)) * (line.to - line.from);
    frame.cosine = along.x;
    frame.sine = along.y;
    const Point f = frame.placeBack(focus), a = frame.placeBack(from), b = frame.placeBack(to);
    if (std::abs(f.y) < outlinesApart / 2) return points;
    for (int i = 1; i < curvedParts; ++i) {
        const double x = a.x + (b.x - a.x) * i / curvedParts;
        points.push_back(frame.place({x, ((x - f.x) * (x - f.x) + f.y * f.y) / (2 * f.y)}));
    }
    return points;
}

}  // namespace

VoronoiRoadmap::VoronoiRoadmap(DiscSpace space) : space_(std::move(space)) { makeNodes(); }

std::size_t VoronoiRoadmap::node(const Point& place) {
    const double far = space_.distance(place, farthestDistance);
    if (far < space_.radius()) return noNode;
    nodes_.push_back({place, far, {}});
    return nodes_.size() - 1;
}

void VoronoiRoadmap::join(std::size_t a, std::size_t b) {
    if (a == noNode || b == noNode) return;
    nodes_[a].next.push_back(b);
    nodes_[b].next.push_back(a);
}

void VoronoiRoadmap::makeNodes() {
    const std::vector<Outline> outlines = outlinesOf(space_.pieces());
    boost::polygon::voronoi_builder<std::int32_t> builder;
    for (const Outline& outline : outlines)
        builder.insert_segment(inUnits(outline.from.x), inUnits(outline.from.y), inUnits(outline.to.x),
                               inUnits(outline.to.y));
    Diagram diagram;
    builder.construct(&diagram);
    std::vector<std::size_t> nodeOf;
    nodeOf.reserve(diagram.num_vertices());
    for (const Diagram::vertex_type& vertex : diagram.vertices()) nodeOf.push_back(node(inMetres(vertex)));
    for (const Diagram::edge_type& edge : diagram.edges()) {
        if (edge.is_infinite() || &edge > edge.twin()) continue;
        if (outlines[edge.cell()->source_index()].piece == outlines[edge.twin()->cell()->source_index()].piece) continue;
        const Diagram::vertex_type* const begin = diagram.vertices().data();
        const auto from = static_cast<std::size_t>(edge.vertex0() - begin),
                   to = static_cast<std::size_t>(edge.vertex1() - begin);
        std::size_t last = nodeOf[from];
        for (const Point& point : pointsBetween(edge, inMetres(*edge.vertex0()), inMetres(*edge.vertex1()), outlines)) {
            const std::size_t next = node(point);
            join(last, next);
            last = next;
        }
        join(last, nodeOf[to]);
    }
}

/// The nearest ones to which the straight way is free.
std::vector<std::size_t> VoronoiRoadmap::nearby(const Point& place) const {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < nodes_.size(); ++i)
        if (!nodes_[i].next.empty()) order.emplace_back(distance(place, nodes_[i].place), i);
    std::sort(order.begin(), order.end());
    std::vector<std::size_t> found;
    for (const auto& [far, i] : order) {
        if (found.size() == mostJoined) break;
        if (space_.free(place, nodes_[i].place)) found.push_back(i);
    }
    return found;
}

Path VoronoiRoadmap::path(const Point& start, const Point& goal) const {
    const PathEnds ends = freedEnds(space_, start, goal);
    if (ends.outcome != Path::Outcome::found) return {.outcome = ends.outcome};
    constexpr double far = std::numeric_limits<double>::infinity();
    std::vector<double> length(nodes_.size() + 1, far), last(nodes_.size(), far);  // the goal's number is that behind all
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
        for (const std::size_t next : nodes_[at].next)
            if (const double way = length[at] + distance(nodes_[at].place, nodes_[next].place);
                way < length[next] && space_.free(nodes_[at].place, nodes_[next].place))
                reach(next, at, way);
    }
    if (length[goalNode] == far) return {};
    std::vector<Point> points{goal, ends.goal};
    for (std::size_t at = before[goalNode]; at != noNode; at = before[at]) points.push_back(nodes_[at].place);
    points.push_back(ends.start);
    points.push_back(start);
    std::reverse(points.begin(), points.end());
    return pathThrough(points, space_);
}

Path greatestClearancePath(const DiscSpace& space, const Point& start, const Point& goal) {
    return VoronoiRoadmap(space).path(start, goal);
}

}  // namespace mrose
