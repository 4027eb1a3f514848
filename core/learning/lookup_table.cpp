#include "learning/lookup_table.h"

#include <algorithm>

namespace mrose {
namespace {

/// The knot at or below x, but for the last one, and how far x is from it to the next: 0 ... 1.
struct Place {
    std::size_t knot;
    float share;
};

Place placeOf(const std::vector<float>& knots, float x) {
    if (!(x > knots.front())) return {0, 0};  // also of what is no number
    const auto above = std::upper_bound(knots.begin() + 1, knots.end() - 1, x);
    const auto knot = static_cast<std::size_t>(above - knots.begin()) - 1;
    const float share = (x - knots[knot]) / (knots[knot + 1] - knots[knot]);
    return {knot, std::min(share, 1.0f)};
}

}  // namespace

std::size_t LookupTable::Grid::points() const {
    std::size_t count = 1;
    for (const Axis& axis : axes) count *= axis.knots.size();
    return count;
}

std::size_t LookupTable::parameterCount() const {
    std::size_t count = 0;
    for (const Grid& grid : grids) count += grid.values.size();
    return count;
}

void findCell(const LookupTable::Grid& grid, const float* x, GridCell& cell) {
    cell.count = 1;
    cell.points[0] = 0;
    cell.weights[0] = 1;
    for (const LookupTable::Axis& axis : grid.axes) {
        const Place place = placeOf(axis.knots, x[axis.input]);
        for (std::size_t i = 0; i < cell.count; ++i) {
            const std::size_t point = cell.points[i] * axis.knots.size() + place.knot;
            const float weight = cell.weights[i];
            cell.points[i] = point;
            cell.weights[i] = weight * (1 - place.share);
            cell.points[cell.count + i] = point + 1;
            cell.weights[cell.count + i] = weight * place.share;
        }
        cell.count *= 2;
    }
}

void LookupTable::evaluate(const float* x, float* y) const {
    std::fill_n(y, outputs, 0.0f);
    const auto width = static_cast<std::size_t>(outputs);
    GridCell cell;
    for (const Grid& grid : grids) {
        findCell(grid, x, cell);
        for (std::size_t i = 0; i < cell.count; ++i) {
            const float* const values = grid.values.data() + cell.points[i] * width;
            for (std::size_t k = 0; k < width; ++k) y[k] += cell.weights[i] * values[k];
        }
    }
}

}  // namespace mrose
