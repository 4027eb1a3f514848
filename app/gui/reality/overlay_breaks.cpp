// Breakpoints and the courses of an overlay.
#include <algorithm>

#include "files/window_files.h"
#include "reality/course_breaks.h"
#include "reality/overlay.h"
#include "reality/overlay_marks.h"
#include "widgets/field_view.h"
#include "widgets/value_catalogue.h"
#include "window/main_window.h"

namespace mrose::gui {

std::span<const OverlayRow> Overlay::rowsOf(std::size_t course) const {
    const auto [begin, end] =
        std::equal_range(rows_.begin(), rows_.end(), OverlayRow{course},
                         [](const OverlayRow& a, const OverlayRow& b) { return a.course < b.course; });
    return {begin, end};
}

void Overlay::tellDivergences() {
    markDivergences(window_, *this);
    if (!world_) return window_.session().setDivergence({});
    if (!shownCourse_ || !window_.shown()) return;
    LeavingRobots leaving = leavingRobots(world_->world(), rowsOf(*shownCourse_));
    leaving.reality = reality_;
    leaving.compared = compared_;
    window_.session().setDivergence({leavesReality(leaving), whoLeaves(leaving)});
    tellHits(*shownCourse_);
}

void Overlay::select(std::size_t robot) {
    const std::uint32_t body = bodyNamed(window_.shown()->frame->scene(), world_->world().robots()[robot].name);
    if (body != noBody) window_.field().setSelected(body);
    setRobot(robot);
}

/// Of the robot that is asked about; where that stays, of the one that leaves first.
bool Overlay::goToDivergence() {
    if (!shownCourse_ || window_.shown() == nullptr) return false;
    const OverlayRow* leaves = shownRow();
    if (leaves == nullptr || !leaves->divergence) {
        const auto rows = rowsOf(*shownCourse_);
        const auto first = std::min_element(rows.begin(), rows.end(), [](const OverlayRow& a, const OverlayRow& b) {
            return a.divergence && (!b.divergence || a.divergence->time < b.divergence->time);
        });
        if (first == rows.end() || !first->divergence) return goToOtherDivergence();
        leaves = &*first;
    }
    select(leaves->robot);
    if (window_.field().showsAll() || isAside()) showNear();
    const std::int64_t tick = window_.shown()->frame->scene().ticksOf(leaves->divergence->time);
    window_.session().seek(tick, false);
    return true;
}

/// In the shown course there is none.
bool Overlay::goToOtherDivergence() {
    for (std::size_t i = 1; i < requests_.size(); ++i) {
        const std::size_t course = (*shownCourse_ + i) % requests_.size();
        const auto rows = rowsOf(course);
        if (std::none_of(rows.begin(), rows.end(), [](const OverlayRow& row) { return row.divergence.has_value(); }))
            continue;
        window_.say(tr("Nothing leaves the real course in the one before; in this it does"));
        Then then;
        then.toDivergence = true;
        return show(course, {}, then);
    }
    return false;
}

/// A breakpoint stopped the run: where that is because a robot leaves the real course, it is the one to be asked about.
void Overlay::showLeaving() {
    if (!shownCourse_ || window_.shown()->run != run_ || window_.shown()->branch != compared_) return;
    const auto leavesHere = [&](const OverlayRow& row) {
        return row.divergence &&
               window_.shown()->frame->scene().ticksOf(row.divergence->time) == window_.shown()->tick();
    };
    const OverlayRow* const asked = shownRow();
    if (asked == nullptr || !leavesHere(*asked)) {
        const auto rows = rowsOf(*shownCourse_);
        const auto leaving = std::find_if(rows.begin(), rows.end(), leavesHere);
        if (leaving == rows.end()) return;
        select(leaving->robot);
    }
    if (isAside()) showNear();
}

bool Overlay::coursesFollow() const { return restarts_ && plan_.cut == OverlayPlan::Cut::every; }

/// Whether the window shows one of the courses that follow each other.
bool Overlay::inCourses() const { return coursesFollow() && shownCourse_ && window_.shown()->run == run_; }

/// What the shown course knows of them.
void Overlay::learnHits() {
    if (inCourses()) hits_.learn(*shownCourse_, window_.shown()->breakpoints);
}

/// What the courses before one and after it know of them.
void Overlay::tellHits(std::size_t course) {
    window_.session().setMetElsewhere(coursesFollow() ? hits_.elsewhere(course) : MetElsewhere{});
}

bool Overlay::atCourseEnd() const {
    const Shown& shown = *window_.shown();
    const Nanoseconds end = requests_[*shownCourse_].steps * WindowOptions{}.step;
    return shown.tick() >= shown.frame->scene().ticksOf(end);
}

bool Overlay::isLastCourse() const { return *shownCourse_ + 1 == requests_.size(); }

void Overlay::sayLogEnds() {
    toldEnd_ = run_;
    window_.say(tr("The last course of the log is over; it can go on"));
}

bool Overlay::playsNext() {
    const Shown* const shown = window_.shown();
    if (shown == nullptr || !inCourses() || opening() || shown->branch != 0 || !atCourseEnd()) return false;
    const Nanoseconds end = requests_[*shownCourse_].steps * WindowOptions{}.step;
    if (shown->tick() > shown->frame->scene().ticksOf(end)) return false;
    Then on;
    on.play = true;
    if (!isLastCourse()) return !window_.files().hasUnsaved() && showNext(1, on);
    if (toldEnd_ == run_) return false;
    sayLogEnds();
    return true;
}

void Overlay::goToBreak(const BreakWish& wish) {
    stopSearching();
    wish_ = wish;
    if (window_.shown() != nullptr && inCourses() && !wish.back && atCourseEnd()) return lookInCourses();
    const bool within = window_.shown() != nullptr && inCourses();
    window_.session().goToBreak(wish, within ? Session::BreakReach::within : Session::BreakReach::on);
}

void Overlay::stopSearching() {
    wish_.reset();
    if (!searching_.busy()) return;
    searching_.drop();
    emit searching({}, 1);
}

/// There is none in the shown course: in those after it, or before it.
void Overlay::lookInCourses() {
    if (!wish_) return;
    learnHits();
    CourseSearch search{*wish_, {}, hits_, {}};
    wish_.reset();
    if (window_.files().hasUnsaved())
        return window_.say(tr("This course has branches that are not saved: the other courses are not looked through"));
    const std::size_t shown = *shownCourse_, count = requests_.size();
    bool diverges = search.wish.text == "divergence";
    for (const BreakpointState& state : window_.shown()->breakpoints) {
        search.breakpoints.push_back(state.breakpoint);
        diverges = diverges || (state.breakpoint.enabled && state.breakpoint.text == "divergence");
    }
    if (diverges && share_ < 1)
        return window_.say(tr("The other courses are still being compared: where they leave the log is known then"));
    for (std::size_t i = 1; i <= (search.wish.back ? shown : count - 1 - shown); ++i) {
        const std::size_t course = search.wish.back ? shown - i : shown + i;
        search.places.push_back(
            {course, requests_[course], leavesReality(leavingRobots(world_->world(), rowsOf(course)))});
    }
    const QString none = search.wish.back ? tr("No break in this course up to here, nor in those before it")
                                          : tr("No break in the rest of this course, nor in those after it");
    if (search.places.empty()) return window_.say(none);
    const QString what = tr("Looking for a break in the other courses");
    const auto job = [this, world = world_, search, none, what](const JobQueue::GoesOn& goesOn) -> JobQueue::Answer {
        const auto progress = [&](double share) {
            searching_.tell([this, what, share] { emit searching(what, share); });
            return goesOn();
        };
        const auto found = courseWithBreak(*world, search, progress);
        return [this, found, wish = search.wish, none, what] {
            emit searching(what, 1);
            if (!found) return window_.say(QString::fromStdString(found.error().message()));
            hits_ = found->hits;
            if (!found->course) return tellHits(*shownCourse_), window_.say(none);
            Then then;
            then.look = wish;
            show(*found->course, {}, then);
        };
    };
    searching_.post(job, [this, what](const Error& error) {
        emit searching(what, 1);
        sayError(error);
    });
}

}  // namespace mrose::gui
