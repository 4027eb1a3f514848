#include "world/noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Random123/philox.h>

#include "geometry/elementary.h"

namespace mrose {
std::array<std::uint64_t, 4> noiseWords(const NoiseKey& key) {
    const r123::Philox4x64::ctr_type counter{{static_cast<std::uint64_t>(key.tick), key.robot, key.channel, 0}};
    const r123::Philox4x64::key_type seed{{key.seed, 0}};
    const auto out = r123::Philox4x64{}(counter, seed);
    return {out[0], out[1], out[2], out[3]};
}

/// 53 bits, centred in their cells. The centre of the last cell would be rounded up to 1.
double openUnit(std::uint64_t word) {
    constexpr double last = 1 - 0x1p-53;
    return std::min((static_cast<double>(word >> 11) + 0.5) * 0x1p-53, last);
}

std::uint64_t noiseBits(const NoiseKey& key) { return noiseWords(key)[0]; }

double uniformNoise(const NoiseKey& key) { return openUnit(noiseWords(key)[0]); }

NoisePair uniformPair(const NoiseKey& key) {
    const auto words = noiseWords(key);
    return {openUnit(words[0]), openUnit(words[1])};
}

NoisePair normalPair(const NoiseKey& key) {
    const NoisePair u = uniformPair(key);
    const double radius = std::sqrt(-2 * logarithm(u.first));
    const auto [s, c] = sineCosine(2 * std::numbers::pi * u.second);
    return {radius * c, radius * s};
}

double normalNoise(const NoiseKey& key) { return normalPair(key).first; }

}  // namespace mrose
