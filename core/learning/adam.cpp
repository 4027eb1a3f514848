#include "learning/adam.h"

#include <cassert>
#include <cmath>

namespace mrose {

Adam::Adam(std::size_t parameters, const AdamOptions& options)
    : options_(options), mean_(parameters), square_(parameters) {}

void Adam::step(std::span<float> parameters, std::span<const double> gradient, double rateFactor) {
    assert(parameters.size() == mean_.size() && gradient.size() == mean_.size());
    firstPower_ *= options_.firstDecay;
    secondPower_ *= options_.secondDecay;
    for (std::size_t i = 0; i < mean_.size(); ++i) {
        mean_[i] += (1 - options_.firstDecay) * (gradient[i] - mean_[i]);
        square_[i] += (1 - options_.secondDecay) * (gradient[i] * gradient[i] - square_[i]);
        const double deviation = std::sqrt(square_[i] / (1 - secondPower_)) + options_.epsilon;
        const double step = options_.rate * rateFactor * mean_[i] / (1 - firstPower_) / deviation;
        parameters[i] = static_cast<float>(parameters[i] - step);
    }
}

}  // namespace mrose
