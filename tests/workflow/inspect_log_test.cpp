#include "workflow/inspect_log.h"

#include "support/workshop.h"
#include "workflow/expect_error.h"

namespace mrose {
namespace {

using InspectLog = Workshop;

TEST_F(InspectLog, FindsWhatWasPlanted) {
    const auto found = inspectLog({log()});
    ASSERT_TRUE(found) << found.error().message();
    EXPECT_EQ(found->source, log());
    EXPECT_EQ(found->format, "csv");
    ASSERT_EQ(found->files.size(), 1u);
    ASSERT_EQ(found->robots.size(), 1u);
    const RobotInspection& robot = found->robots[0];
    EXPECT_EQ(robot.robot, "planted");
    EXPECT_EQ(robot.trajectories, 4u);
    EXPECT_NEAR(robot.commandTime, 100, 0.5);
    EXPECT_NEAR(robot.commandRate(), 1 / 0.022, 1);  // a command every 16 to 28 ms
    EXPECT_NEAR(robot.poseRate(), 1 / 0.0165, 2);    // a pose every 12 to 20 ms, on whole ms
    for (const ChannelDelay& delay : {robot.delays.v, robot.delays.w})
        EXPECT_NEAR(delay.deadTime + delay.lag, 0.2, 0.015);
    EXPECT_LT(robot.v.least, 0);
    EXPECT_LE(robot.v.most, 0.56);
}

TEST_F(InspectLog, HasNoRangeOfWhatIsNotThere) {
    std::string rows = "t,v_cmd,w_cmd\n";
    for (int i = 0; i < 100; ++i) rows += std::to_string(0.05 * i) + ",0.2,0.1\n";
    const auto found = inspectLog({write("commands.csv", rows)});
    ASSERT_TRUE(found) << found.error().message();
    EXPECT_TRUE(found->robots[0].x.empty());
    EXPECT_FALSE(found->robots[0].v.empty());
    EXPECT_EQ(found->robots[0].poseRate(), 0);
}

TEST_F(InspectLog, CountsWhatWasMended) {
    const std::string rows = "t,v_cmd,w_cmd,x,y,heading\n1.0,0.1,0,1,1,0\n1.0,0.2,0,1,1,0\n1.1,0.1,0,1,1,0\n";
    const auto found = inspectLog({write("mended.csv", rows)});
    ASSERT_TRUE(found) << found.error().message();
    EXPECT_GT(found->robots[0].defects.duplicates, 0);
}

TEST_F(InspectLog, SaysWhatLooksLikeOtherUnits) {
    std::string rows = "t,v_cmd,w_cmd,x,y,heading\n";
    for (int i = 0; i < 100; ++i)
        rows +=
            std::to_string(0.05 * i) + ",0.2,0.1," + std::to_string(10 * i) + ",0," + std::to_string(0.005 * i) + '\n';
    const auto found = inspectLog({write("millimetres.csv", rows)});
    ASSERT_TRUE(found) << found.error().message();
    ASSERT_EQ(found->unitDoubts.size(), 1u);
    const ProgramResult shown = runMrose({"inspect", path("millimetres.csv")});
    EXPECT_NE(shown.out.find("\nNote: " + found->unitDoubts[0]), std::string::npos) << shown.out;
    EXPECT_TRUE(inspectLog({log()})->unitDoubts.empty());
}

TEST_F(InspectLog, IsEndedByItsProgress) {
    int asked = 0;
    expectError(inspectLog({log()}, [&](double) { return ++asked > 1; }), log(), {"cancelled"});
    EXPECT_EQ(asked, 1);
    expectError(inspectLog({log()}, [](double share) { return share < 1; }), log(), {"cancelled"});
}

}  // namespace
}  // namespace mrose
