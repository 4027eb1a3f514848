#include "assessment/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "assessment/truth_jumps.h"
#include "io/format.h"
#include "learning/parallel_for.h"
#include "logs/pose_grid.h"
#include "simulation/run_statistics.h"
#include "simulation/touch_counter.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

constexpr std::size_t reportedRollouts = 16;
constexpr int stepsBefore = 2;  // as the referee's windows, a start needs truth without a gap so long before

/// One rollout of all robots.
struct Driven {
    std::vector<ComparedRollout> robots;
    std::vector<LookStreams> looks;  ///< by pair of sensors
    std::int64_t touches = 0, faults = 0;
    std::string firstFault;
};

Pose knownTruth(const Trajectory& trajectory, Nanoseconds time) {
    return truthIsKnown(trajectory.poses, time) ? truthAt(trajectory.poses, time)
                                                : Pose{unknownNumber, unknownNumber, unknownNumber};
}

bool gapBefore(const Trajectory& trajectory, Nanoseconds start, Nanoseconds step) {
    for (int k = 1; k <= stepsBefore; ++k) {
        const Nanoseconds time = start - k * step;
        if (time >= trajectory.poses.front().time && !truthIsKnown(trajectory.poses, time)) return true;
    }
    return false;
}

std::vector<std::size_t> stepsOfJumps(const Trajectory& trajectory, Nanoseconds start, int steps, Nanoseconds step) {
    std::vector<std::size_t> jumps;
    const Nanoseconds end = start + steps * step;
    for (const TruthJump& jump : truthJumps(trajectory, start - truthSmoothed, end + truthSmoothed)) {
        const auto stepOf = [&](Nanoseconds time) { return std::max<Nanoseconds>(0, time - start + step - 1) / step; };
        const auto first = static_cast<std::size_t>(stepOf(jump.before - truthSmoothed + 1)),
                   last = static_cast<std::size_t>(stepOf(std::min(end, jump.after + truthSmoothed)));
        for (std::size_t k = std::max({first, std::size_t{1}, jumps.empty() ? 0 : jumps.back() + 1}); k <= last; ++k)
            jumps.push_back(k);
    }
    return jumps;
}

/// What the real robot did.
ComparedRollout realRollout(const LogWorld& world, const RolloutRequest& request, std::size_t robot,
                            const std::optional<RolloutStart>& start, const WindowOptions& options) {
    const LogSession::Part& part = world.sessions()[request.session].parts[robot];
    const Trajectory& trajectory = world.trajectory(request.session, robot);
    ComparedRollout rollout;
    rollout.robot = robot;
    Window& real = rollout.real;
    real.robot = world.robots()[robot].real;
    real.trajectory = part.trajectory;
    real.start = part.origin + request.start;
    real.steady = trajectory.steady;
    for (int k = 0; k <= request.steps; ++k)
        real.truth.push_back(knownTruth(trajectory, real.start + k * options.step));
    rollout.jumps = stepsOfJumps(trajectory, real.start, request.steps, options.step);
    if (start) {
        real.measuredPose = start->pose;
        real.measuredVelocity = start->velocity;
        rollout.tracked = start->tracked;
    }
    const bool moves = measureTravel(real, options);
    const bool gap = std::isnan(real.pathBySteps) || gapBefore(trajectory, real.start, options.step);
    rollout.use = !start ? RolloutUse::absent : gap ? RolloutUse::gap : moves ? RolloutUse::counted : RolloutUse::still;
    return rollout;
}

/// Steps the opened world through the rollout.
void simulate(LogWorld::Opened& opened, const RolloutRequest& request, Nanoseconds step, RolloutReadings& readings,
              Driven& driven) {
    const Scenario& scenario = *opened.scenario;
    const Nanoseconds tick = scenario.scene().tickLength;
    StepBuffers buffers;
    StepTrace trace;
    TouchCounter counter(tick);
    for (int k = 0; k < request.steps; ++k) {
        for (Nanoseconds passed = 0; passed < step; passed += tick) {
            readings.observeBefore(opened.state);
            mrose::step(scenario, opened.state, buffers, {}, &trace);
            const auto begun = counter.add(trace);
            driven.touches += static_cast<std::int64_t>(begun.size());
            driven.faults += static_cast<std::int64_t>(trace.faults.size());
            if (driven.firstFault.empty() && !trace.faults.empty())
                driven.firstFault = bodyName(scenario.scene(), trace.faults[0].robot) + ": " + trace.faults[0].what;
            for (ComparedRollout& rollout : driven.robots) {
                if (rollout.use == RolloutUse::absent) continue;
                const std::size_t body = opened.bodies[rollout.robot];
                rollout.touches += std::count_if(begun.begin(), begun.end(), [&](const TouchCounter::Pair& pair) {
                    return pair.first == body || pair.second == body;
                });
                if (trace.robots[body].touched && !rollout.touched)
                    rollout.touched = scenario.scene().timeOf(opened.state.tick);
            }
        }
        for (ComparedRollout& rollout : driven.robots)
            if (rollout.use != RolloutUse::absent)
                rollout.simulated.push_back(opened.state.robots[opened.bodies[rollout.robot]].pose);
    }
}

Driven drive(const LogWorld& world, const RolloutRequest& request, std::span<const SensorPair> sensors,
             const ComparisonOptions& options) {
    const Nanoseconds step = options.windows.step;
    LogWorld::Opened opened = world.openAt(request.session, request.start, request.steps * step, options.seed);
    Driven driven;
    for (std::size_t robot = 0; robot < world.robots().size(); ++robot)
        if (!request.robot || *request.robot == robot)
            driven.robots.push_back(realRollout(world, request, robot, opened.starts[robot], options.windows));
    RolloutReadings readings(world, opened, request, request.steps * step, sensors, options.seed);
    simulate(opened, request, step, readings, driven);
    driven.looks = readings.looks();
    for (ComparedRollout& rollout : driven.robots) rollout.errors = windowErrors(rollout.real.truth, rollout.simulated);
    return driven;
}

bool reportProgress(std::span<const Driven> part, std::size_t done, std::size_t all, const ComparisonOptions& options) {
    std::vector<ComparedRollout> rollouts;
    for (const Driven& driven : part) rollouts.insert(rollouts.end(), driven.robots.begin(), driven.robots.end());
    return options.progress(rollouts, static_cast<double>(done) / static_cast<double>(all));
}

template <class Belongs>
ComparedSummary summarised(const Comparison& comparison, Belongs belongs) {
    ComparedSummary summary;
    std::vector<double> position, heading;
    for (const ComparedRollout& rollout : comparison.rollouts) {
        if (!belongs(rollout)) continue;
        ++summary.uses[static_cast<std::size_t>(rollout.use)];
        summary.touches += rollout.touches;
        summary.touched += rollout.touched ? 1 : 0;
        if (rollout.simulated.empty() || std::isnan(rollout.errors.positionFinal)) continue;
        position.push_back(rollout.errors.positionFinal);
        heading.push_back(rollout.errors.headingFinal);
    }
    summary.positionFinal = distribution(std::move(position));
    summary.headingFinal = distribution(std::move(heading));
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < comparison.counted.size(); ++i)
        if (belongs(comparison.rollouts[comparison.counted[i]])) chosen.push_back(i);
    summary.counted = summarise(comparison.log.windows, comparison.simulation.errors, chosen, comparison.log.options);
    return summary;
}

/// One after the other, of all rollouts.
void append(std::vector<SensedLook>& all, std::vector<SensedLook>&& looks, std::size_t request) {
    for (SensedLook& look : looks) {
        look.request = request;
        all.push_back(std::move(look));
    }
}

std::vector<ComparedSensor> comparedSensors(std::span<const SensorPair> sensors, std::vector<Driven>& driven,
                                            std::span<const RolloutRequest> requests) {
    std::vector<ComparedSensor> compared;
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        LookStreams all;
        for (std::size_t request = 0; request < driven.size(); ++request) {
            LookStreams& looks = driven[request].looks[i];
            append(all.real, std::move(looks.real), request);
            append(all.simulated, std::move(looks.simulated), request);
        }
        compared.push_back(compareStreams(sensors[i], std::move(all), requests));
    }
    return compared;
}

void summariseAll(const LogWorld& world, const WindowOptions& options, Comparison& comparison) {
    std::vector<Window> windows;
    std::vector<std::vector<Pose>> simulated;
    for (std::size_t i = 0; i < comparison.rollouts.size(); ++i) {
        const ComparedRollout& rollout = comparison.rollouts[i];
        if (rollout.use != RolloutUse::counted) continue;
        comparison.counted.push_back(i);
        windows.push_back(rollout.real);
        simulated.push_back(rollout.simulated);
    }
    classifyManoeuvres(world.log(), windows, options.step);
    comparison.log = logWindows(world.log(), std::move(windows), options);
    comparison.simulation = assess(comparison.log, "simulation", std::move(simulated));
    for (std::size_t robot = 0; robot < comparison.robots.size(); ++robot)
        comparison.summaries.push_back(
            summarised(comparison, [&](const ComparedRollout& rollout) { return rollout.robot == robot; }));
    comparison.all = summarised(comparison, [](const ComparedRollout&) { return true; });
}

}  // namespace

const char* name(RolloutUse use) {
    switch (use) {
        case RolloutUse::still:
            return "still";
        case RolloutUse::gap:
            return "gap";
        case RolloutUse::absent:
            return "absent";
        case RolloutUse::counted:
            break;
    }
    return "counted";
}

Expected<Comparison> compare(const LogWorld& world, std::span<const RolloutRequest> requests,
                             const ComparisonOptions& options) {
    const Nanoseconds tick = world.parts().scene.tickLength, step = options.windows.step;
    if (step % tick != 0)
        return fail({},
                    "is " + secondsText(tick) + "; expected one that divides " + secondsText(step) +
                        " s, the step of the comparison",
                    0, "tick_s");
    const std::vector<SensorPair> sensors = options.readings ? sensorPairs(world) : std::vector<SensorPair>();
    std::vector<Driven> driven(requests.size());
    const std::size_t part = options.progress ? reportedRollouts : std::max<std::size_t>(1, requests.size());
    for (std::size_t from = 0; from < requests.size(); from += part) {
        const std::size_t to = std::min(requests.size(), from + part);
        parallelFor(to - from,
                    [&](std::size_t i) { driven[from + i] = drive(world, requests[from + i], sensors, options); });
        for (std::size_t i = from; i < to; ++i)
            for (ComparedRollout& rollout : driven[i].robots) rollout.request = i;
        if (options.progress && !reportProgress({driven.data() + from, to - from}, to, requests.size(), options))
            return fail(world.log().source, "was not compared: cancelled");
    }
    Comparison comparison;
    comparison.scenario = world.parts().name;
    comparison.seed = options.seed;
    comparison.robots = world.robots();
    for (const LogSession& session : world.sessions()) comparison.sessions.push_back(session.name);
    comparison.requests.assign(requests.begin(), requests.end());
    for (std::size_t i = 0; i < driven.size(); ++i) {
        comparison.touches += driven[i].touches;
        comparison.faults += driven[i].faults;
        if (comparison.firstFault.empty()) comparison.firstFault = driven[i].firstFault;
        for (ComparedRollout& rollout : driven[i].robots) comparison.rollouts.push_back(std::move(rollout));
    }
    if (std::all_of(comparison.rollouts.begin(), comparison.rollouts.end(),
                    [](const ComparedRollout& rollout) { return rollout.use == RolloutUse::absent; }))
        return fail(world.log().source,
                    "has no ground truth of any compared robot where a rollout starts; expected another start");
    summariseAll(world, options.windows, comparison);
    for (const LogSubject& subject : world.log().subjects) comparison.subjects.push_back(subject.name);
    comparison.sensors = comparedSensors(sensors, driven, requests);
    if (!sensors.empty()) {
        const std::vector<LogFile>& measured = world.log().measurementFiles;
        comparison.log.files.insert(comparison.log.files.end(), measured.begin(), measured.end());
    }
    return comparison;
}

double knownMean(const ComparedRollout& rollout) {
    double sum = 0;
    int count = 0;
    for (const double error : rollout.errors.position) {
        if (std::isnan(error)) continue;
        sum += error;
        ++count;
    }
    return count == 0 ? -1 : sum / count;
}

std::vector<std::size_t> worstFirst(const Comparison& comparison) {
    std::vector<std::size_t> order;
    std::vector<double> errors;
    for (std::size_t i = 0; i < comparison.rollouts.size(); ++i) {
        errors.push_back(knownMean(comparison.rollouts[i]));
        if (comparison.rollouts[i].use != RolloutUse::absent) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return errors[a] > errors[b]; });
    return order;
}

}  // namespace mrose
