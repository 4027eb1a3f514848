#pragma once

#include <cstddef>
#include <vector>

namespace mrose {

/// Patterns that are remembered, of standardised inputs and outputs: outputs are means of those of the nearest ones,
/// weighted by the inverse of their distance.
struct NearestNeighbours {
    static constexpr std::size_t maxValues = 1 << 24, maxNeighbours = 64;

    int inputs = 0, outputs = 0;
    int neighbours = 1;         ///< at most maxNeighbours, and as many as there are patterns
    std::vector<int> read;      ///< the inputs that distances are of, ascending
    std::vector<float> points;  ///< [pattern][read]
    std::vector<float> values;  ///< [pattern][output]
    bool operator==(const NearestNeighbours&) const = default;

    std::size_t patterns() const { return outputs > 0 ? values.size() / static_cast<std::size_t>(outputs) : 0; }
    /// x: `inputs` floats, y: `outputs` floats. They may not overlap.
    void evaluate(const float* x, float* y) const;
};

}  // namespace mrose
