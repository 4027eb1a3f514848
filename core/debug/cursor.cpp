#include "debug/cursor.h"

#include <algorithm>

namespace mrose {

Cursor::Cursor(std::uint32_t branch, ReachedState at) : branch_(branch), at_(std::move(at)) {
    trace_.asksUnread = true;
    forgetNotes();
}

Expected<void> Cursor::advance(const BranchRecord& record, const Timeline& timeline) {
    memoryBefore_ = at_.state.memory;
    if (auto advanced = record.playback().advance(timeline, at_, trace_); !advanced) return advanced;
    note(record);
    return {};
}

const StepTrace& Cursor::step(BranchRecord& record, StepBuffers& buffers) {
    memoryBefore_ = at_.state.memory;
    mrose::step(*record.setup().scenario, at_.state, buffers, record.overrides(at_.state), &trace_);
    at_.worldSame = at_.memoriesSame = true;
    note(record);
    return trace_;
}

void Cursor::moveTo(std::uint32_t branch, ReachedState at, bool follows) {
    branch_ = branch;
    at_ = std::move(at);
    hasTrace_ = false;
    breakReason_.clear();
    if (!follows) forgetNotes();
}

void Cursor::note(const BranchRecord& record) {
    const Scenario& scenario = *record.setup().scenario;
    hasTrace_ = true;
    breakReason_.clear();
    noteInsights(scenario, trace_, tick(), memoryBefore_, insights_);
    for (std::size_t robot = 0; robot < trace_.robots.size(); ++robot)
        if (const Decision& decision = trace_.robots[robot].decision;
            trace_.robots[robot].decided && !decision.breakReason.empty())
            breakReason_ = scenario.scene().robots[robot].name + ": " + decision.breakReason;
    noteInsightsAtStart(record);
    const std::int64_t oldest = tick() - scenario.scene().ticksOf(kickShown);
    std::erase_if(kicks_, [&](const SeenKick& seen) { return seen.tick < oldest; });
    for (const StepTrace::Kicked& kick : trace_.kicks) kicks_.push_back({tick(), kick});
    radio_.add(scenario.scene(), at_.state, trace_);
}

/// Of robots that got another command: they have observed and updated their memory, and only their orders were
/// replaced.
void Cursor::noteInsightsAtStart(const BranchRecord& record) {
    for (const BranchRecord::InsightAtStart& atStart : record.insightsAtStart()) {
        RobotInsight& known = insights_[atStart.robot];
        if (known.tick != atStart.insight.tick || known.tick != tick() - 1 || known.observed) continue;
        known.observed = atStart.insight.observed;
        known.observation = atStart.insight.observation;
        known.others = atStart.insight.others;
        known.memoryBefore = atStart.insight.memoryBefore;
        known.decision.annotations = atStart.insight.decision.annotations;
    }
}

void Cursor::forgetNotes() {
    insights_.assign(at_.state.robots.size(), {});
    kicks_.clear();
    radio_.clear();
    breakReason_.clear();
    hasTrace_ = false;
}

FieldFrame Cursor::frame(std::shared_ptr<const Scenario> scenario) const {
    FieldFrame frame;
    frame.scenario = std::move(scenario);
    frame.state = at_.state;
    frame.insights = insights_;
    if (hasTrace_) frame.lastTick = trace_;
    for (const SeenKick& seen : kicks_) frame.kicks.push_back(seen.kick);
    frame.radio = radio_;
    return frame;
}

Moment Cursor::moment(const Scenario& scenario, const Reality* reality) const {
    return {&scenario, &at_.state, trace(), insights_, reality};
}

}  // namespace mrose
