#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "geometry/point.h"

namespace mrose {

/// In which directions a sensor can still see farther, as far as is certain: a bit for each of many narrow slots.
/// Directions are told by turns: numbers that grow with the angle, counter-clockwise from -2 to 2; both are against x.
class Horizon {
public:
    static constexpr std::size_t slotCount = 4096;

    static double turnOf(const Point& direction) {
        const double sum = std::max(std::abs(direction.x) + std::abs(direction.y), 1e-300);
        const double ahead = direction.y / sum, behind = std::copysign(2, direction.y) - ahead;
        return direction.x >= 0 ? ahead : behind;
    }
    static std::size_t slotOf(double turn) {
        const double slot = std::min(std::max(0.0, (turn + 2) * perTurn), slotCount - 1.0);
        return static_cast<std::size_t>(static_cast<std::int64_t>(slot));
    }

    /// All directions counter-clockwise from `right` to `left`; past 2 and -2 where right > left.
    struct Arc {
        double right = -2, left = 2;
    };

    /// Nothing is closed any more.
    void open() { closed_.fill(0); }
    /// Closes the slots that lie within the arc as a whole.
    void close(const Arc& arc);

    bool isClosed(double turn) const {
        const std::size_t slot = slotOf(turn);
        return (closed_[slot / 64] >> slot % 64 & 1) != 0;
    }
    /// All slots that the arc meets.
    bool isClosed(const Arc& arc) const {
        const std::size_t first = firstOf(arc), last = lastOf(arc);
        return arc.right <= arc.left ? allClosed(first, last) : allClosed(first, slotCount - 1) && allClosed(0, last);
    }

    // The slots that an arc meets, widened a little against rounding.
    static std::size_t firstOf(const Arc& arc) { return slotOf(arc.right - little); }
    static std::size_t lastOf(const Arc& arc) { return slotOf(arc.left + little); }

private:
    static constexpr double perTurn = slotCount / 4.0, little = 1e-9;

    bool allClosed(std::size_t first, std::size_t last) const;

    std::array<std::uint64_t, slotCount / 64> closed_{};
};

}  // namespace mrose
