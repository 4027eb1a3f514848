#include "learning/table_gradient.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "learning/parallel_for.h"

namespace mrose {
namespace {

// Sums are over fixed parts of the patterns, added in order: the same for any number of threads.
constexpr std::size_t parts = 8;

}  // namespace

TableGradient::TableGradient(const LookupTable& table, const PatternMatrix& inputs)
    : outputs_(static_cast<std::size_t>(table.outputs)),
      patterns_(inputs.patterns()),
      parameterCount_(table.parameterCount()),
      cornersPerPattern_(0) {
    for (const LookupTable::Grid& grid : table.grids) cornersPerPattern_ += std::size_t{1} << grid.axes.size();
    corners_.resize(patterns_ * cornersPerPattern_);
    std::vector<float> x(static_cast<std::size_t>(table.inputs));
    Corner* to = corners_.data();
    GridCell cell;
    for (std::size_t pattern = 0; pattern < patterns_; ++pattern) {
        for (int i = 0; i < table.inputs; ++i) x[static_cast<std::size_t>(i)] = inputs(pattern, i);
        std::size_t first = 0;
        for (const LookupTable::Grid& grid : table.grids) {
            findCell(grid, x.data(), cell);
            for (std::size_t i = 0; i < cell.count; ++i)
                *to++ = {static_cast<std::uint32_t>(first + cell.points[i] * outputs_), cell.weights[i]};
            first += grid.values.size();
        }
    }
}

void TableGradient::forward(std::span<const float> parameters, PatternMatrix& outputs) const {
    assert(parameters.size() == parameterCount_);
    outputs.resize(patterns_, static_cast<int>(outputs_));
    parallelFor(outputs.blocks(), [&](std::size_t block) {
        const std::size_t begin = block * PatternMatrix::kBlock, count = outputs.patternsOfBlock(block);
        for (std::size_t k = 0; k < outputs_; ++k) {
            const std::span<float> column = outputs.column(block, static_cast<int>(k));
            for (std::size_t i = 0; i < count; ++i) {
                const Corner* const corner = &corners_[(begin + i) * cornersPerPattern_];
                float sum = 0;
                for (std::size_t c = 0; c < cornersPerPattern_; ++c)
                    sum += corner[c].weight * parameters[corner[c].parameter + k];
                column[i] = sum;
            }
        }
    });
}

void TableGradient::backward(const PatternMatrix& outputGradient, std::span<double> gradient) const {
    assert(gradient.size() == parameterCount_ && outputGradient.patterns() == patterns_);
    std::array<std::vector<double>, parts> sums;
    const std::size_t blocks = outputGradient.blocks();
    parallelFor(parts, [&](std::size_t part) {
        sums[part].assign(parameterCount_, 0.0);
        for (std::size_t block = part * blocks / parts; block < (part + 1) * blocks / parts; ++block)
            for (std::size_t k = 0; k < outputs_; ++k) {
                const std::span<const float> column = outputGradient.column(block, static_cast<int>(k));
                const Corner* corner = &corners_[block * PatternMatrix::kBlock * cornersPerPattern_];
                for (const float slope : column)
                    for (std::size_t c = 0; c < cornersPerPattern_; ++c, ++corner)
                        sums[part][corner->parameter + k] += static_cast<double>(corner->weight) * slope;
            }
    });
    for (const std::vector<double>& sum : sums)
        for (std::size_t i = 0; i < parameterCount_; ++i) gradient[i] += sum[i];
}

double addRoughness(const LookupTable& table, std::span<const float> parameters, double strength,
                    std::span<double> gradient) {
    double term = 0;
    std::size_t first = 0;
    const auto width = static_cast<std::size_t>(table.outputs);
    for (const LookupTable::Grid& grid : table.grids) {
        std::size_t stride = width;
        for (std::size_t a = grid.axes.size(); a-- > 0;) {
            const std::size_t knots = grid.axes[a].knots.size();
            for (std::size_t i = 0; i < grid.values.size(); ++i) {
                if (i / stride % knots + 1 == knots) continue;
                const std::size_t here = first + i, next = here + stride;
                const double difference = static_cast<double>(parameters[next]) - parameters[here];
                term += difference * difference;
                gradient[next] += 2 * strength * difference;
                gradient[here] -= 2 * strength * difference;
            }
            stride *= knots;
        }
        first += grid.values.size();
    }
    return strength * term;
}

}  // namespace mrose
