#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/polygon.h"
#include "geometry/pose.h"

namespace mrose {

/// How many of all samples a region is to hold.
enum class RegionShare { half, most };
inline constexpr std::array regionShares{0.5, 0.9};

/// Where something may be at an instant, of samples of its pose: of each share the ellipse and the intervals that hold
/// it. A value.
struct PoseRegion {
    struct Interval {
        double low = 0, high = 0;
        bool operator==(const Interval&) const = default;
        bool contains(double number) const { return number >= low && number <= high; }
    };
    /// What holds a share of the samples, each of it by itself.
    struct Extent {
        double radius = 0;        ///< of the ellipse, in standard deviations
        Interval x, y;            ///< m, as many samples below as above
        Interval heading;         ///< rad, not wrapped, about `heading`
        double error = 0;         ///< m: how far from `around`
        double headingError = 0;  ///< rad, without its sign
        bool operator==(const Extent&) const = default;
    };
    Point centre;                   ///< the samples' mean
    double heading = 0;             ///< of `around`
    double xx = 0, xy = 0, yy = 0;  ///< m2: the samples' covariance about it
    std::array<Extent, 2> extents;  ///< of regionShares

    const Extent& of(RegionShare share) const { return extents[static_cast<std::size_t>(share)]; }
    /// How far a place is from the centre, in standard deviations of that direction (Mahalanobis).
    double deviations(const Point& place) const;
    bool contains(const Point& place, RegionShare share) const { return deviations(place) <= of(share).radius; }
    /// m: half the length and half the width of the ellipse.
    std::pair<double, double> semiAxes(RegionShare share) const;
    /// The ellipse as corners, counter-clockwise.
    Polygon outline(RegionShare share, std::size_t corners = 24) const;
    bool operator==(const PoseRegion&) const = default;
};

/// Of at least one sample. `around`: what errors are measured from: one run of them, or their mean. Each ellipse and
/// interval holds ceil(share n) of n samples, to rounding.
PoseRegion regionOf(std::span<const Pose> samples, const Pose& around);

/// What the ellipses pass over from the first region to the last, as convex pieces, counter-clockwise, that overlap: a
/// fill by non-zero winding shows them as one. Regions nearer than `least` (m) to the one before are left out, but for
/// the last.
std::vector<Polygon> swathOf(std::span<const PoseRegion> regions, RegionShare share, double least = 0);

}  // namespace mrose
