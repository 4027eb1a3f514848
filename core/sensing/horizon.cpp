#include "sensing/horizon.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace mrose {
namespace {

constexpr double slotsOfTurn = 4096;
constexpr double little = 1e-9;

/// Grows with a direction's angle from -2 to 2, straight behind; opposite directions differ by 2.
double turnOf(const Point& direction_B) {
    const double sum = std::abs(direction_B.x) + std::abs(direction_B.y);
    const double ahead = sum > 0 ? direction_B.y / sum : 0;
    if (direction_B.x >= 0) return ahead;
    return (direction_B.y < 0 ? -2 : 2) - ahead;
}

}  // namespace

std::size_t Horizon::slotIn(double slot) const {
    return static_cast<std::size_t>(std::clamp(slot, 0.0, static_cast<double>(ends_.size() - 1)));
}

void Horizon::open(const Placement& eye, const Point& edge_B, bool allRound, double range) {
    eye_ = eye;
    view_ = allRound ? 2 : std::min(2.0, std::abs(turnOf(edge_B)) + little);
    const double slots = std::ceil(std::max(64.0, slotsOfTurn * view_ / 2));
    slotsPerTurn_ = slots / (2 * view_);
    ends_.assign(static_cast<std::size_t>(slots), static_cast<float>(range * (1 + 1e-6)));
}

void Horizon::shade(const Point& centre, double radius, double rounding) {
    const Point offset = eye_.rotateBack(centre - eye_.origin);
    const double away = length(offset), sine = (radius * (1 - 1e-6) - rounding) / away;
    if (!(sine > 0 && sine < 1)) return;
    const double cosine = std::sqrt(1 - sine * sine);
    const double right = turnOf({cosine * offset.x + sine * offset.y, cosine * offset.y - sine * offset.x});
    const double left = turnOf({cosine * offset.x - sine * offset.y, cosine * offset.y + sine * offset.x});
    // Directions that are hidden as a whole; none of those straight behind.
    const double first = std::max(0.0, std::ceil(slotOf(right) + 1e-6));
    const double end = std::min(static_cast<double>(ends_.size()), std::floor(slotOf(left) - 1e-6));
    const auto beyond = static_cast<float>((away + radius) * (1 + 1e-6));
    if (first >= end) return;
    for (float& limit : std::span(ends_).subspan(slotIn(first), static_cast<std::size_t>(end - first)))
        limit = std::min(limit, beyond);
}

bool Horizon::occluded(const Point& point) const {
    const Point offset = point - eye_.origin;
    return ends_[slotIn(slotOf(turnOf(eye_.rotateBack(offset))))] < length(offset) * (1 - little);
}

bool Horizon::occluded(const Point& least, const Point& most) const {
    const Point toLeast = least - eye_.origin, toMost = most - eye_.origin;
    const Point nearest{std::max({0.0, toLeast.x, -toMost.x}), std::max({0.0, toLeast.y, -toMost.y})};
    const double near = length(nearest) * (1 - little);
    if (near == 0 || !std::isfinite(length(toMost - toLeast))) return false;
    double right = 2, left = -2;
    bool inView = false;
    for (const Point& corner : {toLeast, toMost, Point{toLeast.x, toMost.y}, Point{toMost.x, toLeast.y}}) {
        const double turn = turnOf(eye_.rotateBack(corner));
        right = std::min(right, turn);
        left = std::max(left, turn);
        inView = inView || std::abs(turn) <= view_ + little;
    }
    if (left - right >= 2 - little) return left > 1 && right < -1 && !inView;  // straight behind, or at the eye
    if (right > view_ + little || left < -view_ - little) return true;
    const auto begin = ends_.begin();
    return std::all_of(begin + static_cast<std::ptrdiff_t>(slotIn(slotOf(right - little))),
                       begin + static_cast<std::ptrdiff_t>(slotIn(slotOf(left + little))) + 1,
                       [&](float end) { return end < near; });
}

}  // namespace mrose
