#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "geometry/pose.h"

namespace mrose {

/// What sampled rollouts are judged by, in m: summed over some instants the energy score of the position, the ranked
/// scores of the position along and across the heading of the mean, without which the one direction may be too wide
/// where the other is wider, and the ranked score of the heading; and the energy scores of the displacements from one
/// of these instants to the next, each in the frame of its own start, which say whether errors last as long as real
/// ones.
struct EnergyLoss {
    struct Weights {
        double place = 1;       ///< of the position's scores
        double heading = 0.35;  ///< m/rad
        double move = 1;        ///< of the displacement from here to the next instant
    };
    std::vector<std::size_t> instants;  ///< periods after the start, ascending, from 1 on
    std::vector<Weights> weights;       ///< by instant
    double axisWeight = 0.5;            ///< of the scores along and across, beside the energy score
    bool antithetic = false;            ///< of the samples: learning/sample_scores.h

    /// Instants at 0.1, 0.2, 0.5 and 1 of so many periods, with the weights that they begin with.
    static EnergyLoss over(std::size_t length);

    /// `samples`: increments [sample][period], `count` of them, each as long as `truth` and `mean`. Adds the derivative
    /// by each of the samples' increments to `gradient`, unless it is empty.
    double operator()(std::span<const Pose> samples, std::size_t count, std::span<const Pose> mean,
                      std::span<const Pose> truth, std::span<Pose> gradient) const;
};

}  // namespace mrose
