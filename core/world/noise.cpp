#include "world/noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Random123/philox.h>

#include "geometry/elementary.h"

namespace mrose {
namespace {

/// In place: most need half of the words only, and a call would bring all of them through memory.
[[gnu::always_inline]] inline r123::Philox4x64::ctr_type wordsOf(const NoiseKey& key) {
    const r123::Philox4x64::ctr_type counter{{static_cast<std::uint64_t>(key.tick), key.robot, key.channel, 0}};
    const r123::Philox4x64::key_type seed{{key.seed, 0}};
    return r123::Philox4x64{}(counter, seed);
}

}  // namespace

std::array<std::uint64_t, 4> noiseWords(const NoiseKey& key) {
    const auto words = wordsOf(key);
    return {words[0], words[1], words[2], words[3]};
}

/// 53 bits, centred in their cells. The centre of the last cell would be rounded up to 1.
double openUnit(std::uint64_t word) {
    constexpr double last = 1 - 0x1p-53;
    return std::min((static_cast<double>(word >> 11) + 0.5) * 0x1p-53, last);
}

std::uint64_t noiseBits(const NoiseKey& key) { return wordsOf(key)[0]; }

double uniformNoise(const NoiseKey& key) { return openUnit(wordsOf(key)[0]); }

NoisePair uniformPair(const NoiseKey& key) {
    const auto words = wordsOf(key);
    return {openUnit(words[0]), openUnit(words[1])};
}

NoisePair normalPair(const NoiseKey& key) {
    const auto words = wordsOf(key);
    const NoisePair u{openUnit(words[0]), openUnit(words[1])};
    const double radius = std::sqrt(-2 * logarithm(u.first));
    const auto [s, c] = elementary::byQuadrant(2 * std::numbers::pi * u.second);  // sineCosine(), but nothing to guess
    return {radius * c, radius * s};
}

double normalNoise(const NoiseKey& key) { return normalPair(key).first; }

}  // namespace mrose
