#pragma once

#include <cstdint>
#include <span>

#include "io/toml_table.h"

namespace mrose {

struct SensorView;

/// How measured ranges differ from true ones. Everything zero: not at all.
struct RangeErrors {
    double noise = 0;       ///< m, standard deviation ...
    double noiseShare = 0;  ///< ... and what each metre adds to it
    double resolution = 0;  ///< m: ranges are whole multiples of it
    double dropOut = 0;     ///< probability that an echo is missed
    double leastRange = 0;  ///< m: nearer echoes are not heard
    double range = 0;       ///< m: farther ones neither
    bool operator==(const RangeErrors&) const = default;

    /// Makes readings of true ranges; infinite: no echo. Element i has draws of its own from the `first`-th on.
    void apply(const SensorView& view, std::uint32_t first, std::span<double> ranges) const;
};

/// Its keys; whoever reads them rejects unknown ones.
RangeErrors readRangeErrors(TomlTable& table, double range, NumberRange ranges);

}  // namespace mrose
