#include "time_travel.h"

#include <algorithm>

namespace mrose::gui {
namespace {

/// So long a kick is shown (s).
constexpr Nanoseconds kickShown = nanosecondsPerSecond * 3 / 10;
/// Predicted paths have a point every so many ticks.
constexpr std::int64_t predictedEvery = 5;

std::int64_t ticksToLookBack(const Scene& scene) {
    std::int64_t most = scene.ticksOf(kickShown);
    for (std::size_t robot = 0; robot < scene.robots.size(); ++robot) most = std::max(most, scene.periodTicks(robot));
    return most;
}

}  // namespace

TimeTravel::TimeTravel(std::shared_ptr<const Scenario> scenario, const WorldState& start)
    : scenario_(std::move(scenario)),
      history_(start),
      playback_(*scenario_),
      at_{start},
      lookBack_(ticksToLookBack(scenario_->scene())) {
    known_.push_back({PoseTrack(start), {}, TouchCounter(scenario_->scene().tickLength), start});
    forgetNotes();
}

Expected<void> TimeTravel::forward() {
    if (tick() < last()) {
        if (auto advanced = playback_.advance(timeline(), at_, trace_); !advanced) return advanced;
    } else {
        step(*scenario_, at_.state, buffers_, {}, &trace_);
        history_.add(at_.state, trace_, branch_);
        at_.worldSame = at_.mindsSame = true;
        learn(branch_, at_.state, trace_);
        followWithParent();
    }
    note(trace_);
    return {};
}

/// What would have happened goes on beside what was changed.
void TimeTravel::followWithParent() {
    const std::uint32_t parent = branches()[branch_].parent;
    if (parent == branch_) return;
    WorldState& end = known_[parent].end;
    if (end.tick != branches()[parent].timeline.last()) return;
    StepTrace trace;
    while (end.tick < tick()) {
        step(*scenario_, end, buffers_, {}, &trace);
        history_.add(end, trace, parent);
        learn(parent, end, trace);
    }
}

Expected<void> TimeTravel::seek(std::int64_t tick) { return show(branch_, tick); }

Expected<void> TimeTravel::show(std::uint32_t branch, std::int64_t tick) {
    const Timeline& target = branches()[branch].timeline;
    tick = std::clamp(tick, target.first(), target.last());
    forgetNotes();
    // From a little earlier, so that what robots saw and decided is known.
    return walk(branch, tick - lookBack_, tick);
}

Expected<void> TimeTravel::walk(std::uint32_t branch, std::int64_t from, std::int64_t to) {
    const Branch& way = branches()[branch];
    if (from < way.timeline.first() && way.parent != branch && branches()[way.parent].timeline.last() >= way.tick)
        if (auto walked = walk(way.parent, from, way.tick); !walked) return walked;
    Expected<ReachedState> reached = playback_.reach(way.timeline, std::clamp(from, way.timeline.first(), to));
    if (!reached) return tl::unexpected(reached.error());
    branch_ = branch;
    at_ = std::move(*reached);
    while (tick() < to) {
        if (auto advanced = playback_.advance(way.timeline, at_, trace_); !advanced) return advanced;
        note(trace_);
    }
    return {};
}

void TimeTravel::branchOff(const std::string& name, const std::function<void(const Scenario&, WorldState&)>& change) {
    WorldState state = at_.state;
    change(*scenario_, state);
    const std::uint32_t parent = branch_;
    branch_ = history_.beginBranch(parent, state, name);
    known_.push_back({PoseTrack(state), {}, TouchCounter(scenario_->scene().tickLength), state});
    at_ = {std::move(state)};
    undone_.clear();
    hasTrace_ = false;
    breakReason_.clear();
}

void TimeTravel::rename(std::uint32_t branch, const std::string& name) { history_.rename(branch, name); }

bool TimeTravel::undo() {
    const Branch& left = branches()[branch_];
    if (branch_ == 0) return false;
    const std::uint32_t from = branch_;
    if (!show(left.parent, left.tick)) return false;
    undone_.push_back(from);
    return true;
}

bool TimeTravel::redo() {
    if (undone_.empty()) return false;
    const std::uint32_t to = undone_.back();
    if (!show(to, branches()[to].tick)) return false;
    undone_.pop_back();
    return true;
}

/// Ticks that are new on their branch.
void TimeTravel::learn(std::uint32_t branch, const WorldState& after, const StepTrace& trace) {
    Known& known = known_[branch];
    known.track.add(after);
    known.end = after;
    const auto mark = [&](TimelineMark::Kind kind, std::uint32_t body, std::uint32_t other) {
        known.marks.push_back({after.tick, kind, body, other});
    };
    for (const TouchCounter::Pair& pair : known.touches.add(trace))
        mark(TimelineMark::Kind::contact, pair.first, pair.second);
    for (const StepTrace::Kicked& kick : trace.kicks)
        mark(TimelineMark::Kind::kick, kick.robot, kick.hit ? kick.object : noBody);
    for (const std::uint32_t goal : trace.goals) mark(TimelineMark::Kind::goal, 0, goal);
    for (const StepTrace::Fault& fault : trace.faults) mark(TimelineMark::Kind::fault, fault.robot, noBody);
    for (std::uint32_t robot = 0; robot < trace.robots.size(); ++robot)
        if (trace.robots[robot].decided && !trace.robots[robot].decision.breakReason.empty())
            mark(TimelineMark::Kind::stop, robot, noBody);
}

/// What the window shows of the last ticks.
void TimeTravel::note(const StepTrace& trace) {
    hasTrace_ = true;
    breakReason_.clear();
    for (std::uint32_t robot = 0; robot < trace.robots.size(); ++robot) {
        const StepTrace::Robot& told = trace.robots[robot];
        if (!told.decided) continue;
        insights_[robot] = {tick() - 1, told.observed, told.observation, told.decision, told.predicted};
        if (!told.decision.breakReason.empty())
            breakReason_ = scenario_->scene().robots[robot].name + ": " + told.decision.breakReason;
    }
    const std::int64_t oldest = tick() - scenario_->scene().ticksOf(kickShown);
    std::erase_if(kicks_, [&](const SeenKick& seen) { return seen.tick < oldest; });
    for (const StepTrace::Kicked& kick : trace.kicks) kicks_.push_back({tick(), kick});
}

void TimeTravel::forgetNotes() {
    insights_.assign(at_.state.robots.size(), {});
    kicks_.clear();
    breakReason_.clear();
    hasTrace_ = false;
}

FieldFrame TimeTravel::frame(const FrameOptions& options) const {
    FieldFrame frame;
    frame.scenario = scenario_;
    frame.state = at_.state;
    frame.insights = insights_;
    if (hasTrace_) {
        frame.lastTick = trace_.robots;
        frame.contacts = trace_.contacts;
    }
    for (const SeenKick& seen : kicks_) frame.kicks.push_back(seen.kick);
    addTrails(branch_, tick(), options.trailTicks, frame.trails);
    if (options.ahead > 0 && scenario_->scene().bodyCount() <= options.mostBodiesAhead) {
        frame.predicted = predictedPaths(options.ahead);
        frame.predictedStep = predictedEvery * scenario_->scene().tickLength;
    }
    if (options.ghosts) frame.ghosts = ghostsAt(options.trailTicks);
    return frame;
}

/// Of a branch, and before it of those that it came from.
void TimeTravel::addTrails(std::uint32_t branch, std::int64_t tick, std::size_t ticks, Trails& trails) const {
    const Branch& way = branches()[branch];
    const auto since = static_cast<std::size_t>(std::max<std::int64_t>(0, tick - way.tick));
    if (way.parent != branch && since < ticks) addTrails(way.parent, way.tick, ticks - since, trails);
    known_[branch].track.addTrails(tick, ticks, trails);
}

std::vector<std::vector<Pose>> TimeTravel::predictedPaths(Nanoseconds ahead) const {
    std::vector<std::vector<Pose>> paths(at_.state.robots.size());
    WorldState state = at_.state;
    StepBuffers buffers;
    const std::int64_t end = tick() + scenario_->scene().ticksOf(ahead);
    for (;;) {
        for (std::size_t robot = 0; robot < paths.size(); ++robot) paths[robot].push_back(state.robots[robot].pose);
        if (state.tick >= end) return paths;
        for (std::int64_t i = 0; i < predictedEvery; ++i) step(*scenario_, state, buffers, {{}, false});
    }
}

/// The branch from which the shown one departed, and those that departed from it: what was changed is seen beside it.
std::vector<Ghost> TimeTravel::ghostsAt(std::size_t trailTicks) const {
    std::vector<Ghost> ghosts;
    for (std::uint32_t other = 0; other < branches().size(); ++other) {
        const bool related =
            other != branch_ && (branches()[branch_].parent == other || branches()[other].parent == branch_);
        const PoseTrack& track = known_[other].track;
        if (!related || tick() < branches()[other].tick || tick() < track.first()) continue;
        const std::int64_t departed = std::max(branches()[other].tick, branches()[branch_].tick);
        if (tick() < departed) continue;
        const std::int64_t then = std::min(tick(), track.last());
        const auto since = static_cast<std::size_t>(std::max<std::int64_t>(0, then - departed));
        Ghost& ghost = ghosts.emplace_back(Ghost{branches()[other].name, track.posesAt(then), {}});
        track.addTrails(then, std::min(trailTicks, since), ghost.trails);
    }
    return ghosts;
}

}  // namespace mrose::gui
