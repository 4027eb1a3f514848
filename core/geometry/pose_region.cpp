#include "geometry/pose_region.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "geometry/elementary.h"

namespace mrose {
namespace {

/// m2: samples along a line have a region, too.
constexpr double leastVariance = 1e-12;

/// How many of n samples lie within; a share that is whole but for rounding is.
std::size_t heldOf(std::size_t n, double share) {
    const auto held = static_cast<std::size_t>(std::ceil(share * static_cast<double>(n) - 1e-9));
    return std::clamp<std::size_t>(held, 1, n);
}

PoseRegion::Interval intervalOf(const std::vector<double>& ascending, double share) {
    const std::size_t outside = ascending.size() - heldOf(ascending.size(), share), below = outside / 2;
    return {ascending[below], ascending[ascending.size() - 1 - (outside - below)]};
}

template <class Number>
std::vector<double> ascending(std::span<const Pose> samples, Number number) {
    std::vector<double> numbers;
    numbers.reserve(samples.size());
    for (const Pose& sample : samples) numbers.push_back(number(sample));
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

/// The ellipse's longer axis with its standard deviation, and that of the other.
struct Axes {
    Point along;
    double length = 0, width = 0;
};

Axes axesOf(const PoseRegion& region) {
    const double middle = (region.xx + region.yy) / 2, half = (region.xx - region.yy) / 2;
    const double off = std::sqrt(half * half + region.xy * region.xy);
    const double turned = off > 0 ? arcTangent(region.xy, half) / 2 : 0;
    return {towards(turned), std::sqrt(middle + off), std::sqrt(std::max(leastVariance, middle - off))};
}

/// Corners about an ellipse: as few as look round, and none of it lies outside.
Polygon coverOf(PoseRegion region, RegionShare share) {
    constexpr std::size_t corners = 16;
    region.extents[static_cast<std::size_t>(share)].radius /= cosine(std::numbers::pi / corners);
    return region.outline(share, corners);
}

/// Counter-clockwise (Andrew 1979).
Polygon hullOf(Polygon points) {
    std::sort(points.begin(), points.end(),
              [](const Point& a, const Point& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    Polygon hull;
    const auto add = [&](const Point& point, std::size_t kept) {
        while (hull.size() >= kept + 2 && cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0)
            hull.pop_back();
        hull.push_back(point);
    };
    for (const Point& point : points) add(point, 0);
    const std::size_t lower = hull.size() - 1;
    for (auto point = points.rbegin() + 1; point != points.rend(); ++point) add(*point, lower);
    hull.pop_back();
    return hull;
}

}  // namespace

double PoseRegion::deviations(const Point& place) const {
    const Axes axes = axesOf(*this);
    const Point away = place - centre;
    const double along = dot(axes.along, away) / axes.length, across = cross(axes.along, away) / axes.width;
    return std::sqrt(along * along + across * across);
}

std::pair<double, double> PoseRegion::semiAxes(RegionShare share) const {
    const Axes axes = axesOf(*this);
    return {of(share).radius * axes.length, of(share).radius * axes.width};
}

Polygon PoseRegion::outline(RegionShare share, std::size_t corners) const {
    const Axes axes = axesOf(*this);
    const double radius = of(share).radius;
    Polygon outline;
    for (std::size_t i = 0; i < corners; ++i) {
        const Point on = towards(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners));
        const double along = radius * axes.length * on.x, across = radius * axes.width * on.y;
        outline.push_back({centre.x + axes.along.x * along - axes.along.y * across,
                           centre.y + axes.along.y * along + axes.along.x * across});
    }
    return outline;
}

PoseRegion regionOf(std::span<const Pose> samples, const Pose& around) {
    assert(!samples.empty());
    PoseRegion region;
    const auto n = static_cast<double>(samples.size());
    for (const Pose& sample : samples) region.centre = region.centre + (1 / n) * position(sample);
    region.heading = around.heading;
    for (const Pose& sample : samples) {
        const Point away = position(sample) - region.centre;
        region.xx += away.x * away.x / n;
        region.xy += away.x * away.y / n;
        region.yy += away.y * away.y / n;
    }
    region.xx += leastVariance;
    region.yy += leastVariance;
    const auto turned = [&](const Pose& sample) { return wrapAngle(sample.heading - around.heading); };
    const auto deviations = ascending(samples, [&](const Pose& pose) { return region.deviations(position(pose)); });
    const auto x = ascending(samples, [](const Pose& pose) { return pose.x; });
    const auto y = ascending(samples, [](const Pose& pose) { return pose.y; });
    const auto heading = ascending(samples, [&](const Pose& pose) { return around.heading + turned(pose); });
    const auto error = ascending(samples, [&](const Pose& pose) { return distance(position(pose), position(around)); });
    const auto headingError = ascending(samples, [&](const Pose& pose) { return std::abs(turned(pose)); });
    for (std::size_t i = 0; i < regionShares.size(); ++i) {
        const double share = regionShares[i];
        const std::size_t last = heldOf(samples.size(), share) - 1;
        region.extents[i] = {deviations[last],           intervalOf(x, share), intervalOf(y, share),
                             intervalOf(heading, share), error[last],          headingError[last]};
    }
    return region;
}

std::vector<Polygon> swathOf(std::span<const PoseRegion> regions, RegionShare share, double least) {
    std::vector<Polygon> pieces;
    if (regions.empty()) return pieces;
    Polygon before = coverOf(regions.front(), share);
    if (regions.size() == 1) return {before};
    Point from = regions.front().centre;
    for (const PoseRegion& region : regions.subspan(1)) {
        if (distance(region.centre, from) < least && &region != &regions.back()) continue;
        from = region.centre;
        Polygon outline = coverOf(region, share);
        Polygon both = before;
        both.insert(both.end(), outline.begin(), outline.end());
        pieces.push_back(hullOf(std::move(both)));
        before = std::move(outline);
    }
    return pieces;
}

}  // namespace mrose
