// How branches of a run begin, what they take over from before, and how edits are taken back.
#include <algorithm>
#include <utility>

#include "debug/time_travel.h"
#include "recording/tick_decisions.h"

namespace mrose {
namespace {

/// "red 4 moved, blue 3 turned"; each once.
std::string together(const std::string& name, const std::string& edit) {
    const std::string comma = ", ";
    if (name.empty()) return edit;
    return (comma + name + comma).find(comma + edit + comma) != std::string::npos ? name : name + comma + edit;
}

bool sameMemories(const Scenario& one, const Scenario& other) {
    if (&one == &other) return true;
    const Scene &a = one.scene(), &b = other.scene();
    if (a.robots.size() != b.robots.size() || a.objects.size() != b.objects.size()) return false;
    for (std::size_t robot = 0; robot < a.robots.size(); ++robot)
        if (one.parts().controllers[robot]->memorySize() != other.parts().controllers[robot]->memorySize())
            return false;
    return true;
}

}  // namespace

bool TimeTravel::sharesMemories(std::uint32_t branch) const {
    return sameMemories(*scenarioOf(branches()[branch].parent), *scenarioOf(branch));
}

bool TimeTravel::mergesInto(const Edit& edit) const {
    return branch_ != 0 && begins(branch_) && owner() == branch_ && edit.tick.value_or(tick()) == tick() &&
           !edit.start && !edit.afterDeciding;
}

Expected<void> TimeTravel::branchOff(const Edit& edit) {
    Cursor at = shown_;
    if (edit.tick && *edit.tick != tick()) {
        Expected<Cursor> there = lineageAt(branch_, *edit.tick);
        if (!there) return tl::unexpected(there.error());
        at = std::move(*there);
    }
    const bool merges = mergesInto(edit);
    const std::uint32_t parent = merges ? branches()[branch_].parent : at.branch();
    const BranchSetupPointer setup = edit.setup ? edit.setup : records_[at.branch()].setupPointer();
    WorldState state = edit.start ? *edit.start : at.state();
    std::vector<BranchRecord::InsightAtStart> insightsAtStart;
    if (edit.afterDeciding) {
        const Expected<Cursor> after = lineageAt(branch_, state.tick + 1);
        if (!after) return tl::unexpected(after.error());
        const Scenario& scenario = *setup->scenario;
        std::ranges::copy(scenario.memoryOf(after->state(), *edit.afterDeciding),
                          scenario.memoryOf(state, *edit.afterDeciding).begin());
        std::ranges::copy(scenario.sensorMemory(after->state(), *edit.afterDeciding),
                          scenario.sensorMemory(state, *edit.afterDeciding).begin());
        insightsAtStart.push_back({*edit.afterDeciding, after->insights()[*edit.afterDeciding]});
    }
    if (edit.change) edit.change(*setup->scenario, state);
    if (const std::string wrong = validate(*setup->scenario, state); !wrong.empty())
        return tl::unexpected(Error{"", 0, 0, "", "the state does not fit the scenario: " + wrong});
    // As in any editor what was undone cannot be done again after something else.
    for (const std::uint32_t branch : std::exchange(undone_, {}))
        if (!isFrom(branch_, branch)) origins_[branch].removed = true;
    const bool otherSetup = setup != records_[parent].setupPointer();
    const std::uint32_t made = history_.beginBranch(
        parent, state, merges ? together(branches()[branch_].name, edit.name) : freeName(edit.name),
        otherSetup ? setup->value : nullptr);
    std::vector<HandOrder> orders = merges ? records_[branch_].orders() : std::vector<HandOrder>{};
    orders.insert(orders.end(), edit.orders.begin(), edit.orders.end());
    records_.emplace_back(setup, state, std::move(orders));
    origins_.push_back({edit.name, branch_, tick(), state.tick + (edit.afterDeciding ? 1 : 0)});
    if (merges) {
        origins_[made].replaced = branch_;
        origins_[branch_].replacement = made;
    }
    takeOver(made);
    records_[made].setInsightsAtStart(std::move(insightsAtStart));
    const bool follows = state.tick == at.tick() && sameMemories(*scenarioOf(at.branch()), *setup->scenario);
    at.moveTo(made, {std::move(state)}, follows);
    branch_ = made;
    shown_ = std::move(at);
    setBeside(parent);
    return {};
}

/// What came before a branch's beginning and goes on in it.
void TimeTravel::takeOver(std::uint32_t branch) {
    if (!departs(branch) || !sharesMemories(branch)) return;
    const Branch& way = branches()[branch];
    const Scene& scene = scenarioOf(branch)->scene();
    TouchCounter touches(scene.tickLength);
    addTouches(way.parent, way.tick - scene.ticksOf(TouchCounter::apart) - 1, way.tick, touches);
    records_[branch].setTouches(std::move(touches));
    DecisionReader outside(way.timeline.blocks().front().decisions);
    if (begins(branch) || !outside.next(DecisionsOf::outside) || outside.decisions().empty()) return;
    std::vector<std::uint32_t> robots;
    for (const RobotDecision& decision : outside.decisions()) robots.push_back(decision.robot);
    records_[branch].setInsightsAtStart(insightsAtStartOf(branch, robots));
}

/// Of robots that get another command in a branch's first tick: what they remembered in the branch that it left.
std::vector<BranchRecord::InsightAtStart> TimeTravel::insightsAtStartOf(std::uint32_t branch,
                                                                        std::span<const std::uint32_t> robots) {
    const Branch& way = branches()[branch];
    std::vector<BranchRecord::InsightAtStart> insightsAtStart;
    if (lastOf(way.parent) <= way.tick) return insightsAtStart;
    const Expected<Cursor> after = lineageAt(way.parent, way.tick + 1);
    if (!after) return insightsAtStart;
    for (const std::uint32_t robot : robots)
        if (after->insights()[robot].tick == way.tick) insightsAtStart.push_back({robot, after->insights()[robot]});
    return insightsAtStart;
}

/// Of the ticks of a branch's lineage after `from`, up to and with `to`: the tick that led to a branch's first state is
/// its parent's.
void TimeTravel::addTouches(std::uint32_t branch, std::int64_t from, std::int64_t to, TouchCounter& touches) {
    const Timeline& timeline = timelineOf(branch);
    if (from < timeline.first() && departs(branch) && sharesMemories(branch))
        addTouches(branches()[branch].parent, from, timeline.first(), touches);
    Playback& playback = records_[branch].playback();
    auto at = playback.reach(timeline, std::clamp(from, timeline.first(), to));
    StepTrace trace;
    while (at && at->state.tick < to && playback.advance(timeline, *at, trace)) touches.add(trace);
}

bool TimeTravel::superseded(std::uint32_t branch) const {
    if (!origins_[branch].replacement || !begins(branch) || branch == branch_ || beside() == branch) return false;
    const auto departsFromIt = [&](const Branch& other) { return other.parent == branch; };
    return std::none_of(branches().begin(), branches().end(), departsFromIt);
}

bool TimeTravel::isFrom(std::uint32_t branch, std::uint32_t ancestor) const {
    while (branch != ancestor && branches()[branch].parent != branch) branch = branches()[branch].parent;
    return branch == ancestor;
}

/// "red 1 moved (2)" where there is one of that name.
std::string TimeTravel::freeName(const std::string& name) const {
    const auto taken = [&](const std::string& some) {
        for (std::uint32_t branch = 0; branch < branches().size(); ++branch)
            if (branches()[branch].name == some && !hidden(branch)) return true;
        return false;
    };
    std::string free = name;
    for (int number = 2; taken(free); ++number) free = name + " (" + std::to_string(number) + ')';
    return free;
}

bool TimeTravel::hidden(std::uint32_t branch) const {
    for (std::uint32_t at = branch;; at = branches()[at].parent) {
        if (origins_[at].removed) return true;
        if (branches()[at].parent == at) return superseded(branch);
    }
}

bool TimeTravel::undone(std::uint32_t branch) const {
    return std::find(undone_.begin(), undone_.end(), branch) != undone_.end();
}

bool TimeTravel::remove(std::uint32_t branch) {
    if (branch == 0 || branch >= branches().size() || hidden(branch)) return false;
    if (isFrom(branch_, branch) && !show(branches()[branch].parent, tick())) return false;
    origins_[branch].removed = true;
    std::erase_if(undone_, [&](std::uint32_t other) { return hidden(other); });
    if (beside_ && hidden(beside_->branch)) beside_.reset();
    return true;
}

std::size_t TimeTravel::removeOthers() {
    std::size_t count = 0;
    for (std::uint32_t branch = 1; branch < branches().size(); ++branch)
        if (!isFrom(branch_, branch) && remove(branch)) ++count;
    return count;
}

std::size_t TimeTravel::restore() {
    std::size_t count = 0;
    for (Origin& origin : origins_) count += std::exchange(origin.removed, false) ? 1 : 0;
    return count;
}

/// Beside what remains of edits made at one tick is what all of them departed from; beside that, all of them.
bool TimeTravel::undo() {
    if (!canUndo()) return false;
    const std::uint32_t from = branch();
    const Origin origin = origins_[from];
    if (!show(origin.from, origin.stood)) return false;
    undone_.push_back(from);
    std::uint32_t all = from;
    while (origins_[all].replacement) all = *origins_[all].replacement;
    setBeside(origin.replaced ? branches()[branch()].parent : all);
    return true;
}

bool TimeTravel::redo() {
    if (undone_.empty()) return false;
    const std::uint32_t to = undone_.back();
    if (!show(to, origins_[to].arrived)) return false;
    undone_.pop_back();
    if (origins_[to].replaced) setBeside(branches()[to].parent);
    return true;
}

}  // namespace mrose
