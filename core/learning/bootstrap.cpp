#include "learning/bootstrap.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <Random123/philox.h>

#include "learning/parallel_for.h"

namespace mrose {

Interval bootstrapInterval(std::size_t count, const std::function<double(std::span<const std::size_t>)>& statistic) {
    constexpr std::size_t draws = 1000;
    std::vector<double> values(draws);
    parallelFor(draws, [&](std::size_t draw) {
        const r123::Philox2x64::key_type key = {{draw}};
        std::vector<std::size_t> drawn(count);
        for (std::size_t i = 0; i < count; ++i) {
            const r123::Philox2x64::ctr_type counter = {{i, 0}};
            const std::uint64_t bits = r123::Philox2x64()(counter, key)[0];
            drawn[i] = static_cast<std::size_t>(static_cast<double>(bits >> 11) * 0x1p-53 * static_cast<double>(count));
        }
        values[draw] = statistic(drawn);
    });
    std::sort(values.begin(), values.end());
    return {values[static_cast<std::size_t>(0.025 * draws)], values[static_cast<std::size_t>(0.975 * draws)]};
}

}  // namespace mrose
