#pragma once

#include <string>
#include <vector>

#include "assessment/compare.h"

namespace mrose {

/// What is wrong with a log within a rollout, up to its divergence.
struct DefectsNear {
    std::vector<StampedCommand> blips;  ///< dropped by the reader; of many, the last before the divergence
    struct Gap {
        std::string what;  ///< "carried over 0.82 s without commands from 3.10 s on"
        int from = 0,
            to = 0;  ///< steps since the start: the truth is known at both, and nothing is wrong any more at `to`
    };
    std::vector<Gap> gaps;
};

/// Gaps of commands are pauses longer than 0.5 s and than three usual ones of that log: one that notes changes alone
/// has long pauses without losing anything. Gaps of truth are 0.2 s and more; its jumps (truthJumps) are some, too: of
/// many, the last before the divergence. A gap behind whose end the truth is not
/// known again is left out.
DefectsNear defectsNear(const Trajectory& trajectory, const MotionModel& model, const ComparedRollout& rollout,
                        Nanoseconds step, Nanoseconds divergence);

}  // namespace mrose
