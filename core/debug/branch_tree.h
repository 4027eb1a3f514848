#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "debug/branch_record.h"
#include "debug/branch_setup.h"
#include "debug/cursor.h"
#include "debug/opened_run.h"
#include "debug/tick_ranges.h"
#include "debug/timeline_mark.h"
#include "io/error.h"
#include "recording/history.h"

namespace mrose {

/// What a branch begins with.
struct NewBranch {
    BranchSetupPointer setup;
    WorldState state;
    std::vector<HandOrder> orders = {};
    std::vector<BranchRecord::InsightAtStart> insightsAtStart = {};
};

/// Whether robots can go on in one scenario with what they remember in the other.
bool sameMemories(const Scenario& one, const Scenario& other);

/// A run and what became of it, and all that is known of it. A branch's lineage is its own ticks and, before it
/// departed, those of the branches that it came from. Branches never change but grow; the run itself is branch 0.
class BranchTree {
public:
    /// Of `mostTrackBytes` all branches together keep where bodies were, for trails and ghosts; of the largest track
    /// the earliest ticks are forgotten.
    BranchTree(const OpenedRun& run, std::size_t mostTrackBytes);

    std::size_t size() const { return records_.size(); }
    const Branch& operator[](std::uint32_t branch) const { return history_.branches()[branch]; }
    const BranchRecord& record(std::uint32_t branch) const { return records_[branch]; }
    std::int64_t first(std::uint32_t branch) const;  ///< of its lineage
    std::int64_t last(std::uint32_t branch) const { return (*this)[branch].timeline.last(); }
    /// Whose tick that is in a branch's lineage.
    std::uint32_t owner(std::uint32_t branch, std::int64_t tick) const;
    bool isFrom(std::uint32_t branch, std::uint32_t ancestor) const;  ///< or is the same
    bool hasBegun(std::uint32_t branch) const;                        ///< it has more than the state at its start
    /// It departs from a tick of its parent, and its robots go on with what they remember there.
    bool follows(std::uint32_t branch) const;

    /// What a branch's lineage consists of, in the order of time.
    std::vector<BranchTicks> parts(std::uint32_t branch) const;
    /// What happened in a branch's lineage, in the order of time.
    std::vector<TimelineMark> marks(std::uint32_t branch) const;
    /// Of a branch's lineage up to a tick, each text of a robot once; the branch's own first.
    std::vector<BranchRecord::FirstFault> faults(std::uint32_t branch, std::int64_t until) const;
    /// Where all bodies were at a tick of a branch's lineage; nullopt where that is forgotten or not yet looked at.
    std::optional<std::vector<Pose>> posesAt(std::uint32_t branch, std::int64_t tick) const;

    /// To one of a branch's own ticks, or the nearest of them.
    Expected<Cursor> cursorAt(std::uint32_t branch, std::int64_t tick) const;
    /// The same of a branch's lineage, which begins with ticks of those that it came from.
    Expected<Cursor> lineageAt(std::uint32_t branch, std::int64_t tick) const;
    /// One tick on in a branch's lineage, where it has been.
    Expected<void> advance(Cursor& cursor, std::uint32_t branch) const;

    std::size_t memory() const { return history_.size(); }  ///< bytes of the timelines, roughly
    std::size_t trackBytes() const;

    /// A new branch; its index.
    std::uint32_t begin(std::uint32_t parent, const std::string& name, NewBranch start);
    void rename(std::uint32_t branch, const std::string& name) { history_.rename(branch, name); }
    /// One tick beyond the end of a branch, where the cursor stands. What would have happened, in its parent, goes on
    /// as far.
    void simulate(Cursor& cursor);
    /// A branch goes on up to a tick, but by so many ticks at the most.
    void goOn(std::uint32_t branch, std::int64_t tick, std::int64_t most);

    /// Of branches that came from a file: looks at so many of their ticks for trails and marks; whether there are more.
    Expected<bool> learn(std::int64_t ticks);
    /// The same of a branch's lineage, up to a tick.
    Expected<void> learnUpTo(std::uint32_t branch, std::int64_t tick);

private:
    /// Its lineage begins with ticks of its parent's.
    bool departs(std::uint32_t branch) const;
    Expected<void> walk(Cursor& cursor, std::uint32_t branch, std::int64_t from, std::int64_t to) const;
    void takeOver(std::uint32_t branch);
    void keepTracksSmall();

    History history_;
    std::deque<BranchRecord> records_;  ///< of each branch
    std::size_t mostTrackBytes_;
    StepBuffers buffers_;
};

}  // namespace mrose
