#pragma once

#include "geometry/point.h"
#include "world/command.h"
#include "world/time.h"

namespace mrose {

struct SensorView;

/// How far about its instant of measurement an exact sensor so late finds its robot's velocity: its latency, but no
/// less than 40 ms. It reads poses that much further back than its latency (Sensor::lookBack()).
Nanoseconds velocityReach(Nanoseconds latency);

/// The mean velocity of the sensor's robot from `reach` before the instant SensorView::measured to `reach` after it, as
/// far as that is past when the measurement arrives. `own`: where the robot was at that instant.
Velocity ownVelocity(const SensorView& view, const Placement& own, Nanoseconds reach);

}  // namespace mrose
