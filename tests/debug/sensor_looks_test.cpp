#include "debug/sensor_looks.h"

#include <gtest/gtest.h>

#include "assessment/log_world.h"
#include "assessment/played_scenarios.h"
#include "assessment/test_models.h"

namespace mrose {
namespace {

/// Two robots in two sessions, in each of which the clock begins again; in the second, b is 3 m farther.
std::shared_ptr<const Log> twoSessions() {
    auto log = std::make_shared<Log>();
    log->source = "made-up";
    log->format = "csv";
    for (const std::string name : {"a", "b"}) {
        RobotLog& robot = log->robots.emplace_back(RobotLog{name, {}, {}});
        for (const std::string session : {"1", "2"}) {
            Trajectory& driven = robot.trajectories.emplace_back(obedientTrajectory(0, 20 * second, straightOn));
            driven.name = session;
            for (StampedPose& pose : driven.poses) pose.pose.y += (name == "b" ? 1 : 0) + (session == "2" ? 3 : 0);
        }
        log->subjects.push_back({name, LogSubject::Kind::robot, name, {}});
    }
    for (Trajectory& driven : log->robots[0].trajectories)
        driven.sensors = {{"camera", {{10 * second, {{1, 1.0, 0.5}}}, {11 * second, {}}}}};
    return log;
}

TEST(SensorLooks, RealSubjectsAreWhereTheyWereInTheSameSession) {
    const std::shared_ptr<const Log> log = twoSessions();
    const auto world = LogWorld::create(playersOf(*log, std::make_shared<const HeldCommandModel>()), log);
    ASSERT_TRUE(world) << world.error().message();
    ASSERT_EQ(world->sessions().size(), 2u);
    for (const std::size_t session : {0, 1}) {
        const LogWorld::Opened opened = world->openAt(session, 10 * second, second, 1);
        FieldFrame frame;
        frame.scenario = opened.scenario;
        frame.state = opened.state;
        frame.reality = std::make_shared<const Reality>(realityOf(*world, session, 10 * second));
        const std::vector<SensorLook> looks = realLooks(frame, 0);
        ASSERT_EQ(looks.size(), 1u);
        ASSERT_EQ(looks[0].subjects.size(), 1u);
        const ReportedSubject& b = looks[0].subjects[0];
        EXPECT_EQ(b.name, "simulated b");
        ASSERT_TRUE(b.truth && looks[0].eye);
        EXPECT_NEAR(distance(*b.truth, position(*looks[0].eye)), 1, 1e-9) << session;
    }
}

}  // namespace
}  // namespace mrose
