#include "sensing/odometry.h"

#include "sensing/sensor_view.h"

namespace mrose {

void Odometry::sense(const SensorView& view, std::span<std::byte> /*memory*/, Observation& out) const {
    if (!view.wants(0)) return;
    const Twist& velocity_B = view.state.robots[view.robot].velocity_B;
    Velocity measured{velocity_B.x, velocity_B.rotation};
    if (velocityNoise_ != 0 || rotationNoise_ != 0) {
        const NoisePair draw = normalPair(traits_ ? view.key(0) : view.key(NoiseChannel::velocity, 0));
        measured.v += velocityNoise_ * draw.first;
        measured.w += rotationNoise_ * draw.second;
    }
    out.add(reading_, view.timeBefore(0), measured);
}

}  // namespace mrose
