#include "motion/ramped_command.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace mrose {

RampedCommand::RampedCommand(double acceleration, std::span<const double> ages, const double* values,
                             std::size_t stride, double oldest) {
    const std::size_t pieces = ages.size() - 1;
    assert(acceleration > 0 && pieces > 0 && pieces <= mostPieces);
    const double perAcceleration = 1 / acceleration;
    double followed = values[(pieces - 1) * stride];
    std::size_t i = pieces - 1;
    for (; ages[i] >= oldest; --i) {  // before what is asked for
        const double within = acceleration * (ages[i + 1] - ages[i]);
        followed += std::clamp(values[i * stride] - followed, -within, within);
    }
    knots_[count_++] = {ages[i + 1], followed, 0};
    for (++i; i-- > 0;) {
        const double missing = values[i * stride] - followed, within = acceleration * (ages[i + 1] - ages[i]);
        if (std::abs(missing) <= within) {
            followed = values[i * stride];
            if (missing != 0) add(std::max(ages[i], ages[i + 1] - std::abs(missing) * perAcceleration), followed);
        } else {
            followed += std::copysign(within, missing);
        }
        add(ages[i], followed);
    }
    next_ = count_ - 1;
}

void RampedCommand::add(double age, double value) {
    const Knot& before = knots_[count_ - 1];
    knots_[count_] = {age, value, before.travelled + 0.5 * (before.value + value) * (before.age - age)};
    ++count_;
}

double RampedCommand::travelledAt(double age) {
    if (age == lastAge_) return lastTravelled_;
    if (age < lastAge_) next_ = count_ - 1;
    while (next_ > 0 && knots_[next_].age < age) --next_;
    const Knot& from = knots_[next_];
    lastAge_ = age;
    lastTravelled_ = from.travelled;
    if (next_ + 1 < count_ && from.age > age) {
        const Knot& to = knots_[next_ + 1];
        const double since = from.age - age;
        lastTravelled_ += since * (from.value + 0.5 * (to.value - from.value) * (since / (from.age - to.age)));
    }
    return lastTravelled_;
}

double RampedCommand::mean(double newest, double oldest) {
    const double end = travelledAt(newest);
    return (end - travelledAt(oldest)) / (oldest - newest);
}

}  // namespace mrose
