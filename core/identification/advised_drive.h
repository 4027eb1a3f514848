#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "identification/motion_samples.h"
#include "identification/planned_drive.h"
#include "io/progress.h"

namespace mrose {

/// The commands in the logs: the least and the most of v, from 0 on, and the most of |w|.
CommandLimits limitsOf(std::span<const Log> logs);

struct AdviceOptions {
    CommandLimits limits;
    double duration = 120;  ///< s, with the rest at both ends
    double radius = 3;      ///< m: no farther from where it begins, as far as the network knows
    int candidates = 120;   ///< manoeuvres that are compared each time
    std::uint64_t seed = 1;
};

/// A manoeuvre that was chosen, and what for.
struct AdvisedManoeuvre {
    DrivePiece manoeuvre;
    double unfamiliar = 0;  ///< share of its periods that the network calls unfamiliar; 0 where it does not know
    double doubt = 0;       ///< disagreement of the members, in units of their mean over the logs
};

struct AdvisedDrive {
    double duration = 0;
    std::vector<StampedCommand> commands;  ///< changes only; from 0 on, the last one is rest
    std::vector<AdvisedManoeuvre> manoeuvres;
    Pose least, most;  ///< the robot's way, m, from where it begins, along x: the box round it
    /// Mean distance of driving within the limits from the nearest that is known; and with this drive.
    double farBefore = 0, farAfter = 0;
    bool membersKnown = false, familiarKnown = false;
};

/// The drive that adds most to what is known: what is in the logs, and what the network says that it was learned from
/// (MotionNetwork::familiar). Samples of driving within the limits are each worth
/// how much the members disagree on it; the sum of their squared distances from what is known or in the drive,
/// each times its worth, is made small greedily, manoeuvre by manoeuvre. Begins and ends at rest. Error: a log without
/// patterns; limits that allow no motion; it was cancelled.
Expected<AdvisedDrive> adviseDrive(const LearnedMotion& motion, std::span<const Log> logs, const AdviceOptions& options,
                                   const Progress& progress = {});

}  // namespace mrose
