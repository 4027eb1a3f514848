#include "sensing/beam_fan.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace mrose {
namespace {

constexpr double infinitelyFar = std::numeric_limits<double>::infinity();
constexpr double wholeCircle = 2 * std::numbers::pi;

/// A vector's direction within `roughly` rad: Abramowitz and Stegun (1964), 4.4.47.
constexpr double roughly = 2e-5;
double roughDirection(const Point& vector) {
    const double along = std::abs(vector.x), across = std::abs(vector.y);
    const double t = std::min(along, across) / std::max({along, across, 1e-300}), z = t * t;
    double angle = t * (0.9998660 + z * (-0.3302995 + z * (0.1801410 + z * (-0.0851330 + z * 0.0208351))));
    angle = across > along ? std::numbers::pi / 2 - angle : angle;
    angle = vector.x < 0 ? std::numbers::pi - angle : angle;
    return std::copysign(angle, vector.y);
}

/// What is kept of beams that meet the outlines of one owner after the other: ranges alone ...
struct RangesAlone {
    void begin(std::uint32_t /*owner*/) {}
    bool nearer(std::size_t /*beam*/, double distance, double range) const { return distance < range; }
    void keep(std::size_t /*beam*/, bool /*meets*/) const {}
};

/// ... and owners. Where two outlines lie on one another, rounding does not decide whose is met.
struct WithOwners {
    std::uint32_t* owners;
    std::uint32_t owner = 0;

    void begin(std::uint32_t its) { owner = its; }
    bool nearer(std::size_t beam, double distance, double range) const {
        constexpr double alike = 1e-9;
        return (distance < range * (1 - alike)) | ((distance < range * (1 + alike)) & (owner < owners[beam]));
    }
    void keep(std::size_t beam, bool meets) const { owners[beam] = meets ? owner : owners[beam]; }
};

}  // namespace

BeamFan::BeamFan(double first, double step, std::size_t count, Spacing spacing)
    : first_(first), perStep_(1 / step), step_(step), spacing_(spacing), size_(count), slack_(4 * roughly) {
    x_.resize((count + 1) / 2 * 2);
    y_.resize(x_.size());
    for (std::size_t beam = 0; beam < places(); ++beam) point(beam, first_ + static_cast<double>(beam) * step_);
    rightmost_ = direction(0);
    width_ = count > 0 ? direction(count - 1) - rightmost_ : 0;
}

double BeamFan::directionAt(double place) const {
    const double at = first_ + place * step_;
    return spacing_ == Spacing::angles ? at : arcTangent(at, 1);
}

void BeamFan::point(std::size_t beam, double at) {
    if (spacing_ == Spacing::angles) {
        const auto [s, c] = sineCosine(at);
        x_[beam] = c;
        y_[beam] = s;
    } else {
        x_[beam] = 1 / std::sqrt(1 + at * at);
        y_[beam] = at * x_[beam];
    }
}

void BeamFan::turn(std::size_t beam, double beams) {
    point(beam, first_ + (static_cast<double>(beam) + beams) * step_);
    // An angle is less than its tangent.
    slack_ = std::max(slack_, std::min(wholeCircle / 2, 4 * roughly + std::abs(beams) * step_));
}

double BeamFan::beamsWithin(double angle) const {
    if (spacing_ == Spacing::angles) return angle * perStep_;
    if (angle <= 0) return 0;
    if (angle >= width_) return static_cast<double>(size_) - 1;
    return (tangent(rightmost_ + angle) - first_) * perStep_;
}

template <class Visit>
void BeamFan::visitPairs(double right, double left, Visit visit) const {
    // Whether a beam meets something is for the caller to say.
    double from = right - slack_ - rightmost_;
    from += from < 0 ? wholeCircle : 0;
    const double width = left - right + (left < right ? wholeCircle : 0) + 2 * slack_;
    const auto visitFrom = [&](double begin, double end) {
        const auto first = static_cast<std::int64_t>(beamsWithin(begin) + 1) & ~std::int64_t{1};
        const auto last = std::min(static_cast<std::int64_t>(beamsWithin(end)), static_cast<std::int64_t>(size()) - 1);
        for (std::int64_t beam = first; beam <= last; beam += 2) visit(static_cast<std::size_t>(beam));
    };
    visitFrom(from, from + width);
    // What reaches round to the first beam.
    if (from + width >= wholeCircle) visitFrom(-step_, from + width - wholeCircle);
}

template <class Kept>
void BeamFan::castAt(const Outlines& outlines, const Outlines::Polygon& polygon, double* range, Kept kept) const {
    const double *const dx = x_.data(), *const dy = y_.data();
    const std::span<const Point> corners = outlines.corners().subspan(polygon.first, polygon.end - polygon.first);
    const auto count = static_cast<unsigned>(corners.size());
    if (count == 0) return;
    // The edges that face the origin, each by its right end: one after the other.
    unsigned facing = 0;
    for (unsigned i = 0; i < count; ++i)
        facing |= static_cast<unsigned>(cross(corners[i], corners[i > 0 ? i - 1 : count - 1]) > 0) << i;
    const unsigned before = facing << 1 | facing >> (count - 1), starts = facing & ~before;
    if (starts == 0) return;
    auto i = static_cast<unsigned>(std::countr_zero(starts));
    Point left = corners[i > 0 ? i - 1 : count - 1];
    double leftDirection = roughDirection(left);
    for (int edges = std::popcount(facing); edges > 0; --edges, i = i + 1 < count ? i + 1 : 0) {
        const Point right = corners[i];
        const double rightDirection = roughDirection(right), height = cross(right, left);
        visitPairs(rightDirection, leftDirection, [&](std::size_t pair) {
            for (std::size_t beam = pair; beam < pair + 2; ++beam) {
                // How far inside of each end it passes. Neighbouring edges agree on theirs to the bit.
                const double ofRight = right.x * dy[beam] - right.y * dx[beam];
                const double ofLeft = dx[beam] * left.y - dy[beam] * left.x;
                const double distance = height / (ofRight + ofLeft);
                const bool meets = (ofRight >= 0) & (ofLeft >= 0) & kept.nearer(beam, distance, range[beam]);
                range[beam] = meets ? distance : range[beam];
                kept.keep(beam, meets);
            }
        });
        left = right;
        leftDirection = rightDirection;
    }
}

template <class Kept>
void BeamFan::castAt(const Outlines::Circle& circle, double* range, Kept kept) const {
    const double *const dx = x_.data(), *const dy = y_.data();
    const Point centre = circle.centre;
    const double r = circle.radius, squared = r * r, away = dot(centre, centre) - squared;
    if (!(away > 0)) return;  // inside
    // Where the tangents from the origin touch.
    const double tangent = std::sqrt(away);
    const Point right{tangent * centre.x + r * centre.y, tangent * centre.y - r * centre.x};
    const Point left{tangent * centre.x - r * centre.y, tangent * centre.y + r * centre.x};
    visitPairs(roughDirection(right), roughDirection(left), [&](std::size_t pair) {
        for (std::size_t beam = pair; beam < pair + 2; ++beam) {
            const double along = dx[beam] * centre.x + dy[beam] * centre.y;
            const double aside = dx[beam] * centre.y - dy[beam] * centre.x, depth = squared - aside * aside;
            const double distance = along - std::sqrt(std::max(0.0, depth));
            const bool meets = (depth >= 0) & (along > 0) & kept.nearer(beam, distance, range[beam]);
            range[beam] = meets ? distance : range[beam];
            kept.keep(beam, meets);
        }
    });
}

template <class Kept>
void BeamFan::castAll(const Outlines& outlines, std::span<double> ranges, Kept kept) const {
    assert(ranges.size() == places());
    std::fill(ranges.begin(), ranges.end(), infinitelyFar);
    for (const Outlines::Polygon& polygon : outlines.polygons()) {
        kept.begin(polygon.owner);
        castAt(outlines, polygon, ranges.data(), kept);
    }
    for (const Outlines::Circle& circle : outlines.circles()) {
        kept.begin(circle.owner);
        castAt(circle, ranges.data(), kept);
    }
}

void BeamFan::cast(const Outlines& outlines, std::span<double> ranges) const {
    castAll(outlines, ranges, RangesAlone());
}

void BeamFan::cast(const Outlines& outlines, std::span<double> ranges, std::span<std::uint32_t> owners) const {
    assert(owners.size() == places());
    castAll(outlines, ranges, WithOwners{owners.data()});
}

}  // namespace mrose
