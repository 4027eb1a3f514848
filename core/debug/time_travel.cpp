#include "debug/time_travel.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace mrose {
namespace {

/// Of a branch beside that ended long ago not all comes at once, so that no tick is long.
constexpr std::int64_t mostBeside = 4;

/// So many ticks before it, every robot has decided once, and kicks that are still shown have happened.
std::int64_t ticksToLookBack(const Scene& scene) {
    std::int64_t most = scene.ticksOf(kickShown);
    for (std::size_t robot = 0; robot < scene.robots.size(); ++robot) most = std::max(most, scene.periodTicks(robot));
    return most + 1;
}

History historyOf(const OpenRun& run) {
    if (!run.recorded()) return History(run.start);
    std::vector<Branch> branches;
    for (const OpenRun::Recorded& recorded : run.branches) branches.push_back(recorded.branch);
    return History(std::move(branches));
}

}  // namespace

TimeTravel::TimeTravel(const OpenRun& run, std::size_t mostTrackBytes)
    : history_(historyOf(run)), mostTrackBytes_(mostTrackBytes), shown_(0, {run.start}), reality_(run.reality) {
    if (!run.recorded()) records_.emplace_back(run.setup, run.start, std::vector<HandOrder>{});
    for (const OpenRun::Recorded& recorded : run.branches)
        records_.emplace_back(recorded.setup, recorded.start, std::vector<HandOrder>{});
    for (const Branch& branch : branches())
        origins_.push_back({branch.name, branch.parent, branch.tick, branch.timeline.first()});
    for (std::uint32_t branch = 1; branch < branches().size(); ++branch) takeOver(branch);
    if (branches().size() > 1) setBeside(static_cast<std::uint32_t>(branches().size() - 1));
}

bool TimeTravel::departs(std::uint32_t branch) const {
    const Branch& way = branches()[branch];
    return way.parent != branch && way.timeline.first() == way.tick && timelineOf(way.parent).last() >= way.tick &&
           firstOf(way.parent) < way.tick;
}

std::uint32_t TimeTravel::ownerOf(std::uint32_t branch, std::int64_t tick) const {
    while (tick < timelineOf(branch).first() && departs(branch)) branch = branches()[branch].parent;
    return branch;
}

std::optional<std::vector<Pose>> TimeTravel::posesAt(std::uint32_t branch, std::int64_t tick) const {
    const PoseTrack& track = records_[ownerOf(branch, tick)].track();
    if (tick < track.first() || tick > track.last()) return {};
    return track.posesAt(tick);
}

std::int64_t TimeTravel::firstOf(std::uint32_t branch) const {
    return departs(branch) ? firstOf(branches()[branch].parent) : timelineOf(branch).first();
}

std::vector<TimeTravel::Part> TimeTravel::parts() const {
    std::vector<Part> parts{{branch_, timelineOf(branch_).first(), last()}};
    for (;;) {
        const std::int64_t begin = parts.front().first;
        const std::uint32_t before = ownerOf(parts.front().branch, begin - 1);
        if (before == parts.front().branch) return parts;
        parts.insert(parts.begin(), {before, timelineOf(before).first(), begin - 1});
    }
}

std::vector<TimelineMark> TimeTravel::marks() const {
    std::vector<TimelineMark> marks;
    for (const Part& part : parts()) {
        // What a branch begins with has come about in the one before.
        const std::int64_t until = part.branch == branch_ ? part.last : part.last + 1;
        for (const TimelineMark& mark : records_[part.branch].marks())
            if (mark.tick <= until) marks.push_back(mark);
    }
    return marks;
}

Expected<void> TimeTravel::advance(Cursor& cursor, std::uint32_t branch) const {
    const std::uint32_t owner = ownerOf(branch, cursor.tick() + 1);
    if (owner != cursor.branch()) {
        Expected<Cursor> there = cursorAt(owner, cursor.tick() + 1);
        if (!there) return tl::unexpected(there.error());
        cursor = std::move(*there);
        return {};
    }
    const BranchRecord& record = records_[owner];
    return cursor.advance(record, timelineOf(owner));
}

Expected<void> TimeTravel::forward() {
    if (tick() < last()) {
        if (auto advanced = advance(shown_, branch_); !advanced) return advanced;
    } else {
        BranchRecord& record = records_[branch_];
        const bool known = record.last() == tick();
        const StepTrace& trace = shown_.step(record, buffers_);
        history_.add(state(), trace, branch_);
        if (known) record.add(state(), trace);
        // What would have happened goes on beside what was changed.
        goOnWith(branches()[branch_].parent, std::numeric_limits<std::int64_t>::max());
        keepTracksSmall();
    }
    followBeside();
    return {};
}

/// A branch that is not shown goes on as well, up to the shown tick, but by so many ticks at the most.
void TimeTravel::goOnWith(std::uint32_t branch, std::int64_t most) {
    BranchRecord& record = records_[branch];
    if (branch == branch_ || record.last() != timelineOf(branch).last()) return;
    StepTrace trace;
    for (; most > 0 && record.last() < tick(); --most) {
        WorldState state = record.end();
        step(*record.setup().scenario, state, buffers_, record.overrides(state), &trace);
        history_.add(state, trace, branch);
        record.add(state, trace);
    }
}

void TimeTravel::followBeside() {
    if (!beside_ || beside_->at.tick() == tick()) return;
    const std::uint32_t other = beside_->branch;
    goOnWith(other, mostBeside);
    const std::int64_t there = std::clamp(tick(), firstOf(other), timelineOf(other).last());
    if (there == beside_->at.tick() + 1 && advance(beside_->at, other)) return;
    if (there == beside_->at.tick()) return;
    if (auto cursor = lineageAt(other, there)) beside_->at = std::move(*cursor);
}

Expected<void> TimeTravel::show(std::uint32_t branch, std::int64_t tick) {
    Expected<Cursor> cursor = lineageAt(branch, tick);
    if (!cursor) return tl::unexpected(cursor.error());
    const std::uint32_t left = std::exchange(branch_, branch);
    shown_ = std::move(*cursor);
    if (branch != left)
        setBeside(left);
    else
        followBeside();
    return {};
}

Expected<Cursor> TimeTravel::lineageAt(std::uint32_t branch, std::int64_t tick) const {
    return cursorAt(ownerOf(branch, tick), tick);
}

Expected<Cursor> TimeTravel::cursorAt(std::uint32_t branch, std::int64_t tick) const {
    tick = std::clamp(tick, timelineOf(branch).first(), timelineOf(branch).last());
    Cursor cursor(branch, {});
    // From a little earlier, so that what robots saw and decided is known.
    const std::int64_t from = tick - ticksToLookBack(records_[branch].setup().scene());
    if (auto walked = walk(cursor, branch, from, tick); !walked) return tl::unexpected(walked.error());
    return cursor;
}

Expected<void> TimeTravel::walk(Cursor& cursor, std::uint32_t branch, std::int64_t from, std::int64_t to) const {
    const Branch& way = branches()[branch];
    const bool fromParent = from < way.timeline.first() && departs(branch) && sharesMemories(branch);
    if (fromParent)
        if (auto walked = walk(cursor, way.parent, from, way.tick); !walked) return walked;
    const BranchRecord& record = records_[branch];
    Expected<ReachedState> reached = record.playback().reach(way.timeline, std::clamp(from, way.timeline.first(), to));
    if (!reached) return tl::unexpected(reached.error());
    cursor.moveTo(branch, std::move(*reached), fromParent);
    while (cursor.tick() < to)
        if (auto done = cursor.advance(record, way.timeline); !done) return done;
    return {};
}

void TimeTravel::setBeside(std::optional<std::uint32_t> branch) {
    beside_.reset();
    if (!branch || *branch >= branches().size()) return;
    if (auto cursor = lineageAt(*branch, tick())) beside_ = Beside{*branch, std::move(*cursor)};
}

std::optional<std::uint32_t> TimeTravel::beside() const {
    return beside_ ? std::optional(beside_->branch) : std::nullopt;
}

std::size_t TimeTravel::trackBytes() const {
    std::size_t sum = 0;
    for (const BranchRecord& record : records_) sum += record.track().bytes();
    return sum;
}

void TimeTravel::keepTracksSmall() {
    while (trackBytes() > mostTrackBytes_) {
        const auto smaller = [](const BranchRecord& a, const BranchRecord& b) {
            return a.track().bytes() < b.track().bytes();
        };
        if (!std::max_element(records_.begin(), records_.end(), smaller)->track().forgetEarliest()) return;
    }
}

Expected<bool> TimeTravel::learn(std::int64_t ticks) {
    for (std::uint32_t branch = 0; branch < records_.size(); ++branch)
        if (records_[branch].last() < timelineOf(branch).last()) {
            auto more = records_[branch].learn(timelineOf(branch), ticks);
            keepTracksSmall();
            if (!more || *more) return more;
            return learn(0);
        }
    return false;
}

Expected<void> TimeTravel::learnUpTo(std::int64_t tick) {
    for (const Part& part : parts()) {
        BranchRecord& record = records_[part.branch];
        const std::int64_t missing = std::min(tick, part.last) - record.last();
        if (missing <= 0) continue;
        if (auto more = record.learn(timelineOf(part.branch), missing); !more) return tl::unexpected(more.error());
    }
    return {};
}

std::vector<BranchRecord::FirstFault> TimeTravel::faults(std::uint32_t branch, std::int64_t until) const {
    std::vector<BranchRecord::FirstFault> faults;
    for (;;) {
        for (const BranchRecord::FirstFault& fault : records_[branch].faults())
            if (fault.tick <= until) faults.push_back(fault);
        const std::uint32_t parent = branches()[branch].parent;
        if (parent == branch || records_[branch].setupPointer() != records_[parent].setupPointer()) return faults;
        until = std::min(until, branches()[branch].tick);
        branch = parent;
    }
}

}  // namespace mrose
