#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace mrose {

struct AdamOptions {
    double rate = 1e-3;
    double firstDecay = 0.9, secondDecay = 0.999;
    double epsilon = 1e-8;
};

/// Adam (Kingma, Ba 2015), with bias correction. For batches smaller than the whole set.
class Adam {
public:
    explicit Adam(std::size_t parameters, const AdamOptions& options = {});

    /// One step down, at `rateFactor` times the rate: schedules are the caller's.
    void step(std::span<float> parameters, std::span<const double> gradient, double rateFactor = 1);

private:
    AdamOptions options_;
    std::vector<double> mean_, square_;
    double firstPower_ = 1, secondPower_ = 1;
};

}  // namespace mrose
