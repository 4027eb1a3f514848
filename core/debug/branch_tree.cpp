#include "debug/branch_tree.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "recording/tick_decisions.h"

namespace mrose {
namespace {

/// So many ticks before it, every robot has decided once, and kicks, messages and readings that are still shown have
/// happened.
std::int64_t ticksToLookBack(const Scenario& scenario) {
    const Scene& scene = scenario.scene();
    std::int64_t most = scene.ticksOf(kickShown);
    for (std::size_t robot = 0; robot < scene.robots.size(); ++robot) {
        most = std::max(most, scene.periodTicks(robot));
        if (scenario.readsMessages(robot)) most = std::max(most, scene.ticksOf(RadioLog::kept));
        for (const SensorPointer& sensor : scenario.sensors(robot))
            most = std::max(
                most, scene.periodTicks(robot) + scene.ticksOf(knownFor(scenario, robot, *sensor) - sensor->latency()));
    }
    return most + 2;
}

History historyOf(const OpenedRun& run) {
    if (!run.recorded()) return History(run.start);
    std::vector<Branch> branches;
    for (const OpenedRun::Recorded& recorded : run.branches) branches.push_back(recorded.branch);
    return History(std::move(branches));
}

/// Of the ticks of a branch's lineage after `from`, up to and with `to`: the tick that led to a branch's first state is
/// its parent's.
void addTouches(const BranchTree& branches, std::uint32_t branch, std::int64_t from, std::int64_t to,
                TouchCounter& touches) {
    const Timeline& timeline = branches[branch].timeline;
    if (from < timeline.first() && branches.follows(branch))
        addTouches(branches, branches[branch].parent, from, timeline.first(), touches);
    Playback& playback = branches.record(branch).playback();
    auto at = playback.reach(timeline, std::clamp(from, timeline.first(), to));
    StepTrace trace;
    while (at && at->state.tick < to && playback.advance(timeline, *at, trace)) touches.add(trace);
}

/// Of robots that get another command in a branch's first tick: what they remembered in the branch that it left.
std::vector<BranchRecord::InsightAtStart> insightsAtStartOf(const BranchTree& branches, std::uint32_t branch,
                                                            std::span<const RobotDecision> decisions) {
    const Branch& way = branches[branch];
    std::vector<BranchRecord::InsightAtStart> insightsAtStart;
    if (decisions.empty() || branches.last(way.parent) <= way.tick) return insightsAtStart;
    const Expected<Cursor> after = branches.lineageAt(way.parent, way.tick + 1);
    if (!after) return insightsAtStart;
    for (const RobotDecision& decision : decisions)
        if (const RobotInsight& insight = after->insights()[decision.robot]; insight.tick == way.tick)
            insightsAtStart.push_back({decision.robot, insight});
    return insightsAtStart;
}

}  // namespace

bool sameMemories(const Scenario& one, const Scenario& other) {
    if (&one == &other) return true;
    const Scene &a = one.scene(), &b = other.scene();
    if (a.robots.size() != b.robots.size() || a.objects.size() != b.objects.size()) return false;
    for (std::size_t robot = 0; robot < a.robots.size(); ++robot)
        if (one.parts().controllers[robot]->memorySize() != other.parts().controllers[robot]->memorySize())
            return false;
    return true;
}

BranchTree::BranchTree(const OpenedRun& run, std::size_t mostTrackBytes)
    : history_(historyOf(run)), mostTrackBytes_(mostTrackBytes) {
    if (!run.recorded()) records_.emplace_back(run.setup, run.start, std::vector<HandOrder>{});
    for (const OpenedRun::Recorded& recorded : run.branches)
        records_.emplace_back(recorded.setup, recorded.start, std::vector<HandOrder>{});
    for (std::uint32_t branch = 1; branch < size(); ++branch) takeOver(branch);
}

bool BranchTree::departs(std::uint32_t branch) const {
    const Branch& way = (*this)[branch];
    return way.parent != branch && way.timeline.first() == way.tick && last(way.parent) >= way.tick &&
           first(way.parent) < way.tick;
}

bool BranchTree::follows(std::uint32_t branch) const {
    return departs(branch) &&
           sameMemories(*record((*this)[branch].parent).setup().scenario, *record(branch).setup().scenario);
}

std::int64_t BranchTree::first(std::uint32_t branch) const {
    return departs(branch) ? first((*this)[branch].parent) : (*this)[branch].timeline.first();
}

std::uint32_t BranchTree::owner(std::uint32_t branch, std::int64_t tick) const {
    while (tick < (*this)[branch].timeline.first() && departs(branch)) branch = (*this)[branch].parent;
    return branch;
}

bool BranchTree::isFrom(std::uint32_t branch, std::uint32_t ancestor) const {
    while (branch != ancestor && (*this)[branch].parent != branch) branch = (*this)[branch].parent;
    return branch == ancestor;
}

bool BranchTree::hasBegun(std::uint32_t branch) const { return last(branch) > (*this)[branch].timeline.first(); }

std::vector<BranchTicks> BranchTree::parts(std::uint32_t branch) const {
    std::vector<BranchTicks> parts{{branch, (*this)[branch].timeline.first(), last(branch)}};
    for (;;) {
        const std::int64_t begin = parts.front().first;
        const std::uint32_t before = owner(parts.front().branch, begin - 1);
        if (before == parts.front().branch) return parts;
        parts.insert(parts.begin(), {before, (*this)[before].timeline.first(), begin - 1});
    }
}

std::vector<TimelineMark> BranchTree::marks(std::uint32_t branch) const {
    std::vector<TimelineMark> marks;
    for (const BranchTicks& part : parts(branch)) {
        // What a branch begins with has come about in the one before.
        const std::int64_t until = part.branch == branch ? part.last : part.last + 1;
        for (const TimelineMark& mark : record(part.branch).marks())
            if (mark.tick <= until) marks.push_back(mark);
    }
    return marks;
}

std::vector<BranchRecord::FirstFault> BranchTree::faults(std::uint32_t branch, std::int64_t until) const {
    std::vector<BranchRecord::FirstFault> faults;
    for (;;) {
        for (const BranchRecord::FirstFault& fault : record(branch).faults())
            if (fault.tick <= until) faults.push_back(fault);
        const std::uint32_t parent = (*this)[branch].parent;
        if (parent == branch || record(branch).setupPointer() != record(parent).setupPointer()) return faults;
        until = std::min(until, (*this)[branch].tick);
        branch = parent;
    }
}

std::optional<std::vector<Pose>> BranchTree::posesAt(std::uint32_t branch, std::int64_t tick) const {
    const PoseTrack& track = record(owner(branch, tick)).track();
    if (tick < track.first() || tick > track.last()) return {};
    return track.posesAt(tick);
}

Expected<Cursor> BranchTree::cursorAt(std::uint32_t branch, std::int64_t tick) const {
    tick = std::clamp(tick, (*this)[branch].timeline.first(), last(branch));
    Cursor cursor(branch, {});
    // From a little earlier, so that what robots saw and decided is known.
    const std::int64_t from = tick - ticksToLookBack(*record(branch).setup().scenario);
    if (auto walked = walk(cursor, branch, from, tick); !walked) return tl::unexpected(walked.error());
    return cursor;
}

Expected<Cursor> BranchTree::lineageAt(std::uint32_t branch, std::int64_t tick) const {
    return cursorAt(owner(branch, tick), tick);
}

Expected<void> BranchTree::advance(Cursor& cursor, std::uint32_t branch) const {
    const std::uint32_t next = owner(branch, cursor.tick() + 1);
    if (next == cursor.branch()) return cursor.advance(record(next), (*this)[next].timeline);
    Expected<Cursor> there = cursorAt(next, cursor.tick() + 1);
    if (!there) return tl::unexpected(there.error());
    cursor = std::move(*there);
    return {};
}

Expected<void> BranchTree::walk(Cursor& cursor, std::uint32_t branch, std::int64_t from, std::int64_t to) const {
    const Branch& way = (*this)[branch];
    const bool fromParent = from < way.timeline.first() && follows(branch);
    if (fromParent)
        if (auto walked = walk(cursor, way.parent, from, way.tick); !walked) return walked;
    Expected<ReachedState> reached =
        record(branch).playback().reach(way.timeline, std::clamp(from, way.timeline.first(), to));
    if (!reached) return tl::unexpected(reached.error());
    cursor.moveTo(branch, std::move(*reached), fromParent);
    while (cursor.tick() < to)
        if (auto done = cursor.advance(record(branch), way.timeline); !done) return done;
    return {};
}

std::uint32_t BranchTree::begin(std::uint32_t parent, const std::string& name, NewBranch start) {
    const bool otherSetup = start.setup != record(parent).setupPointer();
    const std::uint32_t made =
        history_.beginBranch(parent, start.state, name, otherSetup ? start.setup->value : nullptr);
    records_.emplace_back(std::move(start.setup), start.state, std::move(start.orders));
    records_[made].setInsightsAtStart(std::move(start.insightsAtStart));
    takeOver(made);
    return made;
}

/// What came before a branch's beginning and goes on in it.
void BranchTree::takeOver(std::uint32_t branch) {
    if (!follows(branch)) return;
    const Branch& way = (*this)[branch];
    const Scene& scene = record(branch).setup().scene();
    TouchCounter touches(scene.tickLength);
    addTouches(*this, way.parent, way.tick - scene.ticksOf(TouchCounter::apart) - 1, way.tick, touches);
    records_[branch].setTouches(std::move(touches));
    DecisionReader outside(way.timeline.blocks().front().decisions);
    if (hasBegun(branch) && outside.next(DecisionsOf::outside))
        records_[branch].setInsightsAtStart(insightsAtStartOf(*this, branch, outside.decisions()));
}

void BranchTree::simulate(Cursor& cursor) {
    const std::uint32_t branch = cursor.branch();
    BranchRecord& record = records_[branch];
    const bool known = record.last() == cursor.tick();
    const StepTrace& trace = cursor.step(record, buffers_);
    history_.add(cursor.state(), trace, branch);
    if (known) record.add(cursor.state(), trace);
    goOn((*this)[branch].parent, cursor.tick(), std::numeric_limits<std::int64_t>::max());
    keepTracksSmall();
}

void BranchTree::goOn(std::uint32_t branch, std::int64_t tick, std::int64_t most) {
    BranchRecord& record = records_[branch];
    if (record.last() != last(branch)) return;
    StepTrace trace;
    for (; most > 0 && record.last() < tick; --most) {
        WorldState state = record.end();
        step(*record.setup().scenario, state, buffers_, record.overrides(state), &trace);
        history_.add(state, trace, branch);
        record.add(state, trace);
    }
}

std::size_t BranchTree::trackBytes() const {
    std::size_t sum = 0;
    for (const BranchRecord& record : records_) sum += record.track().bytes();
    return sum;
}

void BranchTree::keepTracksSmall() {
    while (trackBytes() > mostTrackBytes_) {
        const auto smaller = [](const BranchRecord& a, const BranchRecord& b) {
            return a.track().bytes() < b.track().bytes();
        };
        if (!std::max_element(records_.begin(), records_.end(), smaller)->track().forgetEarliest()) return;
    }
}

Expected<bool> BranchTree::learn(std::int64_t ticks) {
    for (std::uint32_t branch = 0; branch < size(); ++branch)
        if (records_[branch].last() < last(branch)) {
            auto more = records_[branch].learn((*this)[branch].timeline, ticks);
            keepTracksSmall();
            if (!more || *more) return more;
            return learn(0);
        }
    return false;
}

Expected<void> BranchTree::learnUpTo(std::uint32_t branch, std::int64_t tick) {
    for (const BranchTicks& part : parts(branch)) {
        BranchRecord& record = records_[part.branch];
        const std::int64_t missing = std::min(tick, part.last) - record.last();
        if (missing <= 0) continue;
        if (auto more = record.learn((*this)[part.branch].timeline, missing); !more)
            return tl::unexpected(more.error());
    }
    return {};
}

}  // namespace mrose
