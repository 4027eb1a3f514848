#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "scenario/scenario.h"
#include "simulation/step.h"
#include "world/state_hash.h"
#include "world/world_state.h"

namespace mrose {

/// Whether a state is the one that was, by its hashes.
struct SameHashes {
    bool world = true, memories = true;
};

/// Some ticks in a row: what was decided in each, the hashes of the state after it, and the state that they begin with,
/// if it is kept. Its size is about 130 bytes a control period and robot, and that of the state.
struct TimelineBlock {
    std::int64_t first = 0;         ///< tick of the state that it begins with
    std::string keyframe;           ///< that state as bytes (state_bytes.h); may be empty
    std::vector<StateHash> hashes;  ///< of the states at first + 1, first + 2 ...
    std::string decisions;          ///< of the ticks that lead there (decision_bytes.h)
    /// So many of the hashes, the first ones, are those of the states' first version: a recording of then goes on.
    std::size_t firstVersion = 0;

    std::int64_t last() const { return first + static_cast<std::int64_t>(hashes.size()); }
    void add(const StateHash& after, const StepTrace& trace);
    /// Compares a state of the scenario, first < state.tick <= last().
    SameHashes compare(const Scenario& scenario, const WorldState& state) const;
    std::size_t size() const { return keyframe.size() + hashes.size() * sizeof(StateHash) + decisions.size(); }
};

/// A run without a gap, so that each of its states can be reached again: every so often the state itself, and all
/// decisions and hashes.
class Timeline {
public:
    /// Begins with a state; 0: an interval by which any tick is reached within some 5 ms.
    explicit Timeline(const WorldState& start, std::int64_t keyframeInterval = 0);
    /// Begins with a block of a file, which must have a keyframe. What add() appends is kept as above.
    explicit Timeline(TimelineBlock first, std::int64_t keyframeInterval = 0);

    /// One tick more: the state after it and its trace.
    void add(const WorldState& after, const StepTrace& trace);
    void add(const WorldState& after, const StepTrace& trace, const StateHash& hash);
    /// Ticks of a file, which must go on where this ends: false otherwise.
    bool append(TimelineBlock block);

    std::int64_t first() const { return blocks_.front().first; }  ///< the earliest tick that can be reached
    std::int64_t last() const { return blocks_.back().last(); }
    /// Of the state at a tick, first() < tick <= last().
    const StateHash& hashAt(std::int64_t tick) const;
    /// The one whose keyframe is the latest not after `tick`.
    const TimelineBlock& blockOf(std::int64_t tick) const;
    const std::deque<TimelineBlock>& blocks() const { return blocks_; }

    std::size_t size() const { return size_; }  ///< bytes of memory, roughly
    /// Forgets the earliest ticks, as many as lie between two keyframes; false where no others would be left.
    bool forgetEarliest();

private:
    std::deque<TimelineBlock> blocks_;
    std::size_t size_ = 0;
    std::int64_t interval_ = 0;
};

/// Ticks between keyframes: as many as take about 5 ms to step again, whose number shrinks with the bodies'.
std::int64_t usualKeyframeInterval(const WorldState& state);

}  // namespace mrose
