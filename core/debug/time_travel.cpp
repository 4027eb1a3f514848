#include "debug/time_travel.h"

#include <algorithm>
#include <utility>

namespace mrose {
namespace {

/// Of a branch beside that ended long ago not all comes at once, so that no tick is long.
constexpr std::int64_t mostBeside = 4;

/// "red 4 moved, blue 3 turned"; each once.
std::string together(const std::string& name, const std::string& edit) {
    const std::string comma = ", ";
    if (name.empty()) return edit;
    return (comma + name + comma).find(comma + edit + comma) != std::string::npos ? name : name + comma + edit;
}

/// At the start a robot has observed and decided already, as `after`, a tick later, has it.
void takeMemories(const Cursor& after, std::uint32_t robot, NewBranch& start) {
    const Scenario& scenario = *start.setup->scenario;
    std::ranges::copy(scenario.memoryOf(after.state(), robot), scenario.memoryOf(start.state, robot).begin());
    std::ranges::copy(scenario.sensorMemory(after.state(), robot), scenario.sensorMemory(start.state, robot).begin());
    start.insightsAtStart.push_back({robot, after.insights()[robot]});
}

}  // namespace

TimeTravel::TimeTravel(const OpenedRun& run, std::size_t mostTrackBytes)
    : branches_(run, mostTrackBytes),
      shown_(0, {run.start}),
      recordedBy_(run.origin),
      reality_(run.reality),
      origins_(1) {
    for (std::uint32_t i = 1; i < branches_.size(); ++i) {
        const Branch& branch = branches_[i];
        origins_.push_back({branch.name, branch.parent, branch.tick, branch.timeline.first()});
    }
    if (branches_.size() > 1) setBeside(static_cast<std::uint32_t>(branches_.size() - 1));
}

Expected<void> TimeTravel::forward() {
    if (tick() >= last())
        branches_.simulate(shown_);
    else if (auto advanced = branches_.advance(shown_, branch_); !advanced)
        return advanced;
    followBeside();
    return {};
}

void TimeTravel::followBeside() {
    if (!beside_ || beside_->at.tick() == tick()) return;
    const std::uint32_t other = beside_->branch;
    branches_.goOn(other, tick(), mostBeside);
    const std::int64_t there = std::clamp(tick(), branches_.first(other), branches_.last(other));
    if (there == beside_->at.tick() + 1 && branches_.advance(beside_->at, other)) return;
    if (there == beside_->at.tick()) return;
    if (auto cursor = branches_.lineageAt(other, there)) beside_->at = std::move(*cursor);
}

Expected<void> TimeTravel::show(std::uint32_t branch, std::int64_t tick) {
    Expected<Cursor> cursor = branches_.lineageAt(branch, tick);
    if (!cursor) return tl::unexpected(cursor.error());
    const std::uint32_t left = std::exchange(branch_, branch);
    shown_ = std::move(*cursor);
    if (branch != left)
        setBeside(left);
    else
        followBeside();
    return {};
}

void TimeTravel::setBeside(std::optional<std::uint32_t> branch) {
    beside_.reset();
    if (!branch || *branch >= branches_.size()) return;
    if (auto cursor = branches_.lineageAt(*branch, tick())) beside_ = Beside{*branch, std::move(*cursor)};
}

std::optional<std::uint32_t> TimeTravel::beside() const {
    return beside_ ? std::optional(beside_->branch) : std::nullopt;
}

bool TimeTravel::mergesInto(const Edit& edit) const {
    return branch_ != 0 && !branches_.hasBegun(branch_) && owner() == branch_ && edit.tick.value_or(tick()) == tick() &&
           !edit.start && !edit.afterDeciding;
}

Expected<void> TimeTravel::branchOff(const Edit& edit) {
    Expected<Cursor> at = shown_;
    if (edit.tick && *edit.tick != tick()) at = branches_.lineageAt(branch_, *edit.tick);
    if (!at) return tl::unexpected(at.error());
    const BranchRecord& before = branches_.record(at->branch());
    NewBranch start{edit.setup ? edit.setup : before.setupPointer(), edit.start ? *edit.start : at->state()};
    const Scenario& scenario = *start.setup->scenario;
    if (edit.afterDeciding) {
        const Expected<Cursor> after = branches_.lineageAt(branch_, start.state.tick + 1);
        if (!after) return tl::unexpected(after.error());
        takeMemories(*after, *edit.afterDeciding, start);
    }
    if (edit.change) edit.change(scenario, start.state);
    if (const std::string wrong = validate(scenario, start.state); !wrong.empty())
        return tl::unexpected(Error{"", 0, 0, "", "the state does not fit the scenario: " + wrong});
    const bool merges = mergesInto(edit);
    if (merges) start.orders = before.orders();
    start.orders.insert(start.orders.end(), edit.orders.begin(), edit.orders.end());
    // As in any editor what was undone cannot be done again after something else.
    for (const std::uint32_t branch : std::exchange(undone_, {}))
        if (!branches_.isFrom(branch_, branch)) origins_[branch].removed = true;
    const std::uint32_t parent = merges ? branches_[branch_].parent : at->branch();
    const std::string name = merges ? together(branches_[branch_].name, edit.name) : freeName(edit.name);
    ReachedState first{start.state};
    const bool follows = first.state.tick == at->tick() && sameMemories(*before.setup().scenario, scenario);
    const std::uint32_t made = branches_.begin(parent, name, std::move(start));
    const std::int64_t arrived = first.state.tick + (edit.afterDeciding ? 1 : 0);
    origins_.push_back({edit.name, branch_, tick(), arrived, merges ? std::optional(branch_) : std::nullopt});
    if (merges) origins_[branch_].replacement = made;
    at->moveTo(made, std::move(first), follows);
    branch_ = made;
    shown_ = std::move(*at);
    setBeside(parent);
    return {};
}

bool TimeTravel::superseded(std::uint32_t branch) const {
    if (!origins_[branch].replacement || branches_.hasBegun(branch) || branch == branch_ || beside() == branch)
        return false;
    for (std::uint32_t other = 1; other < branches_.size(); ++other)
        if (branches_[other].parent == branch) return false;
    return true;
}

/// "red 1 moved (2)" where there is one of that name.
std::string TimeTravel::freeName(const std::string& name) const {
    const auto taken = [&](const std::string& some) {
        for (std::uint32_t branch = 0; branch < branches_.size(); ++branch)
            if (branches_[branch].name == some && !hidden(branch)) return true;
        return false;
    };
    std::string free = name;
    for (int number = 2; taken(free); ++number) free = name + " (" + std::to_string(number) + ')';
    return free;
}

bool TimeTravel::hidden(std::uint32_t branch) const {
    for (std::uint32_t at = branch;; at = branches_[at].parent) {
        if (origins_[at].removed) return true;
        if (branches_[at].parent == at) return superseded(branch);
    }
}

bool TimeTravel::remove(std::uint32_t branch) {
    if (branch == 0 || branch >= branches_.size() || hidden(branch)) return false;
    if (branches_.isFrom(branch_, branch) && !show(branches_[branch].parent, tick())) return false;
    origins_[branch].removed = true;
    std::erase_if(undone_, [&](std::uint32_t other) { return hidden(other); });
    if (beside_ && hidden(beside_->branch)) beside_.reset();
    return true;
}

std::size_t TimeTravel::removeOthers() {
    std::size_t count = 0;
    for (std::uint32_t branch = 1; branch < branches_.size(); ++branch)
        if (!branches_.isFrom(branch_, branch) && remove(branch)) ++count;
    return count;
}

std::size_t TimeTravel::restore() {
    std::size_t count = 0;
    for (Origin& origin : origins_) count += std::exchange(origin.removed, false) ? 1 : 0;
    return count;
}

bool TimeTravel::undone(std::uint32_t branch) const {
    return std::find(undone_.begin(), undone_.end(), branch) != undone_.end();
}

const TimeTravel::Origin* TimeTravel::lastUndone() const {
    return undone_.empty() ? nullptr : &origins_[undone_.back()];
}

/// Beside what remains of edits made at one tick is what all of them departed from; beside that, all of them.
bool TimeTravel::undo() {
    const std::uint32_t from = branch();
    const Origin& origin = origins_[from];
    if (from == 0 || !show(origin.from, origin.stood)) return false;
    undone_.push_back(from);
    std::uint32_t all = from;
    while (origins_[all].replacement) all = *origins_[all].replacement;
    setBeside(origin.replaced ? branches_[branch()].parent : all);
    return true;
}

bool TimeTravel::redo() {
    if (undone_.empty()) return false;
    const std::uint32_t to = undone_.back();
    if (!show(to, origins_[to].arrived)) return false;
    undone_.pop_back();
    if (origins_[to].replaced) setBeside(branches_[to].parent);
    return true;
}

}  // namespace mrose
