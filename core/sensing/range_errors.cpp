#include "sensing/range_errors.h"

#include <algorithm>
#include <array>
#include <limits>

#include "geometry/normal_distribution.h"
#include "sensing/sensor_keys.h"
#include "sensing/sensor_view.h"

namespace mrose {

void RangeErrors::apply(const SensorView& view, std::uint32_t first, std::span<double> ranges) const {
    constexpr double missed = std::numeric_limits<double>::infinity();
    constexpr std::size_t atOnce = 8;  // the numbers of a key
    const bool noisy = noise > 0 || noiseShare > 0;
    for (std::size_t begin = 0; begin < ranges.size() && (noisy || dropOut > 0); begin += atOnce) {
        const auto eight = ranges.subspan(begin, std::min(atOnce, ranges.size() - begin));
        const auto draw = first + static_cast<std::uint32_t>(2 * (begin / atOnce));
        if (noisy) {
            const UniformDraws u(view.key(draw));
            const auto normal = drawnNormals(std::array{u[0], u[1], u[2], u[3], u[4], u[5], u[6], u[7]});
            for (std::size_t i = 0; i < eight.size(); ++i)
                eight[i] = std::max(0.0, eight[i] + (noise + noiseShare * std::min(eight[i], 1e6)) * normal[i]);
        }
        if (dropOut > 0) {
            const UniformDraws u(view.key(draw + 1));
            for (std::size_t i = 0; i < eight.size(); ++i) eight[i] = u[i] < dropOut ? missed : eight[i];
        }
    }
    for (double& measured : ranges) measured = measured >= leastRange && measured <= range ? measured : missed;
    if (resolution > 0)
        for (double& measured : ranges)
            measured = measured < missed ? resolution * nearestWhole(measured / resolution) : missed;
}

RangeErrors readRangeErrors(TomlTable& table, double range, NumberRange ranges) {
    RangeErrors errors;
    errors.range = table.numberOr("range_m", range, ranges);
    errors.leastRange = table.numberOr("least_range_m", 0, {0, errors.range});
    errors.noise = table.numberOr("range_noise_m", 0, metresOff);
    errors.noiseShare = table.numberOr("range_noise", 0, {0, 1});
    errors.resolution = table.numberOr("resolution_m", 0, {0, 1});
    errors.dropOut = table.numberOr("drop_out", 0, probability);
    return errors;
}

}  // namespace mrose
