#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "assessment/compared_sensors.h"
#include "assessment/rollout_requests.h"
#include "sensing/sensing_buffers.h"

namespace mrose {

/// What the sensors of one pair (SensorPair) reported, by rollout, robot and time.
struct LookStreams {
    std::vector<SensedLook> real, simulated;
};

/// Collects what sensors report in one rollout, real and simulated. The simulated ones are looked through beside the
/// simulation, so that neither its state nor its bits depend on it, and by draws of this rollout alone: rollouts of one
/// seed would otherwise repeat each other's errors.
///
/// Looks count that were measured and reported within the rollout, at instants at which ground truth says where the
/// real robot was; simulated ones where the real sensor is known to have looked too, no further from one of its looks
/// than these usually are from each other. Where a log holds only what was seen, and its reader has added the empty
/// looks of short pauses, the simulated sensor's empty looks are kept by that same rule instead: of its own pauses. A
/// sensor is taken to measure its simulated one's latency before its stamp. Subjects count that both have: landmarks of
/// the environment by their names, and the compared robots that are in this world, where the log says where they were.
class RolloutReadings {
public:
    /// They must outlive it.
    RolloutReadings(const LogWorld& world, const LogWorld::Opened& opened, const RolloutRequest& request,
                    Nanoseconds length, std::span<const SensorPair> pairs, std::uint64_t seed);

    /// Before each step of the opened world. The state is as it was when this comes back.
    void observeBefore(WorldState& state);

    /// By pair; `request` of the looks is 0.
    std::vector<LookStreams> looks() const;

private:
    /// One robot's sensor of a pair.
    struct Source {
        std::size_t pair, robot;
        const Sensor* sensor;
        const SensorLog* log;
        Nanoseconds last;   ///< measurements count from 0 on to here
        Nanoseconds pause;  ///< median between the log's looks
        bool landmarks, robots;
        bool onlySeen;  ///< the log does not hold all empty looks
    };
    void addSources(std::size_t robot, Nanoseconds length);
    bool counts(const Source& source, Nanoseconds measured) const;
    void addSimulated(const Source& source, const WorldState& state, const Observation& observation);
    void addSeen(const Source& source, const WorldState& state, Nanoseconds measured, std::span<const SeenBody> seen,
                 bool landmarks);
    SensedLook simulatedLook(const Source& source, const WorldState& state, Nanoseconds measured) const;
    SensedLook realLook(const Source& source, const Look& look) const;
    const Trajectory& trajectoryOf(std::size_t robot) const { return world_.trajectory(request_.session, robot); }
    Nanoseconds realTime(std::size_t robot, Nanoseconds time) const {
        return world_.sessions()[request_.session].parts[robot].origin + request_.start + time;
    }

    const LogWorld& world_;
    const LogWorld::Opened& opened_;
    RolloutRequest request_;
    std::span<const SensorPair> pairs_;
    std::uint64_t seed_;
    WorldSubjects subjects_;
    std::vector<Source> sources_;
    std::unique_ptr<const Scenario> watched_;       ///< the opened one, whose controllers read what is compared
    std::vector<std::vector<std::byte>> memories_;  ///< by scene robot: of its sensors; empty: not compared
    SensingBuffers buffers_;
    Observation observation_;
    std::vector<LookStreams> streams_;  ///< of the simulated
};

}  // namespace mrose
