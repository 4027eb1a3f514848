#include "cursor.h"

#include <algorithm>

namespace mrose::gui {

Cursor::Cursor(std::uint32_t branch, ReachedState at) : branch_(branch), at_(std::move(at)) { forgetNotes(); }

Expected<void> Cursor::advance(const Scenario& scenario, Playback& playback, const Timeline& timeline) {
    memoryBefore_ = at_.state.memory;
    if (auto advanced = playback.advance(timeline, at_, trace_); !advanced) return advanced;
    note(scenario);
    return {};
}

const StepTrace& Cursor::step(const Scenario& scenario, StepBuffers& buffers, const Overrides& overrides) {
    memoryBefore_ = at_.state.memory;
    mrose::step(scenario, at_.state, buffers, overrides, &trace_);
    at_.worldSame = at_.mindsSame = true;
    note(scenario);
    return trace_;
}

void Cursor::moveTo(std::uint32_t branch, ReachedState at) {
    branch_ = branch;
    const bool sameRobots = at.state.robots.size() == at_.state.robots.size() && at.state.tick == at_.state.tick;
    at_ = std::move(at);
    hasTrace_ = false;
    breakReason_.clear();
    if (!sameRobots) forgetNotes();
}

void Cursor::note(const Scenario& scenario) {
    hasTrace_ = true;
    breakReason_.clear();
    for (std::uint32_t robot = 0; robot < trace_.robots.size(); ++robot) {
        const StepTrace::Robot& told = trace_.robots[robot];
        if (!told.decided) continue;
        const auto before = scenario.memoryOf(memoryBefore_, robot);
        insights_[robot] = {tick() - 1,    told.observed,  told.observation,
                            told.decision, told.predicted, {before.begin(), before.end()}};
        if (!told.decision.breakReason.empty())
            breakReason_ = scenario.scene().robots[robot].name + ": " + told.decision.breakReason;
    }
    const std::int64_t oldest = tick() - scenario.scene().ticksOf(kickShown);
    std::erase_if(kicks_, [&](const SeenKick& seen) { return seen.tick < oldest; });
    for (const StepTrace::Kicked& kick : trace_.kicks) kicks_.push_back({tick(), kick});
}

void Cursor::forgetNotes() {
    insights_.assign(at_.state.robots.size(), {});
    kicks_.clear();
    breakReason_.clear();
    hasTrace_ = false;
}

FieldFrame Cursor::frame(std::shared_ptr<const Scenario> scenario) const {
    FieldFrame frame;
    frame.scenario = std::move(scenario);
    frame.state = at_.state;
    frame.insights = insights_;
    if (hasTrace_) {
        frame.lastTick = trace_.robots;
        frame.contacts = trace_.contacts;
    }
    for (const SeenKick& seen : kicks_) frame.kicks.push_back(seen.kick);
    return frame;
}

Moment Cursor::moment(const Scenario& scenario) const {
    if (!hasTrace_) return {scenario, at_.state, {}, {}, insights_};
    return {scenario, at_.state, trace_.robots, trace_.contacts, insights_, &trace_};
}

}  // namespace mrose::gui
