#pragma once

#include <optional>
#include <span>
#include <vector>

#include "debug/played_log.h"
#include "diagnosis/compared_divergences.h"
#include "geometry/area.h"

namespace mrose {

/// Where the simulated robots start beside the real ones.
struct RolloutPlan {
    enum class Cut {
        once,    ///< at one start
        every,   ///< again and again, so that rollouts follow each other
        windows  ///< as `mrose evaluate` cuts the log: a rollout for each robot and window
    };
    Cut cut = Cut::every;
    double start = 0;    ///< s after the log's start; not of windows
    double length = 10;  ///< s, of a rollout
    /// s, of all rollouts that follow each other; nullopt: to the log's end.
    std::optional<double> stretch = {};
    bool operator==(const RolloutPlan&) const = default;
};

/// One robot in one rollout, as lists show it.
struct RolloutRow {
    std::size_t rollout = 0, robot = 0;  ///< in LogRollouts::requests() and LogWorld::robots()
    std::size_t session = 0;             ///< in LogWorld::sessions()
    Nanoseconds start = 0;               ///< on the session's clock
    RolloutUse use = RolloutUse::counted;
    std::optional<double> position;  ///< m, time-mean over what is known; nullopt: there is no ground truth
    std::optional<double> share;     ///< %: of the path; nullopt where it hardly drives
    std::optional<double> heading;   ///< rad, time-mean; nullopt where not all is known
    double path = 0, rotation = 0;   ///< m, rad, of the real robot; not a number where not all is known
    Nanoseconds length = 0;
    std::optional<Manoeuvre> manoeuvre;
    std::optional<Divergence> divergence;
    DivergenceBound bound;                   ///< in force
    std::optional<DivergenceBound> learned;  ///< networkBound()
    bool touched = false;
    Area area{{1, 1}, {-1, -1}};  ///< all that the middles of both robots pass
};

/// The default: every 10 s; of a log whose trajectories are too short for that windows that nearly all of them hold,
/// or, where no such window counts, rollouts as long as that.
RolloutPlan suitedPlan(const PlayedLog& log);

/// The rollouts of a plan. Error: none fits in.
Expected<std::vector<RolloutRequest>> plannedRollouts(const PlayedLog& log, const RolloutPlan& plan);

/// Those of these rollouts whose robots were simulated.
std::vector<RolloutRow> rolloutRows(const LogWorld& world, std::span<const ComparedRollout> rollouts,
                                    const std::vector<RolloutRequest>& requests, const DivergenceOptions& options);

/// Says of rows of these rollouts, in their order, where they leave the real trajectory by other bounds.
void judgeRows(std::span<RolloutRow> rows, std::span<const ComparedRollout> rollouts, const DivergenceOptions& options);

/// The rollouts of a plan driven as `mrose compare` does; rows of those that are done. Error: as of compare().
Expected<Comparison> compareRollouts(const PlayedLog& log, const std::vector<RolloutRequest>& requests,
                                     const DivergenceOptions& bounds,
                                     const std::function<bool(std::vector<RolloutRow> rows, double share)>& report);

/// Of which robot it is asked why it leaves the real trajectory, and what else it might have moved by.
struct CauseQuestion {
    RolloutRequest request;
    RolloutRow row;
    std::vector<OtherModel> models;
};
/// Error: as of compare() and diagnose().
Expected<Diagnosis> whyItLeaves(const PlayedLog& log, const CauseQuestion& question, const Progress& progress);

/// A robot's commands do not end with a rollout after which no other begins.
bool playsToLogEnd(const RolloutPlan& plan, bool restarts);

}  // namespace mrose
