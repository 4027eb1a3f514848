#pragma once

#include <span>

#include "geometry/pose.h"

namespace mrose {

/// How far a chain of predicted increments leads from the true one. Distances and angles count by their absolute value,
/// as in the errors that are reported, rounded near zero so that the loss is smooth.
struct RolloutLoss {
    double headingWeight = 0.35;     ///< m/rad
    double velocityWeight = 0.02;    ///< m; of squared errors of v' and w' in units of their spread: form state only
    double positionRounding = 1e-3;  ///< m
    double headingRounding = 3e-3;   ///< rad

    /// Loss of one chain, the mean over its instants, in m; adds its derivative by the predicted increments to
    /// `gradient`. All spans have the same size.
    double operator()(std::span<const Pose> predicted, std::span<const Pose> truth, std::span<Pose> gradient) const;
};

}  // namespace mrose
