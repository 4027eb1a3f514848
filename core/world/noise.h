#pragma once

#include <array>
#include <cstdint>

namespace mrose {

/// Which draw of a run this is. Equal keys give equal numbers, whatever was drawn before: there is no generator to
/// save, and branches of a run share their noise.
struct NoiseKey {
    std::uint64_t seed = 0;
    std::int64_t tick = 0;
    std::uint32_t robot = 0;
    std::uint32_t channel = 0;
};

/// 256 random bits, from Philox 4x64-10 (Salmon et al. 2011).
std::array<std::uint64_t, 4> noiseWords(const NoiseKey& key);

/// The first 64 of them.
std::uint64_t noiseBits(const NoiseKey& key);

/// Random bits as a number in the open interval (0, 1): neither 0 nor 1, whatever they are.
double openUnit(std::uint64_t word);

/// Uniform in the open interval (0, 1), from the same bits.
double uniformNoise(const NoiseKey& key);

/// Two uniform and independent ones, at the price of one.
struct NoisePair {
    double first = 0, second = 0;
};
NoisePair uniformPair(const NoiseKey& key);

/// Two standard normal and independent ones; the first is normalNoise's.
NoisePair normalPair(const NoiseKey& key);

/// Standard normal.
double normalNoise(const NoiseKey& key);

/// Eight uniform numbers in the open interval (0, 1) of 32 bits each, at the price of one: the key's bits in order.
class UniformDraws {
public:
    explicit UniformDraws(const NoiseKey& key) : words_(noiseWords(key)) {}
    double operator[](std::size_t i) const {
        const auto bits = static_cast<std::uint32_t>(words_[i / 2] >> (i % 2 * 32));
        return (static_cast<double>(bits) + 0.5) * 0x1p-32;
    }

private:
    std::array<std::uint64_t, 4> words_;
};

}  // namespace mrose
