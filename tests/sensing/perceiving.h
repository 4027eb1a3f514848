#pragma once

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "simulation/observe.h"
#include "simulation/small_world.h"

namespace mrose {

/// Four to five standard errors: with seeds that are fixed a test fails by chance once in a hundred thousand.
constexpr double sigmas = 4.5;

/// Sums up draws that should be independent and standard normal.
struct StandardNormals {
    int count = 0;
    double sum = 0, squares = 0;

    void add(double z) {
        ++count;
        sum += z;
        squares += z * z;
    }
    void expectStandard(const char* what) const {
        EXPECT_NEAR(sum / count, 0, sigmas / std::sqrt(count)) << what;
        EXPECT_NEAR(squares / count, 1, sigmas * std::sqrt(2.0 / count)) << what;
    }
};

inline void expectRate(int hits, int count, double probability) {
    EXPECT_NEAR(static_cast<double>(hits) / count, probability,
                sigmas * std::sqrt(probability * (1 - probability) / count));
}

inline RobotType perceiving(const Perception& perception) {
    RobotType type = discRobot(0.2);
    type.perception = perception;
    return type;
}

/// A type that sees all bodies by the same sensor and knows itself exactly.
inline RobotType seeing(const BodySight& sight) {
    Perception perception;
    perception.objects = perception.robots = sight;
    return perceiving(perception);
}

inline std::shared_ptr<const Controller> still() { return std::make_shared<const Told>(Command{}); }

/// What a robot perceives now, alone.
inline void perceive(const Scenario& scenario, WorldState& state, std::size_t robot, Observation& out) {
    SensingBuffers buffers;
    observe(scenario, state, robot, scenario.sensorMemory(state, robot), buffers, out);
}

/// Asks the sensors of standing robots, control period by control period.
class SensorWatch {
public:
    SensorWatch(const Scenario& scenario, std::uint64_t seed, std::uint32_t robot = 0)
        : scenario_(scenario), state_(scenario.initialState(seed)), robot_(robot) {}

    const Observation& next() {
        perceive(scenario_, state_, robot_, observation_);
        state_.tick += scenario_.periodOf(robot_).ticks;
        return observation_;
    }
    WorldState& state() { return state_; }

private:
    const Scenario& scenario_;
    WorldState state_;
    std::uint32_t robot_;
    Observation observation_;
};

}  // namespace mrose
