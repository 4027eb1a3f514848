#include "logs/log_lookup.h"

#include <gtest/gtest.h>

namespace mrose {
namespace {

RobotLog robotWith(const std::vector<std::string>& trajectories) {
    RobotLog robot;
    for (const std::string& name : trajectories) robot.trajectories.emplace_back().name = name;
    return robot;
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

}  // namespace
}  // namespace mrose
