#include "assessment/rollout_readings.h"

#include <algorithm>
#include <utility>

#include "geometry/angle.h"
#include "geometry/elementary.h"
#include "logs/log_lookup.h"
#include "logs/looks.h"
#include "logs/pose_grid.h"
#include "sensing/sensor.h"
#include "simulation/observe.h"
#include "world/noise.h"

namespace mrose {
namespace {

/// Another controller, as if it read some sensors and nothing else: states of both have the same form.
class Onlooker final : public Controller {
public:
    Onlooker(std::shared_ptr<const Controller> of, std::vector<ReadingName> reads)
        : of_(std::move(of)), attention_(Attention::only(std::move(reads))) {}
    std::size_t memorySize() const override { return of_->memorySize(); }
    std::size_t commandsPerPeriod(Nanoseconds period) const override { return of_->commandsPerPeriod(period); }
    Attention attention() const override { return attention_; }
    void decide(const Observation&, std::span<std::byte>, Decision&) const override {}

private:
    std::shared_ptr<const Controller> of_;
    Attention attention_;
};

/// Where a body was at an instant that is no later than the state's, as far back as sensors read.
Pose poseAt(const Scenario& scenario, const WorldState& state, std::size_t body, Nanoseconds time) {
    const Nanoseconds tick = scenario.scene().tickLength, ago = scenario.scene().timeOf(state.tick) - time;
    const std::int64_t lag = ago / tick;
    if (lag >= scenario.pastDepth()) return scenario.poseBefore(state, body, scenario.pastDepth());
    return scenario.past().poseBetween(state, body, lag, static_cast<double>(ago % tick) / static_cast<double>(tick));
}

/// A subject at a place, as a robot has it before it.
SensedSubject sensedFrom(const Pose& own, std::size_t subject, const Point& place, const SensorField& field) {
    const Point offset = place - position(own);
    SensedSubject sensed;
    sensed.subject = subject;
    sensed.range = length(offset);
    sensed.bearing = wrapAngleNearly(arcTangent(offset.y, offset.x) - own.heading);
    sensed.inView = field.holds(sensed.range, sensed.bearing);
    return sensed;
}

void report(SensedSubject& sensed, double range, double bearing) {
    sensed.reported = true;
    sensed.rangeError = range - sensed.range;
    sensed.bearingError = wrapAngle(bearing - sensed.bearing);
}

void leaveOutUnseen(SensedLook& look) {
    std::erase_if(look.subjects, [](const SensedSubject& subject) { return !subject.inView && !subject.reported; });
}

Nanoseconds medianPause(const std::vector<Look>& looks) {
    std::vector<Nanoseconds> pauses;
    for (std::size_t i = 1; i < looks.size(); ++i) pauses.push_back(looks[i].time - looks[i - 1].time);
    if (pauses.empty()) return 0;
    const auto middle = pauses.begin() + static_cast<std::ptrdiff_t>(pauses.size() / 2);
    std::nth_element(pauses.begin(), middle, pauses.end());
    return *middle;
}

bool lookedThen(const std::vector<Look>& looks, Nanoseconds stamp, Nanoseconds pause) {
    const auto next = std::ranges::lower_bound(looks, stamp, {}, &Look::time);
    return (next != looks.end() && next->time - stamp <= pause) ||
           (next != looks.begin() && stamp - std::prev(next)->time <= pause);
}

/// Leaves out a robot's empty looks of which more follow each other than a log of what was seen would show.
void leaveOutPauses(std::vector<SensedLook>& looks, std::size_t robot) {
    std::vector<SensedLook> kept;
    for (auto look = looks.begin(); look != looks.end();) {
        const auto next = std::find_if(look, looks.end(),
                                       [&](const SensedLook& other) { return other.robot != robot || !other.empty(); });
        if (next - look <= mostEmptyLooks) std::move(look, next, std::back_inserter(kept));
        look = next;
        if (look != looks.end()) kept.push_back(std::move(*look++));
    }
    looks = std::move(kept);
}

std::uint64_t seedOf(const RolloutRequest& request, std::uint64_t seed) {
    return noiseBits({seed, request.start, static_cast<std::uint32_t>(request.session), 0});
}

}  // namespace

RolloutReadings::RolloutReadings(const LogWorld& world, const LogWorld::Opened& opened, const RolloutRequest& request,
                                 Nanoseconds length, std::span<const SensorPair> pairs, std::uint64_t seed)
    : world_(world),
      opened_(opened),
      request_(request),
      pairs_(pairs),
      seed_(seedOf(request, seed)),
      subjects_(world, opened),
      streams_(pairs.size()) {
    for (std::size_t robot = 0; robot < world.robots().size(); ++robot)
        if (opened.starts[robot] && (!request.robot || *request.robot == robot)) addSources(robot, length);
    if (sources_.empty()) return;
    ScenarioParts parts = opened.scenario->parts();
    const WorldState start = opened.state;
    memories_.resize(start.robots.size());
    for (std::size_t robot = 0; robot < world.robots().size(); ++robot) {
        std::vector<ReadingName> reads;
        for (const Source& source : sources_) {
            if (source.robot != robot) continue;
            if (source.landmarks) reads.push_back(pairs[source.pair].landmarks());
            if (source.robots) reads.push_back(pairs[source.pair].robots());
        }
        if (reads.empty()) continue;
        const std::size_t body = opened.bodies[robot];
        parts.controllers[body] = std::make_shared<const Onlooker>(parts.controllers[body], std::move(reads));
        const auto memory = opened.scenario->sensorMemory(start, body);
        memories_[body].assign(memory.begin(), memory.end());
    }
    watched_ = std::make_unique<const Scenario>(std::move(parts));
}

void RolloutReadings::addSources(std::size_t robot, Nanoseconds length) {
    for (std::size_t pair = 0; pair < pairs_.size(); ++pair) {
        const Sensor* const sensor = pairs_[pair].sensors[robot].get();
        const SensorLog* const log = sensor == nullptr ? nullptr : findSensor(trajectoryOf(robot), pairs_[pair].name);
        if (log == nullptr || log->looks.empty()) continue;
        // The last control instant of the rollout may be a period before its end.
        const Nanoseconds period = opened_.scenario->scene().modelOf(opened_.bodies[robot]).period();
        sources_.push_back({pair, robot, sensor, log, length - period - sensor->latency(), medianPause(log->looks),
                            gives(*sensor, pairs_[pair].landmarks()), gives(*sensor, pairs_[pair].robots()),
                            log->defects.emptyLooks > 0});
    }
}

bool RolloutReadings::counts(const Source& source, Nanoseconds measured) const {
    if (measured < 0 || measured > source.last) return false;
    const Nanoseconds time = realTime(source.robot, measured), stamp = time + source.sensor->latency();
    if (!truthIsKnown(trajectoryOf(source.robot).poses, time)) return false;
    const std::vector<Look>& looks = source.log->looks;
    return source.onlySeen ? stamp >= looks.front().time && stamp <= looks.back().time
                           : lookedThen(looks, stamp, source.pause);
}

void RolloutReadings::observeBefore(WorldState& state) {
    for (std::size_t i = 0; i < sources_.size(); ++i) {
        const std::size_t robot = sources_[i].robot, body = opened_.bodies[robot];
        const bool seen = i > 0 && sources_[i - 1].robot == robot;  // in the same observation
        if (seen || state.robots[body].nextControl != state.tick) continue;
        buffers_.forget();
        const std::uint64_t ownSeed = std::exchange(state.seed, seed_);
        observe(*watched_, state, body, memories_[body], buffers_, observation_);
        state.seed = ownSeed;
        for (std::size_t k = i; k < sources_.size() && sources_[k].robot == robot; ++k)
            addSimulated(sources_[k], state, observation_);
    }
}

void RolloutReadings::addSimulated(const Source& source, const WorldState& state, const Observation& observation) {
    const SensorPair& pair = pairs_[source.pair];
    for (const Reading& reading : observation.readings()) {
        const bool landmarks = reading.name == pair.landmarks();
        if ((!landmarks && reading.name != pair.robots()) || !counts(source, reading.measured)) continue;
        addSeen(source, state, reading.measured, observation.records<SeenBody>(&reading), landmarks);
    }
}

void RolloutReadings::addSeen(const Source& source, const WorldState& state, Nanoseconds measured,
                              std::span<const SeenBody> seen, bool landmarks) {
    std::vector<SensedLook>& looks = streams_[source.pair].simulated;
    const auto sameLook = std::find_if(looks.rbegin(), looks.rend(), [&](const SensedLook& look) {
        return look.robot == source.robot && look.time <= measured;
    });
    const bool known = sameLook != looks.rend() && sameLook->time == measured;
    SensedLook& look = known ? *sameLook : looks.emplace_back(simulatedLook(source, state, measured));
    const auto& subjectOf = landmarks ? subjects_.ofLandmark : subjects_.ofSceneRobot;
    for (const SeenBody& body : seen) {
        if (body.index >= subjectOf.size() || !subjectOf[body.index]) continue;
        const auto sensed = std::ranges::find(look.subjects, *subjectOf[body.index], &SensedSubject::subject);
        if (sensed != look.subjects.end())
            report(*sensed, length(body.position_B), arcTangent(body.position_B.y, body.position_B.x));
    }
}

SensedLook RolloutReadings::simulatedLook(const Source& source, const WorldState& state, Nanoseconds measured) const {
    const Scenario& scenario = *opened_.scenario;
    const SensorField field = fieldOf(*source.sensor);
    const Pose own = poseAt(scenario, state, opened_.bodies[source.robot], measured);
    SensedLook look{0, source.robot, measured, {}};
    for (std::size_t i = 0; i < subjects_.robots.size(); ++i) {
        if (source.landmarks && subjects_.landmarks[i])
            look.subjects.push_back(sensedFrom(own, i, *subjects_.landmarks[i], field));
        if (!source.robots || !subjects_.robots[i] || *subjects_.robots[i] == source.robot) continue;
        const Pose other = poseAt(scenario, state, opened_.bodies[*subjects_.robots[i]], measured);
        look.subjects.push_back(sensedFrom(own, i, position(other), field));
    }
    return look;
}

SensedLook RolloutReadings::realLook(const Source& source, const Look& real) const {
    const SensorField field = fieldOf(*source.sensor);
    const Nanoseconds time = real.time - source.sensor->latency(), measured = time - realTime(source.robot, 0);
    const Pose own = truthAt(trajectoryOf(source.robot).poses, time);
    SensedLook look{0, source.robot, measured, {}};
    for (std::size_t i = 0; i < subjects_.robots.size(); ++i) {
        if (source.landmarks && subjects_.landmarks[i])
            look.subjects.push_back(sensedFrom(own, i, *world_.log().subjects[i].position, field));
        if (!source.robots || !subjects_.robots[i] || *subjects_.robots[i] == source.robot) continue;
        const std::size_t other = *subjects_.robots[i];
        const auto& poses = trajectoryOf(other).poses;
        const Nanoseconds then = realTime(other, measured);
        if (truthIsKnown(poses, then))
            look.subjects.push_back(sensedFrom(own, i, position(truthAt(poses, then)), field));
    }
    for (const LogReading& reading : real.readings) {
        const auto sensed = std::ranges::find(look.subjects, reading.subject, &SensedSubject::subject);
        if (sensed != look.subjects.end()) report(*sensed, reading.range, reading.bearing);
    }
    return look;
}

std::vector<LookStreams> RolloutReadings::looks() const {
    std::vector<LookStreams> streams = streams_;
    for (const Source& source : sources_)
        for (const Look& look : source.log->looks)
            if (counts(source, look.time - source.sensor->latency() - realTime(source.robot, 0)))
                streams[source.pair].real.push_back(realLook(source, look));
    for (LookStreams& both : streams)
        for (std::vector<SensedLook>* const looks : {&both.real, &both.simulated}) {
            std::ranges::for_each(*looks, leaveOutUnseen);
            std::ranges::stable_sort(*looks, {},
                                     [](const SensedLook& look) { return std::pair(look.robot, look.time); });
        }
    for (const Source& source : sources_)
        if (source.onlySeen) leaveOutPauses(streams[source.pair].simulated, source.robot);
    return streams;
}

}  // namespace mrose
