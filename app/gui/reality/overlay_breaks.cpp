// Breakpoints and the rollouts of an overlay.
#include <algorithm>

#include "files/window_files.h"
#include "frame/actions.h"
#include "frame/status_line.h"
#include "reality/overlay.h"
#include "session/session.h"
#include "widgets/field_view.h"
#include "widgets/qt_text.h"
#include "workflow/rollout_breaks.h"

namespace mrose::gui {

std::span<const OverlayRow> Overlay::rowsOf(std::size_t rollout) const {
    const auto [begin, end] =
        std::equal_range(rows_.begin(), rows_.end(), OverlayRow{rollout},
                         [](const OverlayRow& a, const OverlayRow& b) { return a.rollout < b.rollout; });
    return {begin, end};
}

void Overlay::reportDivergences() {
    emit divergencesChanged();
    if (!world_) return frame_.session.changeBreakpoints([](Breakpoints& all) { all.setDivergence({}); });
    if (!shownRollout_ || !frame_.session.current()) return;
    LeavingRobots leaving = leavingRobots(world_->world(), rowsOf(*shownRollout_));
    leaving.reality = reality_;
    leaving.compared = compared_;
    frame_.session.changeBreakpoints([leaving](Breakpoints& all) {
        all.setDivergence({leavesReality(leaving), whoLeaves(leaving)});
    });
    reportHits(*shownRollout_);
}

void Overlay::select(std::size_t robot) {
    const std::uint32_t body =
        bodyNamed(frame_.session.current()->frame->scene(), world_->world().robots()[robot].name);
    if (body != noBody) field_.setSelected(body);
    setRobot(robot);
}

/// Of the robot that is asked about; where that stays, of the one that leaves first.
bool Overlay::goToDivergence() {
    if (!shownRollout_ || frame_.session.current() == nullptr) return false;
    const OverlayRow* leaves = shownRow();
    if (leaves == nullptr || !leaves->divergence) {
        const auto rows = rowsOf(*shownRollout_);
        const auto first = std::min_element(rows.begin(), rows.end(), [](const OverlayRow& a, const OverlayRow& b) {
            return a.divergence && (!b.divergence || a.divergence->time < b.divergence->time);
        });
        if (first == rows.end() || !first->divergence) return goToOtherDivergence();
        leaves = &*first;
    }
    select(leaves->robot);
    if (field_.showsAll() || isAside()) showNear();
    const std::int64_t tick = frame_.session.current()->frame->scene().ticksOf(leaves->divergence->time);
    frame_.session.seek(tick, false);
    return true;
}

/// In the shown rollout there is none.
bool Overlay::goToOtherDivergence() {
    for (std::size_t i = 1; i < requests_.size(); ++i) {
        const std::size_t rollout = (*shownRollout_ + i) % requests_.size();
        const auto rows = rowsOf(rollout);
        if (std::none_of(rows.begin(), rows.end(), [](const OverlayRow& row) { return row.divergence.has_value(); }))
            continue;
        frame_.status.say(tr("Nothing leaves the real trajectory in the one before; in this it does"));
        Then then;
        then.toDivergence = true;
        return show(rollout, {}, then);
    }
    return false;
}

/// A breakpoint stopped the run: where that is because a robot leaves the real trajectory, it is the one to be asked
/// about.
void Overlay::showLeaving() {
    if (!shownRollout_ || frame_.session.current()->run != run_ || frame_.session.current()->branch != compared_)
        return;
    const auto leavesHere = [&](const OverlayRow& row) {
        return row.divergence && frame_.session.current()->frame->scene().ticksOf(row.divergence->time) ==
                                     frame_.session.current()->tick();
    };
    const OverlayRow* const asked = shownRow();
    if (asked == nullptr || !leavesHere(*asked)) {
        const auto rows = rowsOf(*shownRollout_);
        const auto leaving = std::find_if(rows.begin(), rows.end(), leavesHere);
        if (leaving == rows.end()) return;
        select(leaving->robot);
    }
    if (isAside()) showNear();
}

bool Overlay::rolloutsFollow() const { return restarts_ && plan_.cut == OverlayPlan::Cut::every; }

/// Whether the window shows one of the rollouts that follow each other.
bool Overlay::inRollouts() const { return rolloutsFollow() && shownRollout_ && frame_.session.current()->run == run_; }

/// What the shown rollout knows of them.
void Overlay::learnHits() {
    if (inRollouts()) hits_.learn(*shownRollout_, frame_.session.current()->breakpoints);
}

/// What the rollouts before one and after it know of them.
void Overlay::reportHits(std::size_t rollout) {
    const HitsInOtherRuns met = rolloutsFollow() ? hits_.elsewhere(rollout) : HitsInOtherRuns{};
    frame_.session.changeBreakpoints([met](Breakpoints& all) { all.setHitsInOtherRuns(met); });
}

bool Overlay::atRolloutEnd() const {
    const Shown& shown = *frame_.session.current();
    const Nanoseconds end = requests_[*shownRollout_].steps * WindowOptions{}.step;
    return shown.tick() >= shown.frame->scene().ticksOf(end);
}

bool Overlay::isLastRollout() const { return *shownRollout_ + 1 == requests_.size(); }

void Overlay::sayLogEnds() {
    reportedEnd_ = run_;
    frame_.status.say(tr("The last rollout of the log is over; it can go on"));
}

bool Overlay::playsNext() {
    const Shown* const shown = frame_.session.current();
    if (shown == nullptr || !inRollouts() || opening() || shown->branch != 0 || !atRolloutEnd()) return false;
    const Nanoseconds end = requests_[*shownRollout_].steps * WindowOptions{}.step;
    if (shown->tick() > shown->frame->scene().ticksOf(end)) return false;
    Then on;
    on.play = true;
    if (!isLastRollout()) return !files_.hasUnsaved() && showNext(1, on);
    if (reportedEnd_ == run_) return false;
    sayLogEnds();
    return true;
}

void Overlay::goToBreak(const BreakWish& wish) {
    stopSearching();
    wish_ = wish;
    if (frame_.session.current() != nullptr && inRollouts() && !wish.back && atRolloutEnd()) return lookInRollouts();
    const bool within = frame_.session.current() != nullptr && inRollouts();
    frame_.session.goToBreak(wish, within ? BreakReach::within : BreakReach::on);
}

void Overlay::stopSearching() {
    wish_.reset();
    if (!searching_.busy()) return;
    searching_.drop();
    emit searching({}, 1);
}

/// There is none in the shown rollout: in those after it, or before it.
void Overlay::lookInRollouts() {
    if (!wish_) return;
    learnHits();
    RolloutSearch search{*wish_, {}, hits_, {}};
    wish_.reset();
    if (files_.hasUnsaved())
        return frame_.status.say(
            tr("This rollout has branches that are not saved: the other rollouts are not looked through"));
    const std::size_t shown = *shownRollout_, count = requests_.size();
    bool diverges = search.wish.text == "divergence";
    for (const BreakpointState& state : frame_.session.current()->breakpoints) {
        search.breakpoints.push_back(state.breakpoint);
        diverges = diverges || (state.breakpoint.enabled && state.breakpoint.text == "divergence");
    }
    if (diverges && share_ < 1)
        return frame_.status.say(
            tr("The other rollouts are still being compared: where they leave the log is known then"));
    for (std::size_t i = 1; i <= (search.wish.back ? shown : count - 1 - shown); ++i) {
        const std::size_t rollout = search.wish.back ? shown - i : shown + i;
        search.places.push_back(
            {rollout, requests_[rollout], leavesReality(leavingRobots(world_->world(), rowsOf(rollout)))});
    }
    const QString none = search.wish.back ? tr("No break in this rollout up to here, nor in those before it")
                                          : tr("No break in the rest of this rollout, nor in those after it");
    if (search.places.empty()) return frame_.status.say(none);
    const QString what = tr("Looking for a break in the other rollouts");
    const auto job = [this, world = world_, search, none, what](const JobQueue::GoesOn& goesOn) -> JobQueue::Answer {
        const auto progress = [&](double share) {
            searching_.report([this, what, share] { emit searching(what, share); });
            return goesOn();
        };
        const auto found = rolloutWithBreak(*world, search, progress);
        return [this, found, wish = search.wish, none, what] {
            emit searching(what, 1);
            if (!found) return frame_.status.say(qtText(found.error().message()));
            hits_ = found->hits;
            if (!found->rollout) return reportHits(*shownRollout_), frame_.status.say(none);
            Then then;
            then.look = wish;
            show(*found->rollout, {}, then);
        };
    };
    searching_.post(job, [this, what](const Error& error) {
        emit searching(what, 1);
        sayError(error);
    });
}

}  // namespace mrose::gui
