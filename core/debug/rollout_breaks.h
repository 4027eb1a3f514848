#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assessment/reality.h"
#include "debug/breakpoints.h"
#include "debug/rollout_hits.h"
#include "debug/rollout_rows.h"
#include "diagnosis/divergence.h"
#include "io/progress.h"

namespace mrose {

// What breakpoints ask of rollouts that are laid over a log.

/// What "divergence" asks in a rollout: where its robots first leave the real ones, as the comparison knows. What
/// branches do has not been compared: in them it holds while a robot has been beyond its bound for as long as that
/// asks.
struct LeavingRobots {
    struct Robot {
        std::string name;  ///< of the simulated one
        DivergenceBound bound;
        std::optional<Nanoseconds> leaves;  ///< where the comparison has it
    };
    std::vector<Robot> robots;
    std::string real = "real";                  ///< Log::real()
    std::shared_ptr<const Reality> reality;     ///< null: branches do not ask
    std::optional<std::uint32_t> compared = 0;  ///< the branch that is the rollout of the comparison
};
LeavingRobots leavingRobots(const LogWorld& world, std::span<const RolloutRow> rowsOfRollout);
TickPredicate leavesReality(const LeavingRobots& leaving);
/// Which of them begin to do so at a tick: "create 5 leaves the real trajectory".
TickText whoLeaves(const LeavingRobots& leaving);

/// In which rollouts of a log to look for a break, in that order, and what leaves the real trajectory in each.
struct RolloutSearch {
    BreakWish wish;
    std::vector<Breakpoint> breakpoints;
    RolloutHits hits;  ///< that are known: counts go on from those before
    struct Place {
        std::size_t rollout = 0;  ///< in LogRollouts::requests()
        RolloutRequest request;
        TickPredicate diverged;
    };
    std::vector<Place> places;
};
struct RolloutFound {
    std::optional<std::size_t> rollout;  ///< nullopt: there is none in any of them, or `progress` ended it
    RolloutHits hits;                    ///< with those of the rollouts that were passed forward
};
/// The first of them in which there is one, as of Debugger::goToBreak(); a rollout that cannot be opened, as where no
/// robot has ground truth, has none. Error: of the text.
Expected<RolloutFound> rolloutWithBreak(const PlayedLog& log, const RolloutSearch& search, const Progress& progress);

}  // namespace mrose
