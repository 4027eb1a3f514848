#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "debug/played_log.h"
#include "debug/rollout_breaks.h"
#include "debug/rollout_rows.h"

namespace mrose {

/// The rollouts of a log that is laid over its simulation: which there are, what is known of them, which of them is
/// shown, and of which robot it is asked. Rollouts are meant by their index in requests(), robots by theirs in
/// LogWorld::robots().
class LogRollouts {
public:
    /// From when on a robot has left the real trajectory.
    struct Bound {
        DivergenceBound::At at = DivergenceBound{}.constant;
        bool fromNetwork = false;  ///< instead, from what the robot's network knows of real runs
        bool operator==(const Bound&) const = default;
    };

    /// Other ones, of another log or of this; null: no log is open. Nothing stays that is known of those before.
    void replace(PlayedLogPointer log, const RolloutPlan& plan, std::vector<RolloutRequest> requests);
    const PlayedLogPointer& log() const { return log_; }
    const LogWorld& world() const { return log_->world(); }
    const RolloutPlan& plan() const { return plan_; }
    const std::vector<RolloutRequest>& requests() const { return requests_; }
    Nanoseconds length(std::size_t rollout) const { return requests_[rollout].steps * WindowOptions{}.step; }

    const Bound& bound() const { return bound_; }
    /// Rows that are known are judged again.
    void setBound(const Bound& bound);
    DivergenceOptions divergenceOptions() const;  ///< as of the flags of `mrose compare`

    /// Nothing is known of them any more.
    void forgetRows();
    /// Of further rollouts.
    void addRows(std::span<const RolloutRow> rows);
    const std::vector<RolloutRow>& rows() const { return rows_; }  ///< of the rollouts that are done, by their indices
    std::uint64_t rowsVersion() const { return rowsVersion_; }     ///< another one: the rows have changed
    const RolloutRow* rowOf(std::size_t rollout, std::size_t robot) const;
    std::span<const RolloutRow> rowsOf(std::size_t rollout) const;
    /// As `mrose compare` has it; null: it is not yet done.
    const Comparison* comparison() const { return comparison_.get(); }
    void setComparison(Comparison comparison);

    /// The one that is shown; nullopt: none is.
    std::optional<std::size_t> shown() const { return shown_; }
    void setShown(std::optional<std::size_t> rollout) { shown_ = rollout; }
    bool showsLast() const { return shown_ && *shown_ + 1 == requests_.size(); }
    /// The robot that is asked about: the one that was set, otherwise that which is farthest off. nullopt: no rollout
    /// is shown, or nothing is known of it yet.
    std::optional<std::size_t> robot() const;
    void setRobot(std::optional<std::size_t> robot) { robot_ = robot; }
    std::optional<std::size_t> robotSet() const { return robot_; }
    const RolloutRow* shownRow() const;
    /// Of the shown rollout the robot that leaves the real trajectory: the one that is asked about, otherwise the one
    /// that leaves first. null: none does.
    const RolloutRow* leavingRow() const;
    /// The same of one that leaves at an instant since the start.
    const RolloutRow* leavingAt(const std::function<bool(Nanoseconds time)>& isThen) const;
    /// Of all rollouts the robot with the largest mean error that leaves it; null: none does.
    const RolloutRow* worstLeft() const;
    /// The next rollout after the shown one, after the last the first, in which a robot leaves.
    std::optional<std::size_t> nextLeft() const;

    /// At the end of one the next one begins.
    bool restarts() const { return restarts_; }
    void setRestarts(bool on) { restarts_ = on; }
    /// Whether the rollouts follow each other.
    bool follow() const { return restarts_ && plan_.cut == RolloutPlan::Cut::every; }
    /// What breakpoints are to look for in those after the shown one, or before it. `hits`: that are known.
    RolloutSearch searchOthers(const BreakWish& wish, std::vector<Breakpoint> breakpoints,
                               const RolloutHits& hits) const;

private:
    void changed() { ++rowsVersion_; }

    PlayedLogPointer log_;
    RolloutPlan plan_;
    std::vector<RolloutRequest> requests_;
    Bound bound_;
    std::vector<RolloutRow> rows_;
    std::uint64_t rowsVersion_ = 0;
    std::shared_ptr<const Comparison> comparison_;
    std::optional<std::size_t> shown_, robot_;
    bool restarts_ = true;
};

}  // namespace mrose
