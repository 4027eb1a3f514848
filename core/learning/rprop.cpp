#include "learning/rprop.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace mrose {

namespace {

/// -sgn(gradient) * size
double downhill(double gradient, double size) { return gradient > 0 ? -size : gradient < 0 ? size : 0.0; }

}  // namespace

Rprop::Rprop(std::size_t parameters, const RpropOptions& options)
    : options_(options),
      sizes_(parameters, options.firstStep),
      lastGradient_(parameters),
      lastStep_(parameters),
      lastLoss_(std::numeric_limits<double>::infinity()) {}

void Rprop::step(std::span<float> parameters, std::span<const double> gradient, double loss) {
    assert(parameters.size() == sizes_.size() && gradient.size() == sizes_.size());
    const RpropVariant variant = options_.variant;
    const bool takesBack =
        variant == RpropVariant::rpropPlus || (variant == RpropVariant::iRpropPlus && loss > lastLoss_);
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
        const double change = lastGradient_[i] * gradient[i];
        double step = 0, kept = gradient[i];
        if (change > 0) sizes_[i] = std::min(sizes_[i] * options_.growth, options_.largestStep);
        if (change < 0) sizes_[i] = std::max(sizes_[i] * options_.shrinkage, options_.smallestStep);
        if (change >= 0 || variant == RpropVariant::rpropMinus) {
            step = downhill(gradient[i], sizes_[i]);
        } else {
            if (takesBack) step = -lastStep_[i];
            kept = 0;
        }
        parameters[i] = static_cast<float>(parameters[i] + step);
        lastStep_[i] = step;
        lastGradient_[i] = kept;
    }
    lastLoss_ = loss;
}

}  // namespace mrose
