#include "debug/run_frame.h"

#include <algorithm>
#include <optional>
#include <set>

#include "debug/sensor_scans.h"

namespace mrose {
namespace {

/// Predicted paths have a point every so many ticks.
constexpr std::int64_t predictedEvery = 5;

const std::shared_ptr<const Scenario>& scenarioOf(const BranchTree& branches, std::uint32_t branch) {
    return branches.record(branch).setup().scenario;
}

/// Of a branch, and before it of those that it came from, where they have the same bodies.
void addTrails(const BranchTree& branches, std::uint32_t branch, std::int64_t tick, std::size_t ticks, Trails& trails) {
    const Branch& way = branches[branch];
    const auto since = static_cast<std::size_t>(std::max<std::int64_t>(0, tick - way.tick));
    if (way.parent != branch && since < ticks &&
        scenarioOf(branches, branch)->scene().bodyCount() == scenarioOf(branches, way.parent)->scene().bodyCount())
        addTrails(branches, way.parent, way.tick, ticks - since, trails);
    branches.record(branch).track().addTrails(tick, ticks, trails);
}

std::vector<std::vector<Pose>> predictedPaths(const Scenario& scenario, const Cursor& at, Nanoseconds ahead) {
    WorldState state = at.state();
    std::vector<std::vector<Pose>> paths(state.robots.size());
    StepBuffers buffers;
    const std::int64_t end = at.tick() + scenario.scene().ticksOf(ahead);
    for (;;) {
        for (std::size_t robot = 0; robot < paths.size(); ++robot) paths[robot].push_back(state.robots[robot].pose);
        if (state.tick >= end) return paths;
        for (std::int64_t i = 0; i < predictedEvery; ++i) step(scenario, state, buffers, {{}, false});
    }
}

/// The branch from which the shown one departed, those that departed from it, and the one beside: what was changed is
/// seen with what was before.
std::vector<Ghost> ghostsOf(const TimeTravel& run, const Cursor& at, std::size_t trailTicks) {
    const BranchTree& branches = run.branches();
    std::vector<Ghost> ghosts;
    const std::uint32_t own = at.branch();
    const std::int64_t then = at.tick();
    for (std::uint32_t other = 0; other < branches.size(); ++other) {
        const bool related = other != own && !run.hidden(other) &&
                             (branches[own].parent == other || branches[other].parent == own || run.beside() == other);
        const PoseTrack& track = branches.record(other).track();
        const bool sameClock =
            scenarioOf(branches, other)->scene().tickLength == scenarioOf(branches, own)->scene().tickLength;
        const std::int64_t departed = std::max(branches[other].tick, branches[own].tick);
        if (!related || !sameClock || then < std::max(departed, track.first()) || then > track.last()) continue;
        const auto since = static_cast<std::size_t>(std::max<std::int64_t>(0, then - departed));
        Ghost& ghost =
            ghosts.emplace_back(Ghost{branches[other].name, scenarioOf(branches, other), track.posesAt(then), {}});
        track.addTrails(then, std::min(trailTicks, since), ghost.trails);
    }
    return ghosts;
}

/// Between two ticks evenly; nullopt where it is forgotten where bodies were, or there were others.
std::optional<std::vector<Pose>> posesAt(const BranchTree& branches, const Cursor& at, Nanoseconds time) {
    const Scene& scene = scenarioOf(branches, at.branch())->scene();
    // Before the start all stood where it starts.
    const std::int64_t first = branches.first(at.branch());
    const Nanoseconds since = std::max<Nanoseconds>(0, time - scene.timeOf(first));
    const std::int64_t tick = first + since / scene.tickLength;
    auto poses = branches.posesAt(at.branch(), tick);
    if (!poses || poses->size() != scene.bodyCount()) return std::nullopt;
    const double share = static_cast<double>(since % scene.tickLength) / static_cast<double>(scene.tickLength);
    if (share == 0 || tick >= at.tick()) return poses;
    const auto next = branches.posesAt(at.branch(), tick + 1);
    if (!next || next->size() != poses->size()) return poses;
    for (std::size_t body = 0; body < poses->size(); ++body) {
        Pose& pose = (*poses)[body];
        const Pose& then = (*next)[body];
        pose = {pose.x + share * (then.x - pose.x), pose.y + share * (then.y - pose.y),
                pose.heading + share * wrapAngle(then.heading - pose.heading)};
    }
    return poses;
}

/// Where bodies were when what robots were given last was measured.
void addMeasured(const BranchTree& branches, const Cursor& at, FieldFrame& frame) {
    std::set<Nanoseconds> times;
    for (std::size_t robot = 0; robot < frame.insights.size(); ++robot)
        for (const NewestReading& known : newestReadings(frame.moment(), robot))
            if (*known.reading->type == recordType<SeenBody>() || isScan(known)) times.insert(known.reading->measured);
    for (const Nanoseconds time : times)
        if (auto poses = posesAt(branches, at, time)) frame.measured.push_back({time, std::move(*poses)});
}

}  // namespace

FieldFrame frameOf(const TimeTravel& run, const FrameOptions& options) { return frameOf(run, run.cursor(), options); }

std::optional<FieldFrame> besideFrame(const TimeTravel& run, const FrameOptions& options) {
    const Cursor* const at = run.besideCursor();
    if (at == nullptr) return {};
    FrameOptions own = options;
    own.ghosts = false;
    return frameOf(run, *at, own);
}

FieldFrame frameOf(const TimeTravel& run, const Cursor& at, const FrameOptions& options) {
    const BranchTree& branches = run.branches();
    const std::shared_ptr<const Scenario>& scenario = scenarioOf(branches, at.branch());
    FieldFrame frame = at.frame(scenario);
    frame.reality = run.reality();
    for (const BranchRecord::FirstFault& fault : branches.faults(at.branch(), at.tick()))
        frame.failed.push_back(fault.robot);
    addTrails(branches, at.branch(), at.tick(), options.trailTicks, frame.trails);
    if (options.ahead > 0 && frame.scene().bodyCount() <= options.mostBodiesAhead) {
        frame.predicted = predictedPaths(*scenario, at, options.ahead);
        frame.predictedStep = predictedEvery * frame.scene().tickLength;
    }
    addMeasured(branches, at, frame);
    if (options.ghosts) frame.ghosts = ghostsOf(run, at, options.trailTicks);
    return frame;
}

}  // namespace mrose
