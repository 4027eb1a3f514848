#pragma once

#include <filesystem>
#include <vector>

#include "io/error.h"
#include "learning/pattern_set.h"

namespace mrose::bench {

/// Patterns by rows of inputs and then targets, standardised with the training patterns' mean and deviation.
struct PatternRows {
    int training = 0, validation = 0, inputs = 0, outputs = 0;
    std::vector<float> values;  ///< [training + validation][inputs + outputs]

    PatternSet set(int first, int count) const;
    PatternSet trainingSet() const { return set(0, training); }
    PatternSet validationSet() const { return set(training, validation); }
};

/// int32 training, validation, inputs, outputs, then the rows in float32, little-endian.
Expected<PatternRows> readPatterns(const std::filesystem::path& file);

/// 100,000 + 20,000 patterns of a synthetic differential-drive robot: (v, w, v_cmd, w_cmd) -> (dx, dy, dphi, v', w')
/// over 100 ms, with dead time, lag and saturation of the wheels, slip in turns and measurement noise, so
/// much of it that a network of 24 hidden units needs about a thousand epochs of RPROP to a validation MSE of 0.0125.
PatternRows syntheticPatterns();

}  // namespace mrose::bench
