#include "perception/logged_view.h"

#include <cmath>

#include <gtest/gtest.h>

namespace mrose {
namespace {

constexpr Nanoseconds second = 1'000'000'000;

/// A robot that drives along x at 0.1 m/s and turns at 0.2 rad/s from a heading of 0, seen every 20 ms for 4 s.
RobotLog moving(const std::string& name, double y) {
    Trajectory trajectory;
    for (int i = 0; i <= 200; ++i) trajectory.poses.push_back({i * second / 50, {0.1 * i * 0.02, y, 0.2 * i * 0.02}});
    return {name, {trajectory}, {}};
}
/// One that stands.
RobotLog standing(const std::string& name, double x, double y) {
    Trajectory trajectory;
    for (int i = 0; i <= 200; ++i) trajectory.poses.push_back({i * second / 50, {x, y, 0}});
    return {name, {trajectory}, {}};
}

Log someLog() {
    Log log;
    log.robots = {moving("a", 0), standing("b", 2.2, 0.1)};
    log.subjects = {{"a", LogSubject::Kind::robot, "a", {}},
                    {"b", LogSubject::Kind::robot, "b", {}},
                    {"c", LogSubject::Kind::robot, "c", {}},
                    {"near", LogSubject::Kind::landmark, "", Point{1.2, -0.3}},
                    {"far", LogSubject::Kind::landmark, "", Point{4.2, 0}},
                    {"lost", LogSubject::Kind::landmark, "", std::nullopt}};
    return log;
}

const SensedState* stateOf(const std::vector<LoggedSubject>& subjects, std::size_t subject) {
    for (const LoggedSubject& one : subjects)
        if (one.subject == subject) return &one.state;
    return nullptr;
}

TEST(LoggedViews, SayWhereSubjectsAreFromTheRobot) {
    const Log log = someLog();
    const LoggedView view(log, {0.17, 0.05});
    // after 2 s it stands at (0.2, 0) and heads 0.4 rad
    const auto subjects = view.at(0, 0, 2 * second, {9, 2});
    EXPECT_EQ(subjects.size(), 3u) << "not itself, not c without a log, not what has no place";
    const SensedState* const near = stateOf(subjects, 3);
    ASSERT_NE(near, nullptr);
    EXPECT_NEAR(near->range, std::hypot(1, 0.3), 1e-9);
    EXPECT_NEAR(near->bearing, std::atan2(-0.3, 1) - 0.4, 1e-9);
    EXPECT_EQ(near->subject, SubjectKind::landmark);
    EXPECT_NEAR(near->velocity.v, 0.1 * std::cos(0.4), 1e-6) << "of the motion along x, the part ahead";
    EXPECT_NEAR(near->velocity.w, 0.2, 1e-6);
    EXPECT_EQ(near->unknownRobots, 0.5) << "nobody knows where c is";
    const SensedState* const b = stateOf(subjects, 1);
    ASSERT_NE(b, nullptr);
    EXPECT_EQ(b->subject, SubjectKind::robot);
    EXPECT_NEAR(b->clearance, 0.7 / std::hypot(2, 0.1) - 0.05, 1e-9) << "beside the near landmark";
}

TEST(LoggedViews, ClearanceIsHowFarTheLinePassesBesideDiscs) {
    const Log log = someLog();
    const LoggedView view(log, {0.17, 0.05});
    const auto subjects = view.at(0, 0, 2 * second, {9, 2});
    // the line from (0.2, 0) to (4.2, 0) passes robot b, 0.1 m aside, and the near landmark, 0.3 m aside
    const SensedState* const far = stateOf(subjects, 4);
    ASSERT_NE(far, nullptr);
    EXPECT_NEAR(far->clearance, 0.1 - 0.17, 1e-9);
    Log without = someLog();
    without.robots[1] = standing("b", 5, 0);
    const auto free = LoggedView(without, {0.17, 0.05}).at(0, 0, 2 * second, {9, 2});
    EXPECT_NEAR(stateOf(free, 4)->clearance, 0.3 - 0.05, 1e-9) << "what is behind hides nothing";
    const auto unknown = view.at(0, 0, 2 * second, {9, 2}, LoggedView::Unknown{2});
    EXPECT_EQ(stateOf(unknown, 1), nullptr);
    EXPECT_EQ(stateOf(unknown, 4)->unknownRobots, 1);
    EXPECT_NEAR(stateOf(unknown, 4)->clearance, 0.3 - 0.05, 1e-9);
}

TEST(LoggedViews, SeparationIsToTheNearestOtherInView) {
    const Log log = someLog();
    const LoggedView view(log, {0.17, 0.05});
    const auto subjects = view.at(0, 0, 2 * second, {9, 2});
    const double toB = std::atan2(0.1, 2.0), toNear = std::atan2(-0.3, 1.0);
    EXPECT_NEAR(stateOf(subjects, 4)->separation, toB, 1e-9);
    EXPECT_NEAR(stateOf(subjects, 4)->nearerSeparation, toB, 1e-9);
    EXPECT_NEAR(stateOf(subjects, 1)->separation, toB, 1e-9) << "to what is farther, too";
    EXPECT_NEAR(stateOf(subjects, 1)->nearerSeparation, toB - toNear, 1e-9);
    EXPECT_EQ(stateOf(subjects, 4)->others, 2);
    const auto narrow = view.at(0, 0, 2 * second, {3, 2});
    EXPECT_EQ(stateOf(narrow, 1)->others, 1) << "the far one is beyond the range";
}

TEST(LoggedViews, KnowWhereTheTruthHasGaps) {
    Log log = someLog();
    auto& poses = log.robots[0].trajectories[0].poses;
    std::erase_if(poses, [](const StampedPose& pose) { return pose.time > second && pose.time < 2 * second; });
    const LoggedView view(log);
    EXPECT_TRUE(view.known(0, 0, second / 2));
    EXPECT_FALSE(view.known(0, 0, 3 * second / 2));
    EXPECT_FALSE(view.positionOf(log.robots[0].trajectories[0], 0, 3 * second / 2));
    EXPECT_FALSE(view.at(1, 0, 3 * second / 2, {9, 7}).empty());
    EXPECT_EQ(stateOf(view.at(1, 0, 3 * second / 2, {9, 7}), 0), nullptr);
}

/// Clocks begin again in each session.
TEST(LoggedViews, OtherRobotsAreWhereTheyWereInTheSameSession) {
    Log log;
    const auto sessions = [](RobotLog first, const RobotLog& second) {
        first.trajectories.push_back(second.trajectories[0]);
        first.trajectories[0].name = "1";
        first.trajectories[1].name = "2";
        return first;
    };
    log.robots = {sessions(standing("a", 0, 0), standing("a", 0, 0)),
                  sessions(standing("b", 2, 0), standing("b", 3, 0)), standing("c", 4, 4)};
    log.robots[2].trajectories[0].name = "2";
    for (const RobotLog& robot : log.robots)
        log.subjects.push_back({robot.robot, LogSubject::Kind::robot, robot.robot, {}});
    const LoggedView view(log);
    for (const auto& [trajectory, range] : {std::pair{0, 2.0}, {1, 3.0}}) {
        const auto subjects = view.at(0, static_cast<std::size_t>(trajectory), 2 * second, {9, 2});
        ASSERT_NE(stateOf(subjects, 1), nullptr);
        EXPECT_NEAR(stateOf(subjects, 1)->range, range, 1e-9);
        ASSERT_NE(stateOf(subjects, 2), nullptr) << "it has but one";
        EXPECT_NEAR(stateOf(subjects, 2)->range, std::hypot(4, 4), 1e-9);
    }
    log.robots[1].trajectories[1].name = "3";
    const auto subjects = view.at(0, 1, 2 * second, {9, 2});
    EXPECT_EQ(stateOf(subjects, 1), nullptr) << "it has several, and none of this name";
    ASSERT_NE(stateOf(subjects, 2), nullptr);
    EXPECT_EQ(stateOf(subjects, 2)->unknownRobots, 0.5);
}

}  // namespace
}  // namespace mrose
