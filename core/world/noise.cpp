#include "world/noise.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include <Random123/philox.h>

#include "geometry/elementary.h"

namespace mrose {
namespace {

/// In place: most need half of the words only, and a call would bring all of them through memory.
[[gnu::always_inline]] inline r123::Philox4x64::ctr_type wordsOf(const NoiseKey& key, std::uint64_t block = 0) {
    const r123::Philox4x64::ctr_type counter{{static_cast<std::uint64_t>(key.tick), key.robot, key.channel, block}};
    const r123::Philox4x64::key_type seed{{key.seed, 0}};
    return r123::Philox4x64{}(counter, seed);
}

/// The normal density, to a factor, for x >= 0, in 256 layers of the same area (Marsaglia and Tsang, The ziggurat
/// method for generating random variables, 2000). Layer i is as wide as `width[i]` and as high as from `height[i]` to
/// `height[i + 1]`; the lowest has the tail beyond width[1] in it.
struct Layers {
    static constexpr std::size_t count = 256;
    static constexpr double tail = 3.6541528853610088, area = 0.004928673233974658;
    std::array<double, count + 1> width{}, height{};

    Layers() noexcept {
        const auto density = [](double x) { return exponential(-0.5 * x * x); };
        width[0] = area / density(tail);
        width[1] = tail;
        for (std::size_t i = 2; i < count; ++i)
            width[i] = std::sqrt(-2 * logarithm(area / width[i - 1] + density(width[i - 1])));
        for (std::size_t i = 0; i <= count; ++i) height[i] = density(width[i]);
    }
};
const Layers layers;

/// A point of a layer, from independent bits of a word.
struct LayerPoint {
    std::size_t layer;
    double x, sign;
    explicit LayerPoint(std::uint64_t word)
        : layer(word % Layers::count),
          x(static_cast<double>(word >> 11) * 0x1p-53 * layers.width[layer]),
          sign(std::bit_cast<double>((word << 55 & 0x8000000000000000) | std::bit_cast<std::uint64_t>(1.0))) {}
    /// Whether it is below the density whatever its height.
    bool within() const { return x < layers.width[layer + 1]; }
};

/// Of a point that may be above the density, one in a hundred: by blocks of bits of its own, an odd one for the first
/// of a key's two normals and an even one for the second.
[[gnu::noinline]] double normalBeyond(LayerPoint point, const NoiseKey& key, std::uint64_t which) {
    for (std::uint64_t block = 1 + which;; block += 2) {
        const auto words = wordsOf(key, block);
        const double u = openUnit(words[0]);
        if (point.layer == 0) {
            const double beyond = -logarithm(u) / Layers::tail;
            if (-2 * logarithm(openUnit(words[1])) > beyond * beyond) return point.sign * (Layers::tail + beyond);
            continue;
        }
        const double low = layers.height[point.layer], high = layers.height[point.layer + 1];
        if (low + u * (high - low) < exponential(-0.5 * point.x * point.x)) return point.sign * point.x;
        point = LayerPoint(words[1]);
        if (point.within()) return point.sign * point.x;
    }
}

[[gnu::always_inline]] inline double normalOf(std::uint64_t word, const NoiseKey& key, std::uint64_t which) {
    const LayerPoint point(word);
    if (point.within()) [[likely]]
        return point.sign * point.x;
    return normalBeyond(point, key, which);
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
    return {normalOf(words[0], key, 0), normalOf(words[1], key, 1)};
}

double normalNoise(const NoiseKey& key) { return normalOf(wordsOf(key)[0], key, 0); }

}  // namespace mrose
