#pragma once

#include <span>
#include <vector>

#include "learning/lookup_table.h"
#include "learning/pattern_matrix.h"

namespace mrose {

/// The outputs of a lookup table for given patterns, and what a loss says of the table's values: as MlpGradient of a
/// network. Parameters are the values of all grids, one after the other. Runs in the oneTBB arena of its caller; the
/// results do not depend on the number of threads.
class TableGradient {
public:
    /// Where the patterns lie in the grids is found once.
    TableGradient(const LookupTable& table, const PatternMatrix& inputs);

    std::size_t parameterCount() const { return parameterCount_; }
    void forward(std::span<const float> parameters, PatternMatrix& outputs) const;
    /// dL/doutputs -> dL/dparameters, ADDED to `gradient`.
    void backward(const PatternMatrix& outputGradient, std::span<double> gradient) const;

private:
    struct Corner {
        std::uint32_t parameter;  ///< of the first output
        float weight;
    };
    std::size_t outputs_, patterns_, parameterCount_, cornersPerPattern_;
    std::vector<Corner> corners_;  ///< [pattern][corner]
};

/// Adds `strength` times the sum of the squared differences of values next to each other to the gradient; returns that
/// term of the loss. Where no pattern lies, a table then takes what is beside it.
double addRoughness(const LookupTable& table, std::span<const float> parameters, double strength,
                    std::span<double> gradient);

}  // namespace mrose
