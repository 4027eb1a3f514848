#include "learning/pattern_matrix.h"

#include <cassert>

namespace mrose {

PatternMatrix::PatternMatrix(std::size_t patterns, int features)
    : patterns_(patterns), features_(features), values_((patterns + kBlock - 1) / kBlock * kBlock * features) {}

void PatternMatrix::resize(std::size_t patterns, int features) {
    if (patterns != patterns_ || features != features_) *this = PatternMatrix(patterns, features);
}

PatternMatrix PatternMatrix::fromRows(std::span<const float> rows, int features) {
    assert(features > 0 && rows.size() % features == 0);
    PatternMatrix matrix(rows.size() / features, features);
    const float* from = rows.data();
    for (std::size_t pattern = 0; pattern < matrix.patterns(); ++pattern)
        for (int feature = 0; feature < features; ++feature) matrix(pattern, feature) = *from++;
    return matrix;
}

std::vector<float> PatternMatrix::toRows() const {
    std::vector<float> rows;
    rows.reserve(patterns_ * features_);
    for (std::size_t pattern = 0; pattern < patterns_; ++pattern)
        for (int feature = 0; feature < features_; ++feature) rows.push_back((*this)(pattern, feature));
    return rows;
}

}  // namespace mrose
