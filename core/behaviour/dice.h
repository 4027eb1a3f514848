#pragma once

#include <cstdint>

namespace mrose {

/// Random numbers from the 64 random bits of an observation, in turn (SplitMix64, Steele, Lea, Flood 2014).
class Dice {
public:
    explicit Dice(std::uint64_t bits) : bits_(bits) {}

    double between(double least, double most) {
        bits_ += 0x9E3779B97F4A7C15U;
        std::uint64_t z = bits_;
        z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9U;
        z = (z ^ z >> 27) * 0x94D049BB133111EBU;
        return least + (most - least) * (static_cast<double>((z ^ z >> 31) >> 11) * 0x1p-53);
    }

private:
    std::uint64_t bits_;
};

}  // namespace mrose
