#pragma once

#include <cstddef>
#include <vector>

namespace mrose {

/// An interpolating lookup table, of standardised inputs and outputs as a network: a sum of grids, each over a few of
/// the inputs. Between a grid's points it is multilinear, beyond its ends constant.
struct LookupTable {
    static constexpr std::size_t maxAxes = 4, maxPoints = 1 << 20;

    struct Axis {
        int input = 0;             ///< which input
        std::vector<float> knots;  ///< ascending, at least 2
        bool operator==(const Axis&) const = default;
    };
    struct Grid {
        std::vector<Axis> axes;     ///< 1 to maxAxes
        std::vector<float> values;  ///< [point][output]; of the points the last axis' run fastest
        bool operator==(const Grid&) const = default;

        std::size_t points() const;
    };

    int inputs = 0, outputs = 0;
    std::vector<Grid> grids;
    bool operator==(const LookupTable&) const = default;

    /// x: `inputs` floats, y: `outputs` floats. They may not overlap.
    void evaluate(const float* x, float* y) const;

    std::size_t parameterCount() const;  ///< values of all grids
};

/// The points of a grid between which an input lies, with their weights, whose sum is 1.
struct GridCell {
    static constexpr std::size_t maxCorners = std::size_t{1} << LookupTable::maxAxes;

    std::size_t count = 0;
    std::size_t points[maxCorners];
    float weights[maxCorners];
};
void findCell(const LookupTable::Grid& grid, const float* x, GridCell& cell);

}  // namespace mrose
