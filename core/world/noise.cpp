#include "world/noise.h"

#include <cmath>
#include <numbers>

#include <Random123/philox.h>

namespace mrose {
namespace {

struct Words {
    std::uint64_t first, second;
};

Words words(const NoiseKey& key) {
    const r123::Philox4x64::ctr_type counter{{static_cast<std::uint64_t>(key.tick), key.robot, key.channel, 0}};
    const r123::Philox4x64::key_type seed{{key.seed, 0}};
    const auto out = r123::Philox4x64{}(counter, seed);
    return {out[0], out[1]};
}

/// 53 bits, centred in their cells, so that neither 0 nor 1 occurs.
double openUnit(std::uint64_t word) { return (static_cast<double>(word >> 11) + 0.5) * 0x1p-53; }

}  // namespace

double uniformNoise(const NoiseKey& key) { return openUnit(words(key).first); }

double normalNoise(const NoiseKey& key) {
    const Words w = words(key);
    const double radius = std::sqrt(-2 * std::log(openUnit(w.first)));
    return radius * std::cos(2 * std::numbers::pi * openUnit(w.second));
}

}  // namespace mrose
