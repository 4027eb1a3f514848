#pragma once

#include <cmath>
#include <numbers>

#include "geometry/elementary.h"
#include "world/noise.h"

namespace mrose {

// Distributions that no learned sensor is made of, each from one key.

/// Two standard normal ones, by Box and Muller's transform: the logs of a seed stay what they are, whatever the world
/// draws its own by.
inline NoisePair boxMullerPair(const NoiseKey& key) {
    const NoisePair u = uniformPair(key);
    const double radius = std::sqrt(-2 * logarithm(u.first));
    const auto [s, c] = elementary::byQuadrant(2 * std::numbers::pi * u.second);  // sineCosine(), but nothing to guess
    return {radius * c, radius * s};
}

/// Laplace's distribution of standard deviation 1.
inline double laplaceNoise(const NoiseKey& key) {
    const double u = uniformNoise(key) - 0.5;
    const double size = -logarithm(1 - 2 * std::abs(u)) / std::sqrt(2.0);
    return u < 0 ? -size : size;
}

/// Student's distribution of four degrees of freedom, whose standard deviation is the square root of 2. `spread` is a
/// key of its own.
inline double studentNoise(const NoiseKey& key, const NoiseKey& spread) {
    const NoisePair u = uniformPair(spread);
    return boxMullerPair(key).first / std::sqrt(-0.5 * logarithm(u.first * u.second));
}

/// Stretches in which nothing is reported.
class Bursts {
public:
    /// Goes on by `seconds`; `rate` is how many begin in a second, `mean` [s] how long they last. True within one.
    bool goOn(double seconds, double rate, double mean, double uniform) {
        within_ = within_ ? uniform < decay(seconds / mean) : uniform < rate * seconds;
        return within_;
    }

private:
    bool within_ = false;
};

}  // namespace mrose
