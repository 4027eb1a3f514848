#pragma once

#include <optional>

#include "diagnosis/divergence.h"

namespace mrose {

/// The time before a divergence in which most of the error arose, as seen from the robot.
struct ErrorOnset {
    Nanoseconds from = 0, to = 0;          ///< since the start
    double ahead = 0, left = 0, turn = 0;  ///< what the real robot moved more than the simulated one: m, m, rad
    DivergenceBound::At bound;             ///< in which they were weighed
    double explained = 0;  ///< 0 ... 1, of the error, that is gone if the robot moves as the real one meanwhile
};

/// The time of length `span`, up to when `divergence` has been held, in which real and simulated motion differ most.
/// nullopt: the truth is not known for so long.
std::optional<ErrorOnset> errorOnsetOf(const ComparedRollout& rollout, Nanoseconds step, const Divergence& divergence,
                                       Nanoseconds held, Nanoseconds span);

}  // namespace mrose
