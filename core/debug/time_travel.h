#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "debug/branch_tree.h"
#include "debug/edit.h"

namespace mrose {

/// A place in a run and its branches, which goes through them in both directions, and where edits begin branches. A
/// debugger (debugger.h) drives it.
class TimeTravel {
public:
    explicit TimeTravel(const OpenedRun& run, std::size_t mostTrackBytes = std::size_t{64} << 20);

    const BranchTree& branches() const { return branches_; }
    BranchTree& branches() { return branches_; }

    const Cursor& cursor() const { return shown_; }  ///< the shown tick
    const WorldState& state() const { return shown_.state(); }
    std::int64_t tick() const { return shown_.tick(); }
    std::uint32_t branch() const { return branch_; }
    /// The one that the shown tick belongs to: branch(), or one that it came from.
    std::uint32_t owner() const { return shown_.branch(); }
    const BranchSetup& setup() const { return branches_.record(owner()).setup(); }
    std::int64_t first() const { return branches_.first(branch_); }
    std::int64_t last() const { return branches_.last(branch_); }
    /// What is known of the shown tick; valid until the next.
    Moment moment() const { return shown_.moment(*setup().scenario, reality_.get()); }

    /// One tick on: along the branch where it has been simulated before, otherwise beyond that.
    Expected<void> forward();
    /// To a tick of the shown branch between first() and last(), or the nearest of them.
    Expected<void> seek(std::int64_t tick) { return show(branch(), tick); }
    /// To a tick of another branch's lineage.
    Expected<void> show(std::uint32_t branch, std::int64_t tick);

    /// A branch that begins with what an edit makes of a state; shown from now on. What is changed where a branch
    /// begins, before anything has happened in it, goes together with what it began with: the new branch takes its
    /// place. Error: its tick cannot be reached, or the state does not fit; then nothing has changed.
    Expected<void> branchOff(const Edit& edit);
    /// A branch and all that departed from it are no more listed, saved or shown as ghosts; if the shown one is among
    /// them, its parent is shown. The run itself stays. False: there is no such branch.
    bool remove(std::uint32_t branch);
    std::size_t removeOthers();  ///< all but what the shown one came from; how many
    std::size_t restore();       ///< all that was removed, or undone and then left; how many
    /// From a branch back to where one stood before its last edit, and again there; false where there is nothing.
    bool undo();
    bool redo();
    /// How a branch came about.
    struct Origin {
        std::string edit;                               ///< empty: the run itself
        std::uint32_t from = 0;                         ///< the branch on which one stood
        std::int64_t stood = 0;                         ///< and the tick
        std::int64_t arrived = 0;                       ///< the tick that shows its effect
        std::optional<std::uint32_t> replaced = {};     ///< whose place it took: one with fewer edits at its beginning
        std::optional<std::uint32_t> replacement = {};  ///< which took its place
        bool removed = false;
    };
    const Origin& origin(std::uint32_t branch) const { return origins_[branch]; }
    bool undone(std::uint32_t branch) const;  ///< redo() makes it again
    const Origin* lastUndone() const;         ///< what redo() makes again; null: nothing
    /// Removed, or undone before the last edit, or another one took its place before anything happened in it: kept for
    /// restore() or undo() alone.
    bool hidden(std::uint32_t branch) const;

    /// Another branch to be shown beside, at the same tick; nullopt: none. Of itself it is the one shown before.
    void setBeside(std::optional<std::uint32_t> branch);
    std::optional<std::uint32_t> beside() const;
    const Cursor* besideCursor() const { return beside_ ? &beside_->at : nullptr; }  ///< at it or the nearest

    /// What computed the recording that was opened; nullopt: all is of this program.
    const std::optional<mrose::Origin>& recordedBy() const { return recordedBy_; }

    /// What really happened beside it; null: not known.
    const std::shared_ptr<const Reality>& reality() const { return reality_; }
    void setReality(std::shared_ptr<const Reality> reality) { reality_ = std::move(reality); }

private:
    bool mergesInto(const Edit& edit) const;
    bool superseded(std::uint32_t branch) const;
    std::string freeName(const std::string& name) const;
    void followBeside();

    BranchTree branches_;
    std::uint32_t branch_ = 0;
    Cursor shown_;  ///< in the branch's lineage
    struct Beside {
        std::uint32_t branch;
        Cursor at;
    };
    std::optional<Beside> beside_;
    std::optional<mrose::Origin> recordedBy_;
    std::shared_ptr<const Reality> reality_;
    std::vector<Origin> origins_;  ///< of each branch
    std::vector<std::uint32_t> undone_;
};

}  // namespace mrose
