#include "geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mrose {
namespace {

/// Corners nearer than this to the line through their neighbours are none: m.
constexpr double flat = 1e-5;

double turn(const Point& a, const Point& b, const Point& c) { return cross(b - a, c - b); }

bool onSegment(const Point& p, const Point& a, const Point& b) {
    return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
           p.y <= std::max(a.y, b.y);
}

bool segmentsMeet(const Point& a, const Point& b, const Point& c, const Point& d) {
    const double abc = turn(a, b, c), abd = turn(a, b, d), cda = turn(c, d, a), cdb = turn(c, d, b);
    if (((abc > 0 && abd < 0) || (abc < 0 && abd > 0)) && ((cda > 0 && cdb < 0) || (cda < 0 && cdb > 0))) return true;
    return (abc == 0 && onSegment(c, a, b)) || (abd == 0 && onSegment(d, a, b)) || (cda == 0 && onSegment(a, c, d)) ||
           (cdb == 0 && onSegment(b, c, d));
}

/// Without the corners that lie on the line through their neighbours.
Polygon withoutFlatCorners(Polygon polygon) {
    for (std::size_t i = 0; polygon.size() > 3 && i < polygon.size();) {
        const std::size_t n = polygon.size();
        const Point &before = polygon[(i + n - 1) % n], &at = polygon[i], &after = polygon[(i + 1) % n];
        if (distanceToSegment(at, before, after) < flat) {
            polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(i));
            i = i > 0 ? i - 1 : 0;
        } else {
            ++i;
        }
    }
    return polygon;
}

bool insideTriangle(const Point& p, const Point& a, const Point& b, const Point& c) {
    return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

/// An ear: a convex corner whose triangle holds no other corner.
bool isEar(const Polygon& corners, std::size_t i) {
    const std::size_t n = corners.size();
    const Point &a = corners[(i + n - 1) % n], &b = corners[i], &c = corners[(i + 1) % n];
    if (turn(a, b, c) <= 0) return false;
    return std::none_of(corners.begin(), corners.end(), [&](const Point& p) {
        return !(p == a) && !(p == b) && !(p == c) && insideTriangle(p, a, b, c);
    });
}

/// Of all ears the one with the largest smallest height: thin triangles are poor pieces.
std::size_t bestEar(const Polygon& corners) {
    const std::size_t n = corners.size();
    std::size_t best = n;
    double bestHeight = -1;
    for (std::size_t i = 0; i < n; ++i) {
        if (!isEar(corners, i)) continue;
        const Point &a = corners[(i + n - 1) % n], &b = corners[i], &c = corners[(i + 1) % n];
        const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
        const double height = turn(a, b, c) / longest;
        if (height > bestHeight) {
            bestHeight = height;
            best = i;
        }
    }
    return best;
}

std::vector<Polygon> triangles(Polygon corners) {
    std::vector<Polygon> pieces;
    while (corners.size() > 3) {
        const std::size_t i = bestEar(corners), n = corners.size();
        if (i == n) break;  // rounding left no ear: the rest is thinner than any robot's part
        pieces.push_back({corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]});
        corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (corners.size() == 3) pieces.push_back(std::move(corners));
    return pieces;
}

bool isConvex(const Polygon& polygon) {
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i)
        if (turn(polygon[i], polygon[(i + 1) % n], polygon[(i + 2) % n]) < 0) return false;
    return true;
}

/// The union of two pieces along an edge that they share in opposite senses, if it is convex and small enough.
std::optional<Polygon> joined(const Polygon& a, const Polygon& b, std::size_t maxCorners) {
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j) {
            if (!(a[i] == b[(j + 1) % b.size()] && a[(i + 1) % a.size()] == b[j])) continue;
            Polygon sum;
            for (std::size_t k = 0; k < a.size(); ++k) sum.push_back(a[(i + 1 + k) % a.size()]);
            for (std::size_t k = 1; k + 1 < b.size(); ++k) sum.push_back(b[(j + 1 + k) % b.size()]);
            if (!isConvex(sum)) return std::nullopt;
            sum = withoutFlatCorners(std::move(sum));
            if (sum.size() <= maxCorners) return sum;
            return std::nullopt;
        }
    return std::nullopt;
}

bool joinOnce(std::vector<Polygon>& pieces, std::size_t maxCorners) {
    for (std::size_t i = 0; i < pieces.size(); ++i)
        for (std::size_t j = i + 1; j < pieces.size(); ++j)
            if (auto sum = joined(pieces[i], pieces[j], maxCorners)) {
                pieces[i] = std::move(*sum);
                pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(j));
                return true;
            }
    return false;
}

}  // namespace

double signedArea(std::span<const Point> polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    return twice / 2;
}

AreaMoments areaMoments(std::span<const Point> polygon) {
    const Point origin = polygon.front();
    double area = 0, polar = 0;
    Point first;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point a = polygon[i] - origin, b = polygon[(i + 1) % polygon.size()] - origin;
        const double twice = cross(a, b);
        area += twice / 2;
        first = first + (twice / 6) * (a + b);
        polar += twice / 12 * (dot(a, a) + dot(a, b) + dot(b, b));
    }
    const Point centre = (1 / area) * first;
    const double sense = area < 0 ? -1 : 1;
    return {sense * area, origin + centre, sense * (polar - area * dot(centre, centre))};
}

std::optional<std::pair<std::size_t, std::size_t>> selfIntersection(std::span<const Point> polygon) {
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Point &a = polygon[i], &b = polygon[(i + 1) % n], &next = polygon[(i + 2) % n];
        if (turn(a, b, next) == 0 && dot(b - a, next - b) < 0) return std::pair{i, (i + 1) % n};
        for (std::size_t j = i + 2; j < n; ++j)
            if ((j + 1) % n != i && segmentsMeet(a, b, polygon[j], polygon[(j + 1) % n])) return std::pair{i, j};
    }
    return std::nullopt;
}

bool contains(std::span<const Point> polygon, const Point& point) {
    bool inside = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        if (turn(a, b, point) == 0 && onSegment(point, a, b)) return true;
        if ((a.y > point.y) != (b.y > point.y) && point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside;
}

double distanceToSegment(const Point& point, const Point& a, const Point& b) {
    const Point along = b - a;
    const double squared = dot(along, along);
    const double share = squared > 0 ? std::clamp(dot(point - a, along) / squared, 0.0, 1.0) : 0.0;
    return distance(point, a + share * along);
}

std::vector<Polygon> convexPieces(std::span<const Point> polygon, std::size_t maxCorners) {
    Polygon corners(polygon.begin(), polygon.end());
    if (signedArea(corners) < 0) std::reverse(corners.begin(), corners.end());
    corners = withoutFlatCorners(std::move(corners));
    if (isConvex(corners) && corners.size() <= maxCorners) return {corners};
    std::vector<Polygon> pieces = triangles(std::move(corners));
    while (joinOnce(pieces, maxCorners)) {
    }
    return pieces;
}

}  // namespace mrose
