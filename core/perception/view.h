#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mrose {

/// How far and wide a sensor sees, around its robot's heading. Its edges are blurred: within margin() it may yet report
/// something, beyond that nothing.
struct View {
    double range = 9, fieldOfView = 1.2;  ///< m, rad
    double nearest = 0;                   ///< m: nearer than that it reports hardly anything
    bool operator==(const View&) const = default;

    bool holds(double distance, double bearing) const {
        return distance <= range && std::abs(bearing) <= 0.5 * fieldOfView;
    }
    View margin() const {
        constexpr double further = 1, wider = 0.5;  // m, rad
        return {range + further, std::min(fieldOfView + wider, 2 * std::numbers::pi)};
    }
};

}  // namespace mrose
