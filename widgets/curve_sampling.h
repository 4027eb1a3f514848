#pragma once

#include <QPointF>
#include <QVector>
#include <cstdint>

#include "debug/tick_numbers.h"

namespace mrose {

/// Points (tick, number) to draw those between two ticks from: of each `step` ticks the first, the least, the greatest
/// and the last, so that the drawing is the same as of all. Angles in degrees that go round are not joined across.
void sampleCurve(const TickNumbers& numbers, std::int64_t from, std::int64_t to, std::int64_t step, bool angle,
                 QVector<QPointF>& points);

}  // namespace mrose
