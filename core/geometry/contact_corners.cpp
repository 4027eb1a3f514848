#include "geometry/contact_corners.h"

#include <algorithm>
#include <array>
#include <optional>

namespace mrose {
namespace {

using Precision = ContactPrecision;

Polygon welded(const Polygon& polygon) {
    Polygon kept;
    for (const Point& p : polygon)
        if (std::all_of(kept.begin(), kept.end(), [&](const Point& k) { return distance(k, p) > Precision::weld; }))
            kept.push_back(p);
    return kept;
}

/// Of three corners that do not clearly turn left the one between the others.
std::optional<std::size_t> unclear(const Polygon& polygon, const std::array<std::size_t, 3>& three) {
    std::array<Point, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = polygon[three[i]];
    double longest = 0;
    std::size_t between = 0;
    for (std::size_t i = 0; i < 3; ++i)
        if (const double side = distance(p[(i + 1) % 3], p[(i + 2) % 3]); side > longest) {
            longest = side;
            between = i;
        }
    const double height = cross(p[1] - p[0], p[2] - p[0]) / longest;
    if (height > std::max(Precision::height, Precision::heightShare * longest)) return std::nullopt;
    return three[between];
}

std::optional<std::size_t> firstUnclear(const Polygon& polygon) {
    for (std::size_t i = 0; i < polygon.size(); ++i)
        for (std::size_t j = i + 1; j < polygon.size(); ++j)
            for (std::size_t k = j + 1; k < polygon.size(); ++k)
                if (const auto corner = unclear(polygon, {i, j, k})) return corner;
    return std::nullopt;
}

}  // namespace

Polygon contactCorners(const Polygon& convex) {
    Polygon corners = welded(convex);
    while (corners.size() >= 3) {
        const auto corner = firstUnclear(corners);
        if (!corner) break;
        corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(*corner));
    }
    if (corners.size() < 3 || signedArea(corners) < Precision::area) return {};
    return corners;
}

}  // namespace mrose
