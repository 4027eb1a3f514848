#include "learning/nearest_neighbours.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mrose {

void NearestNeighbours::evaluate(const float* x, float* y) const {
    struct Neighbour {
        float square;
        std::size_t pattern;
        bool operator<(const Neighbour& other) const {
            return square != other.square ? square < other.square : pattern < other.pattern;
        }
    };
    std::array<Neighbour, maxNeighbours> nearest;  // ascending
    const std::size_t width = read.size(), most = static_cast<std::size_t>(neighbours);
    std::size_t found = 0;
    for (std::size_t p = 0; p < patterns(); ++p) {
        const float* const point = points.data() + p * width;
        float square = 0;
        for (std::size_t i = 0; i < width; ++i) {
            const float off = x[read[i]] - point[i];
            square += off * off;
        }
        const Neighbour one{square, p};
        if (found == most && !(one < nearest[most - 1])) continue;
        if (found < most) ++found;
        std::size_t place = found - 1;
        for (; place > 0 && one < nearest[place - 1]; --place) nearest[place] = nearest[place - 1];
        nearest[place] = one;
    }
    std::fill_n(y, outputs, 0.0f);
    float sum = 0;
    for (std::size_t i = 0; i < found; ++i) {
        const float weight = 1 / (1e-6f + std::sqrt(nearest[i].square));
        const float* const of = values.data() + nearest[i].pattern * static_cast<std::size_t>(outputs);
        for (int k = 0; k < outputs; ++k) y[k] += weight * of[k];
        sum += weight;
    }
    for (int k = 0; k < outputs && found > 0; ++k) y[k] /= sum;
}

}  // namespace mrose
