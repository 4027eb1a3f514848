#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace mrose {

/// Resilient backpropagation: steps by the signs of a whole batch's gradient.
/// Rprop+ and Rprop-: Riedmiller, Braun 1993 and Riedmiller 1994; iRprop+ and iRprop-: Igel, Huesken 2003.
enum class RpropVariant {
    rpropPlus,    ///< a change of sign takes the last step back
    rpropMinus,   ///< a change of sign only shortens the step
    iRpropPlus,   ///< a change of sign takes the last step back if the loss rose
    iRpropMinus,  ///< a change of sign shortens the step and waits once
};

struct RpropOptions {
    RpropVariant variant = RpropVariant::iRpropPlus;
    double firstStep = 0.1, smallestStep = 1e-6, largestStep = 50;
    double growth = 1.2, shrinkage = 0.5;
};

class Rprop {
public:
    explicit Rprop(std::size_t parameters, const RpropOptions& options = {});

    /// One step down. `gradient` and `loss` are those at `parameters`; the loss matters to iRprop+ alone.
    void step(std::span<float> parameters, std::span<const double> gradient, double loss);

    std::span<const double> stepSizes() const { return sizes_; }

private:
    RpropOptions options_;
    std::vector<double> sizes_, lastGradient_, lastStep_;
    double lastLoss_ = 0;
};

}  // namespace mrose
