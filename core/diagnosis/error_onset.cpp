#include "diagnosis/error_onset.h"

#include <algorithm>

#include "geometry/point.h"

namespace mrose {

std::optional<ErrorOnset> errorOnsetOf(const ComparedRollout& rollout, Nanoseconds step, const Divergence& divergence,
                                       Nanoseconds held, Nanoseconds span) {
    const auto steps = static_cast<std::size_t>(std::max<Nanoseconds>(1, span / step));
    const std::size_t end =
        std::min(rollout.simulated.size(), static_cast<std::size_t>((divergence.time + held) / step));
    // Both with the start at 0, where the simulated robot stands as the real one was measured.
    const auto simulated = [&](std::size_t k) { return k == 0 ? rollout.real.measuredPose : rollout.simulated[k - 1]; };
    std::optional<ErrorOnset> most;
    double largest = 0;
    for (std::size_t k = 0; k + steps <= end; ++k) {
        const Pose real = relative(rollout.real.truth[k], rollout.real.truth[k + steps]),
                   ours = relative(simulated(k), simulated(k + steps));
        const ErrorOnset here{static_cast<Nanoseconds>(k) * step,
                              static_cast<Nanoseconds>(k + steps) * step,
                              real.x - ours.x,
                              real.y - ours.y,
                              wrapAngle(real.heading - ours.heading),
                              divergence.bound,
                              0};
        const double position = length({here.ahead, here.left}) / here.bound.position,
                     size = length({position, here.turn / here.bound.heading});
        if (!(size > largest)) continue;
        largest = size;
        most = here;
    }
    return most;
}

}  // namespace mrose
