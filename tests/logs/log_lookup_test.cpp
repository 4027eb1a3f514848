#include "logs/log_lookup.h"

#include <gtest/gtest.h>

namespace mrose {
namespace {

RobotLog robotWith(const std::vector<std::string>& trajectories) {
    RobotLog robot;
    for (const std::string& name : trajectories) robot.trajectories.emplace_back().name = name;
    return robot;
}

SensorLog sensorNamed(const std::string& name, std::vector<Look> looks = {}) {
    SensorLog sensor;
    sensor.sensor = name;
    sensor.looks = std::move(looks);
    return sensor;
}

TEST(LogLookup, BesideATrajectoryIsTheOneOfItsNameOrTheOnlyOne) {
    Trajectory own;
    own.name = "2";
    const RobotLog several = robotWith({"1", "2", "3"}), one = robotWith({"1"}), others = robotWith({"1", "3"});
    EXPECT_EQ(trajectoryBeside(own, several), &several.trajectories[1]);
    EXPECT_EQ(trajectoryBeside(own, one), &one.trajectories[0]);
    EXPECT_EQ(trajectoryBeside(own, others), nullptr);
    EXPECT_EQ(trajectoryBeside(own, robotWith({})), nullptr);
}

TEST(LogLookup, SensorsAreFoundByTheirNames) {
    RobotLog robot = robotWith({"1", "2"}), other = robotWith({"1"});
    robot.trajectories[0].sensors = {sensorNamed("camera"), sensorNamed("slam")};
    robot.trajectories[1].sensors = {sensorNamed("camera", {{0, {}}})};
    other.trajectories[0].sensors = {sensorNamed("sonar"), sensorNamed("slam")};
    EXPECT_EQ(findSensor(robot.trajectories[0], "slam"), &robot.trajectories[0].sensors[1]);
    EXPECT_EQ(findSensor(robot.trajectories[1], "slam"), nullptr);
    EXPECT_TRUE(hasLooks(robot, "camera")) << "in one of the two";
    EXPECT_FALSE(hasLooks(robot, "slam"));
    EXPECT_FALSE(hasLooks(other, "camera"));
    Log log;
    log.robots = {robot, other};
    EXPECT_EQ(sensorNames(log), (std::vector<std::string>{"camera", "slam", "sonar"}));
    EXPECT_TRUE(sensorNames(Log{}).empty());
}

}  // namespace
}  // namespace mrose
