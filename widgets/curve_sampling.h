#pragma once

#include <QPointF>
#include <QVector>
#include <cstdint>
#include <vector>

namespace mrose {

/// Numbers of ticks in a row; NaN where one is unknown.
struct TickNumbers {
    std::int64_t first = 0;
    std::vector<float> values;

    std::int64_t end() const { return first + static_cast<std::int64_t>(values.size()); }
    float at(std::int64_t tick) const;  ///< NaN outside
};

/// Points (tick, number) to draw those between two ticks from: of each `step` ticks the first, the least, the greatest
/// and the last, so that the drawing is the same as of all. Angles in degrees that go round are not joined across.
void sampleCurve(const TickNumbers& numbers, std::int64_t from, std::int64_t to, std::int64_t step, bool angle,
                 QVector<QPointF>& points);

}  // namespace mrose
