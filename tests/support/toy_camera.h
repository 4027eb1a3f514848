#pragma once

#include "assessment/sensor_model.h"
#include "logs/robot_log.h"

namespace mrose {

/// A camera that is known: what is far is reported less often, too far, and by a mixture of a narrow and a wide
/// distribution. Its spreads are `wider` times as large.
class ToyCamera final : public SensorModel {
public:
    explicit ToyCamera(double wider = 1) : wider_(wider) {}

    Nanoseconds latency() const override { return 40'000'000; }
    View view() const override { return {6, 1.2}; }
    void distributions(std::span<const SensedState> states, const std::string& robot,
                       std::span<ReadingDistribution> to) const override;

private:
    double wider_;
};

/// Two robots, "1" and "2", that drive circles among landmarks for so long, and what the camera of the first reports
/// then, drawn from `camera`.
Log seenLog(const SensorModel& camera, double seconds);

}  // namespace mrose
