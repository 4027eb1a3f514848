#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "geometry/pose.h"
#include "motion/motion_network.h"
#include "world/noise.h"

namespace mrose {

/// How much of each NoiseTrait there is in a period, which comes after one of the increment `previous` (at first the
/// same). `row`: the network's standardised inputs.
class NoiseTraitReader {
public:
    explicit NoiseTraitReader(const MotionNetwork& network);

    NoiseTraits read(const float* row, const Pose& increment, const Pose& previous) const;

private:
    /// Neighbouring inputs of one quantity: their difference is first * row[input] + second * row[input + 1] +
    /// constant.
    struct Neighbours {
        std::size_t input;
        double first, second, constant;
    };
    std::vector<Neighbours> v_, w_;
    double period_;
};

/// A ResidualNoise ready to be drawn. What it remembers of a robot are values() numbers, each normal with mean 0 and
/// variance 1: of its processes, of the ensemble's members, and of the scale.
class NoiseProcesses {
public:
    NoiseProcesses(const ResidualNoise& noise, std::size_t members, double period);

    std::size_t values() const { return decays_.size(); }
    /// How many of the ensemble's members it reads: all or none.
    std::size_t members() const { return members_; }

    /// The values a period later; the first ones where nothing has `begun`. Draws channels key.channel + 0, 1, ... of
    /// the key, one for every eight values.
    void advance(const NoiseKey& key, bool begun, std::span<float> values) const;

    /// What is added to the mean's increment; traits count up to ResidualNoise::most. `members`: their increments, less
    /// the mean's.
    Pose noise(std::span<const float> values, const NoiseTraits& traits, std::span<const Pose> members) const;

    /// exp of the scale's value: all of the noise is multiplied by it.
    double scale(std::span<const float> values) const;

private:
    ResidualNoise noise_;
    NoiseTraits most_;
    std::size_t members_;
    double perMember_;  ///< weight of a member's value
    std::vector<double> decays_, renewals_;
};

}  // namespace mrose
