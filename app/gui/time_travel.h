#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "experiment/touch_counter.h"
#include "io/error.h"
#include "pose_track.h"
#include "recording/history.h"
#include "recording/playback.h"
#include "widgets/field_frame.h"
#include "widgets/timeline_mark.h"

namespace mrose::gui {

/// A run and its branches, gone through in both directions. It knows no window, no thread and no clock: the session
/// (session.h) drives it, and so can a test.
class TimeTravel {
public:
    TimeTravel(std::shared_ptr<const Scenario> scenario, const WorldState& start);

    const std::shared_ptr<const Scenario>& scenario() const { return scenario_; }
    const WorldState& state() const { return at_.state; }
    std::int64_t tick() const { return at_.state.tick; }
    std::uint32_t branch() const { return branch_; }
    const std::vector<Branch>& branches() const { return history_.branches(); }
    std::int64_t first() const { return timeline().first(); }
    std::int64_t last() const { return timeline().last(); }
    const std::vector<TimelineMark>& marks() const { return known_[branch_].marks; }
    /// Why the last tick asks to stop here; empty: it does not.
    const std::string& breakReason() const { return breakReason_; }

    /// One tick on: along the branch where it has been before, otherwise into what has not yet happened.
    Expected<void> forward();
    /// To a tick of the shown branch between first() and last(), or the nearest of them.
    Expected<void> seek(std::int64_t tick);
    /// To a tick of another branch.
    Expected<void> show(std::uint32_t branch, std::int64_t tick);

    /// A branch at the shown tick that begins with the state as `change` makes it; shown from now on.
    void branchOff(const std::string& name, const std::function<void(const Scenario&, WorldState&)>& change);
    void rename(std::uint32_t branch, const std::string& name);
    /// From a branch's beginning back to where it departed, and again there; false where there is nothing.
    bool undo();
    bool redo();

    struct FrameOptions {
        std::size_t trailTicks = 500;
        Nanoseconds ahead = 2 * nanosecondsPerSecond;
        std::size_t mostBodiesAhead = 64;  ///< of more no path is predicted
        bool ghosts = true;
    };
    FieldFrame frame(const FrameOptions& options) const;
    FieldFrame frame() const { return frame(FrameOptions{}); }

private:
    /// What is known of a branch beside its timeline.
    struct Known {
        PoseTrack track;
        std::vector<TimelineMark> marks;
        TouchCounter touches;
        WorldState end;  ///< at its last tick
    };
    const Timeline& timeline() const { return history_.branches()[branch_].timeline; }
    Expected<void> walk(std::uint32_t branch, std::int64_t from, std::int64_t to);
    void followWithParent();
    void learn(std::uint32_t branch, const WorldState& after, const StepTrace& trace);
    void note(const StepTrace& trace);
    void forgetNotes();
    void addTrails(std::uint32_t branch, std::int64_t tick, std::size_t ticks, Trails& trails) const;
    std::vector<std::vector<Pose>> predictedPaths(Nanoseconds ahead) const;
    std::vector<Ghost> ghostsAt(std::size_t trailTicks) const;

    std::shared_ptr<const Scenario> scenario_;
    History history_;
    Playback playback_;
    std::vector<Known> known_;  ///< of each branch
    ReachedState at_;
    std::uint32_t branch_ = 0;
    std::vector<std::uint32_t> undone_;
    StepTrace trace_;
    StepBuffers buffers_;
    std::int64_t lookBack_ = 0;  ///< ticks in which every robot decided once

    // What the last ticks told of the shown state.
    std::vector<RobotInsight> insights_;
    struct SeenKick {
        std::int64_t tick;
        StepTrace::Kicked kick;
    };
    std::vector<SeenKick> kicks_;
    bool hasTrace_ = false;
    std::string breakReason_;
};

}  // namespace mrose::gui
