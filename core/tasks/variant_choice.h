#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "learning/bootstrap.h"
#include "tasks/task_data.h"

namespace mrose {

/// The variant that does best in a trial by one half of its seeds, judged by the other, and the other way round.
struct ChoiceOracle {
    double mean = 0;
    double closed = 0;  ///< how much of the way from the best variant to it is gone by what is learned; 1: all
    Interval closedInterval;
    double agrees = 0;  ///< share of the trials in which what is learned chooses as it does, as judged
};

/// What it comes to on trials that are held out, where for each a variant is chosen by what is learned. Means are over
/// trials, and all intervals are of 95 %, by trials drawn with repetition.
struct VariantChoice {
    struct Variant {
        std::string name;
        double mean = 0;         ///< of the target, where it is always chosen
        double share = 0;        ///< sum of absolute errors of what is predicted of it over sum of values; NaN of zeros
        std::size_t chosen = 0;  ///< in how many trials what is learned chooses it
        double gain = 0;         ///< by how much what is learned does better than it
        Interval gainInterval;
    };

    std::vector<Variant> variants;
    std::size_t best = 0;                ///< of them, by the trials that were learned from
    double mean = 0;                     ///< of the target, where what is learned chooses
    std::optional<ChoiceOracle> oracle;  ///< nullopt: there is one seed alone
    std::size_t trials = 0;              ///< held out

    /// It does better than each single variant.
    bool beatsAll() const;
};

/// `predicted`: [row][variant] of `judged`. `greatest`: the greatest target is best, not the least.
VariantChoice judgeChoice(const TaskData& learnedFrom, const TaskData& judged, const std::vector<double>& predicted,
                          bool greatest);

}  // namespace mrose
