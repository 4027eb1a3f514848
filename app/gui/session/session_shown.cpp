// What a session reports to the window.
#include <algorithm>
#include <iterator>
#include <utility>

#include "session/session.h"

namespace mrose::gui {
namespace {

using Marks = std::shared_ptr<const std::vector<TimelineMark>>;

Marks withHits(const Marks& happened, const std::vector<TimelineMark>& hits) {
    if (hits.empty()) return happened;
    std::vector<TimelineMark> all;
    std::merge(happened->begin(), happened->end(), hits.begin(), hits.end(), std::back_inserter(all),
               [](const TimelineMark& a, const TimelineMark& b) { return a.tick < b.tick; });
    return std::make_shared<const std::vector<TimelineMark>>(std::move(all));
}

}  // namespace

void Session::publish() {
    auto what = std::make_shared<Shown>(shownOf(*run_, frameOptions_));
    what->run = runNumber_;
    what->goal = goal_;
    what->subject = std::exchange(subject_, std::nullopt);
    std::size_t known = 0;  // marks of branches never grow but at their ends
    for (std::uint32_t i = 0; i < run_->branches().size(); ++i) known += run_->record(i).marks().size();
    const bool others = !happened_ || marksOf_ != run_->branch() || marksKnown_ != known;
    if (others) happened_ = std::make_shared<const std::vector<TimelineMark>>(run_->marks());
    if (!marks_ || others || marksBreaks_ != breakpoints_.version())
        marks_ = withHits(happened_, breakpoints_.marks(*run_));
    marksOf_ = run_->branch();
    marksKnown_ = known;
    marksBreaks_ = breakpoints_.version();
    what->marks = marks_;
    what->breakpoints = breakpoints_.states(*run_, *happened_);
    what->atBreak = atBreak_;
    what->event = std::exchange(event_, RunEvent::none);
    what->canDiverge = breakpoints_.canDiverge();
    what->playing = playing_;
    what->realTimeFactor = factor_;
    what->message = message_;
    const std::lock_guard lock(mutex_);
    // What has not been shown yet must not get lost.
    if (ready_ && !what->subject) what->subject = ready_->subject;
    if (ready_ && ready_->run == what->run && what->event == RunEvent::none) what->event = ready_->event;
    ready_ = std::move(what);
    if (std::exchange(deliveryPending_, true)) return;
    QMetaObject::invokeMethod(this, &Session::deliver, Qt::QueuedConnection);
}

void Session::deliver() {
    std::shared_ptr<const Shown> what;
    {
        const std::lock_guard lock(mutex_);
        deliveryPending_ = false;
        what = std::exchange(ready_, nullptr);
    }
    if (what) emit shown(std::move(what));
}

}  // namespace mrose::gui
