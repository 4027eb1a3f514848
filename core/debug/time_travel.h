#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "debug/branch_record.h"
#include "debug/branch_setup.h"
#include "debug/cursor.h"
#include "debug/edit.h"
#include "debug/field_frame.h"
#include "debug/open_run.h"
#include "debug/timeline_mark.h"
#include "io/error.h"
#include "recording/history.h"

namespace mrose {

/// A run and its branches, gone through in both directions. A branch's lineage is its own ticks and, before it
/// departed, those of the branches that it came from. A debugger (debugger.h)
/// drives it.
class TimeTravel {
public:
    /// Of `mostTrackBytes` all branches together keep where bodies were, for trails and ghosts; of the largest track
    /// the earliest ticks are forgotten.
    explicit TimeTravel(const OpenRun& run, std::size_t mostTrackBytes = std::size_t{64} << 20);

    const WorldState& state() const { return shown_.state(); }
    std::int64_t tick() const { return shown_.tick(); }
    std::uint32_t branch() const { return branch_; }
    /// The one that the shown tick belongs to: branch(), or one that it came from.
    std::uint32_t owner() const { return shown_.branch(); }
    const std::vector<Branch>& branches() const { return history_.branches(); }
    const BranchRecord& record(std::uint32_t branch) const { return records_[branch]; }
    const BranchSetup& setup() const { return records_[owner()].setup(); }
    std::int64_t first() const { return firstOf(branch_); }
    std::int64_t last() const { return lastOf(branch_); }
    std::int64_t firstOf(std::uint32_t branch) const;  ///< of its lineage
    std::int64_t lastOf(std::uint32_t branch) const { return timelineOf(branch).last(); }
    /// A branch's ticks in the shown branch's lineage.
    struct Part {
        std::uint32_t branch = 0;
        std::int64_t first = 0, last = 0;
    };
    /// What that lineage consists of, in the order of time.
    std::vector<Part> parts() const;
    /// What happened in the shown branch's lineage, in the order of time.
    std::vector<TimelineMark> marks() const;
    /// Of a branch's lineage up to a tick, each text of a robot once; the branch's own first.
    std::vector<BranchRecord::FirstFault> faults(std::uint32_t branch, std::int64_t until) const;
    /// Why the last tick asks to stop here; empty: it does not.
    const std::string& breakReason() const { return shown_.breakReason(); }
    /// Of the tick that led here; nullptr: none is known.
    const StepTrace* trace() const { return shown_.trace(); }
    /// What is known of the shown tick; valid until the next.
    Moment moment() const { return shown_.moment(*setup().scenario, reality_.get()); }
    std::size_t memory() const { return history_.size(); }  ///< bytes of the timelines, roughly
    std::size_t trackBytes() const;

    /// One tick on: along the branch where it has been simulated before, otherwise beyond that.
    Expected<void> forward();
    /// To a tick of the shown branch between first() and last(), or the nearest of them.
    Expected<void> seek(std::int64_t tick) { return show(branch(), tick); }
    /// To a tick of another branch's lineage.
    Expected<void> show(std::uint32_t branch, std::int64_t tick);

    /// To one of a branch's own ticks, without going there.
    Expected<Cursor> cursorAt(std::uint32_t branch, std::int64_t tick) const;
    /// The same of a branch's lineage, which begins with ticks of those that it came from.
    Expected<Cursor> lineageAt(std::uint32_t branch, std::int64_t tick) const;
    /// One tick on in a branch's lineage, where it has been.
    Expected<void> advance(Cursor& cursor, std::uint32_t branch) const;
    /// Where all bodies were at a tick of a branch's lineage; nullopt where that is forgotten or not yet looked at.
    std::optional<std::vector<Pose>> posesAt(std::uint32_t branch, std::int64_t tick) const;

    /// A branch that begins with what an edit makes of a state; shown from now on. What is changed where a branch
    /// begins, before anything has happened in it, goes together with what it began with: the new branch takes its
    /// place. Error: its tick cannot be reached, or the state does not fit; then nothing has changed.
    Expected<void> branchOff(const Edit& edit);
    void rename(std::uint32_t branch, const std::string& name) { history_.rename(branch, name); }
    /// A branch and all that departed from it are no more listed, saved or shown as ghosts; if the shown one is among
    /// them, its parent is shown. The run itself stays. False: there is no such branch.
    bool remove(std::uint32_t branch);
    std::size_t removeOthers();  ///< all but what the shown one came from; how many
    std::size_t restore();       ///< all that was removed, or undone and then left; how many
    /// From a branch back to where one stood before its last edit, and again there; false where there is nothing.
    bool undo();
    bool redo();
    bool canUndo() const { return branch() != 0; }
    bool canRedo() const { return !undone_.empty(); }
    /// The edit that undo() takes back and that redo() makes again; empty: there is none.
    std::string undoName() const { return canUndo() ? origins_[branch()].edit : ""; }
    std::string redoName() const { return canRedo() ? origins_[undone_.back()].edit : ""; }
    /// The shown branch took the place of one that had fewer edits at its beginning.
    bool edited() const { return origins_[branch()].replaced.has_value(); }
    /// Removed, or undone before the last edit, or another one took its place before anything happened in it: kept for
    /// restore() or undo() alone.
    bool hidden(std::uint32_t branch) const;
    bool undone(std::uint32_t branch) const;  ///< redo() makes it again

    /// Another branch to be shown beside, at the same tick; nullopt: none. Of itself it is the one shown before.
    void setBeside(std::optional<std::uint32_t> branch);
    std::optional<std::uint32_t> beside() const;
    const Cursor& cursor() const { return shown_; }                                  ///< the shown tick
    const Cursor* besideCursor() const { return beside_ ? &beside_->at : nullptr; }  ///< at it or the nearest

    /// What really happened beside it; null: not known.
    const std::shared_ptr<const Reality>& reality() const { return reality_; }
    void setReality(std::shared_ptr<const Reality> reality) { reality_ = std::move(reality); }

    /// Of branches that came from a file: looks at so many of their ticks for trails and marks; whether there are more.
    Expected<bool> learn(std::int64_t ticks);
    /// The same of the shown branch's lineage, up to a tick.
    Expected<void> learnUpTo(std::int64_t tick);

private:
    const Timeline& timelineOf(std::uint32_t branch) const { return history_.branches()[branch].timeline; }
    /// Its lineage begins with ticks of its parent's.
    bool departs(std::uint32_t branch) const;
    /// What robots decided in its parent is known where it begins, too.
    bool sharesMemories(std::uint32_t branch) const;
    bool begins(std::uint32_t branch) const { return timelineOf(branch).first() == timelineOf(branch).last(); }
    bool mergesInto(const Edit& edit) const;
    bool superseded(std::uint32_t branch) const;
    bool isFrom(std::uint32_t branch, std::uint32_t ancestor) const;
    std::string freeName(const std::string& name) const;
    void takeOver(std::uint32_t branch);
    void addTouches(std::uint32_t branch, std::int64_t from, std::int64_t to, TouchCounter& touches);
    std::vector<BranchRecord::InsightAtStart> insightsAtStartOf(std::uint32_t branch,
                                                                std::span<const std::uint32_t> robots);
    /// Whose tick that is in a branch's lineage.
    std::uint32_t ownerOf(std::uint32_t branch, std::int64_t tick) const;
    const std::shared_ptr<const Scenario>& scenarioOf(std::uint32_t branch) const {
        return records_[branch].setup().scenario;
    }
    Expected<void> walk(Cursor& cursor, std::uint32_t branch, std::int64_t from, std::int64_t to) const;
    void goOnWith(std::uint32_t branch, std::int64_t most);
    void followBeside();
    void keepTracksSmall();

    History history_;
    std::deque<BranchRecord> records_;  ///< of each branch
    std::size_t mostTrackBytes_;
    std::uint32_t branch_ = 0;
    Cursor shown_;  ///< in the branch's lineage
    struct Beside {
        std::uint32_t branch;
        Cursor at;
    };
    std::optional<Beside> beside_;
    std::shared_ptr<const Reality> reality_;
    /// How a branch came about.
    struct Origin {
        std::string edit;
        std::uint32_t from = 0;                         ///< the branch on which one stood
        std::int64_t stood = 0;                         ///< and the tick
        std::int64_t arrived = 0;                       ///< the tick that shows its effect
        std::optional<std::uint32_t> replaced = {};     ///< whose place it took
        std::optional<std::uint32_t> replacement = {};  ///< which took its place
        bool removed = false;
    };
    std::vector<Origin> origins_;  ///< of each branch
    std::vector<std::uint32_t> undone_;
    StepBuffers buffers_;
};

}  // namespace mrose
