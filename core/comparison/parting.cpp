#include "comparison/parting.h"

#include <algorithm>
#include <cmath>

namespace mrose {

std::optional<Parting> partingOf(const ComparedCourse& course, Nanoseconds step, const Divergence& divergence,
                                 Nanoseconds held, Nanoseconds span) {
    const auto steps = static_cast<std::size_t>(std::max<Nanoseconds>(1, span / step));
    const std::size_t end =
        std::min(course.simulated.size(), static_cast<std::size_t>((divergence.time + held) / step));
    // Both with the start at 0, where the simulated robot stands as the real one was measured.
    const auto simulated = [&](std::size_t k) { return k == 0 ? course.real.measuredPose : course.simulated[k - 1]; };
    std::optional<Parting> most;
    double largest = 0;
    for (std::size_t k = 0; k + steps <= end; ++k) {
        const Pose real = relative(course.real.truth[k], course.real.truth[k + steps]),
                   ours = relative(simulated(k), simulated(k + steps));
        const Parting here{static_cast<Nanoseconds>(k) * step,
                           static_cast<Nanoseconds>(k + steps) * step,
                           real.x - ours.x,
                           real.y - ours.y,
                           wrapAngle(real.heading - ours.heading),
                           divergence.bound,
                           0};
        const double size = std::hypot(here.ahead / here.bound.position, here.left / here.bound.position,
                                       here.turn / here.bound.heading);
        if (!(size > largest)) continue;
        largest = size;
        most = here;
    }
    return most;
}

}  // namespace mrose
