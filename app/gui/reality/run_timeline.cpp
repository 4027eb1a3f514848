#include "reality/run_timeline.h"

#include <algorithm>

#include "panels/plot_panel.h"
#include "reality/overlay.h"
#include "reality/overlay_marks.h"
#include "widgets/field_view.h"
#include "widgets/qt_text.h"

namespace mrose::gui {

RunTimeline::RunTimeline(const WindowFrame& frame, TimelineBar& timeline, FieldView& field, PlotPanel& plots,
                         Overlay& overlay)
    : QObject(&frame.window), frame_(frame), timeline_(timeline), field_(field), plots_(plots), overlay_(overlay) {
    // Who scrubs is not stopped.
    connect(&timeline, &TimelineBar::tickRequested, this,
            [this](std::int64_t tick) { frame_.session.seek(tick, false); });
    connect(&frame.session, &Session::opening, this, [this](const OpenedRun& run) {
        plannedEnd_ = run.start.tick + run.setup->scene().ticksOf(run.setup->scenario->parts().duration);
        noted_.clear();
        plots_.setReferences({}, {});
    });
    connect(&frame.session, &Session::shown, this, &RunTimeline::refresh);
    connect(&field, &FieldView::bodySelected, this, &RunTimeline::refresh);
    connect(&overlay, &Overlay::divergencesChanged, this, &RunTimeline::markDivergences);
}

void RunTimeline::note(std::vector<TimelineBar::Content::Noted> marks) {
    noted_ = std::move(marks);
    refresh();
}

void RunTimeline::refresh() {
    if (!frame_.shown()) return;
    const Shown& shown = *frame_.shown();
    TimelineBar::Content content;
    content.first = shown.first;
    content.last = shown.last;
    content.now = shown.tick();
    content.end = std::max(plannedEnd_, shown.last);
    content.tickLength = shown.frame->scene().tickLength;
    content.marks = shown.marks;
    content.noted = noted_;
    content.scenario = shown.frame->scenario;
    for (const BreakpointState& state : shown.breakpoints)
        content.breakpoints[state.breakpoint.id] = qtText(state.breakpoint.text);
    if (shown.branch != 0) content.departed = shown.branches[shown.branch].departed;
    for (const BranchInfo& branch : shown.branches)
        if (branch.parent == shown.branch && branch.departed > 0 && !branch.hidden)
            content.branches.push_back(branch.departed);
    addUnknown(content, shown);
    timeline_.setContent(std::move(content));
}

void RunTimeline::markDivergences() {
    OverlayMarks marks = frame_.shown() != nullptr ? marksOf(overlay_, frame_.shown()->frame->scene()) : OverlayMarks{};
    note(std::move(marks.noted));
    plots_.setReferences(std::move(marks.levels), marks.instant);
}

void RunTimeline::addUnknown(TimelineBar::Content& content, const Shown& shown) {
    const std::shared_ptr<const Reality>& reality = shown.frame->reality;
    if (!reality) return;
    const Scene& scene = shown.frame->scene();
    const std::optional<std::size_t> selected = field_.selected();
    const bool robot = selected && *selected < scene.robots.size();
    const Reality::Robot* const of = robot ? reality->robotNamed(scene.robots[*selected].name) : nullptr;
    if (reality_ != reality || robot_ != of) {
        unknown_ = reality->unknownOf(of);
        reality_ = reality;
        robot_ = of;
    }
    for (const Reality::Robot::Stretch& stretch : unknown_) {
        const Nanoseconds from = stretch.from / scene.tickLength;
        if (from >= content.end) break;
        const Nanoseconds to = std::min(stretch.to / scene.tickLength, content.end);
        content.unknown.push_back({from, stretch.to % scene.tickLength > 0 ? to + 1 : to});
    }
}

}  // namespace mrose::gui
