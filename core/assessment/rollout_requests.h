#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assessment/log_world.h"
#include "assessment/prediction_files.h"

namespace mrose {

/// A rollout to be driven: from a start that is the real robots', with nothing but their commands from there on.
struct RolloutRequest {
    std::size_t session = 0;
    Nanoseconds start = 0;  ///< on the session's clock
    int steps = 0;
    std::optional<std::size_t> robot = std::nullopt;  ///< the only compared robot that is asked about; nullopt: all
};

/// One stretch of a log, whole or restarted.
struct StretchOptions {
    Nanoseconds start = 0;                ///< on the session's clock
    std::optional<Nanoseconds> duration;  ///< nullopt: to the end of the ground truth
    std::optional<Nanoseconds>
        every;  ///< restarted so often, in every session; nullopt: one rollout in the first session
    Nanoseconds step = 100'000'000;
};

/// The rollouts of a stretch, all of one length. A stretch that reaches beyond the end of the ground truth ends there.
/// Error: the start lies beyond it, or no rollout fits in; a length that is no whole number of steps.
Expected<std::vector<RolloutRequest>> rolloutsOf(const LogWorld& world, const StretchOptions& options);

/// A rollout for each of these windows whose robot and trajectory the world has, in their order.
std::vector<RolloutRequest> rolloutsOfWindows(const LogWorld& world, std::span<const Window> windows);

/// A rollout for each window of this length that `mrose evaluate` has of the compared robots. Error: as for
/// findWindows(); the world has none of them.
Expected<std::vector<RolloutRequest>> rolloutsOfAllWindows(const LogWorld& world, Nanoseconds length);

/// How long the windows of a log want to be whose sessions are mostly too short to be restarted `every` so often: what
/// nine tenths of the trajectories hold, in whole steps, and no more than `every`. nullopt: rollouts of `every` cover
/// at least half of what was driven.
std::optional<Nanoseconds> windowsThatSuit(const LogWorld& world, Nanoseconds every);

/// A rollout for each window of a file; robots that are not compared are left out where `robots` names the compared
/// ones. Error: as for requestedStarts; a robot that the scenario does not play, or not in that trajectory.
Expected<std::vector<RolloutRequest>> requestedRollouts(const LogWorld& world, std::vector<WindowRequest> windows,
                                                        const std::vector<std::string>& robots, int steps,
                                                        const std::string& fileName);

}  // namespace mrose
