#include "motion/ramped_command.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace mrose {

RampedCommand::RampedCommand(double acceleration, std::span<const double> ages, const double* values,
                             std::size_t stride) {
    const std::size_t pieces = ages.size() - 1;
    assert(acceleration > 0 && pieces > 0 && pieces <= mostPieces);
    double followed = values[(pieces - 1) * stride];
    knots_[count_++] = {ages[pieces], followed, 0};
    for (std::size_t i = pieces; i-- > 0;) {
        const double missing = values[i * stride] - followed, within = acceleration * (ages[i + 1] - ages[i]);
        if (std::abs(missing) <= within) {
            followed = values[i * stride];
            if (missing != 0) add(std::max(ages[i], ages[i + 1] - std::abs(missing) / acceleration), followed);
        } else {
            followed += std::copysign(within, missing);
        }
        add(ages[i], followed);
    }
}

void RampedCommand::add(double age, double value) {
    const Knot& before = knots_[count_ - 1];
    knots_[count_] = {age, value, before.travelled + 0.5 * (before.value + value) * (before.age - age)};
    ++count_;
}

double RampedCommand::travelledAt(double age) const {
    const auto end = knots_.begin() + static_cast<std::ptrdiff_t>(count_);
    const auto next =
        std::upper_bound(knots_.begin(), end, age, [](double a, const Knot& knot) { return a >= knot.age; });
    const Knot& from = next == knots_.begin() ? *next : next[-1];
    if (next == end || next == knots_.begin()) return from.travelled;
    const double since = from.age - age, lasts = from.age - next->age;
    return from.travelled + since * (from.value + 0.5 * (next->value - from.value) * (since / lasts));
}

double RampedCommand::mean(double newest, double oldest) const {
    return (travelledAt(newest) - travelledAt(oldest)) / (oldest - newest);
}

}  // namespace mrose
