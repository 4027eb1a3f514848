#include "workflow/advise_drive.h"

#include <gmock/gmock.h>

#include "identification/planted_log.h"
#include "io/toml_table.h"
#include "logs/csv_writer.h"
#include "logs/log_reader.h"
#include "support/workshop.h"
#include "workflow/expect_error.h"

namespace mrose {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

using AdviseWorkflow = Workshop;

AdviseRequest twentySeconds(const std::string& network, const std::string& log, const std::string& output) {
    AdviseRequest request{network, {log}};
    request.output = output;
    request.duration = 20;
    return request;
}

/// As CSV it is a log of commands, as TOML a controller.
void expectScripts(const AdvisedDrive& drive, const std::string& csv, const std::string& toml) {
    const auto log = readLog(csv);
    ASSERT_TRUE(log) << log.error().message();
    const std::vector<StampedCommand>& issued = log->robots[0].trajectories[0].commands;
    ASSERT_EQ(issued.size(), drive.commands.size() + 1) << "and rest at the end";
    EXPECT_EQ(std::vector(issued.begin(), issued.end() - 1), drive.commands);
    EXPECT_EQ(issued.back(), (StampedCommand{fromSeconds(20), {}}));
    TomlTable table(toml, "next.toml");
    TomlTable controller = table.table("controller");
    EXPECT_EQ(controller.string("kind"), "velocity_script");
    std::vector<TomlTable> commands = controller.tables("commands");
    ASSERT_FALSE(table.failed()) << table.error().message();
    ASSERT_EQ(commands.size(), drive.commands.size());
    EXPECT_EQ(commands[3].number("v_mps"), drive.commands[3].command.v);
}

/// Limits beyond the logs' are driven, and said to be why.
void expectReasons(const Advice& within, const Advice& beyond) {
    EXPECT_EQ(within.limits, within.logs);
    EXPECT_EQ(beyond.limits, (CommandLimits{0, within.logs.mostV, 3 * within.logs.mostW}));
    double seconds = 0, faster = 0;
    for (const AdviceReason& reason : beyond.reasons) {
        seconds += reason.seconds;
        if (reason.what.starts_with("turns faster than the logs'")) faster += reason.seconds;
    }
    EXPECT_NEAR(seconds + beyond.rest, 20, 1e-6);
    EXPECT_NEAR(beyond.rest, 2.7, 0.3);
    EXPECT_EQ(partTexts(beyond).size(), beyond.reasons.size() + 1);
    EXPECT_GT(faster, 3);
    EXPECT_NE(beyond.script.find("turning up to"), std::string::npos);
    EXPECT_NE(beyond.script.find(spaceText(beyond.drive)), std::string::npos);
}

TEST_F(AdviseWorkflow, LearnedNetworksSayWhereTheyLearnedAndAreAdvised) {
    const auto learned = loadNetwork(network());
    ASSERT_TRUE(learned) << learned.error().message();
    ASSERT_TRUE(learned->familiar);
    EXPECT_GT(learned->familiar->periods, 100);
    const auto csv = advise(twentySeconds(network(), log(), path("next.csv")));
    ASSERT_TRUE(csv) << csv.error().message();
    const auto toml = advise(twentySeconds(network(), log(), path("next.toml")));
    ASSERT_TRUE(toml) << toml.error().message();
    expectScripts(csv->drive, path("next.csv"), read("next.toml"));
    AdviseRequest wider = twentySeconds(network(), log(), "");
    wider.turn = 3 * csv->logs.mostW;
    wider.backward = 0;
    const auto beyond = advise(wider);
    ASSERT_TRUE(beyond) << beyond.error().message();
    expectReasons(*csv, *beyond);
    AdviseRequest still = twentySeconds(network(), log(), path("still.csv"));
    still.forward = still.backward = still.turn = 0;
    expectError(advise(still), "", {"limits: allow no motion"});
    expectError(advise(twentySeconds(network(), log(), path("still.csv")), [](double) { return false; }), log(),
                {"cancelled"});
    EXPECT_EQ(read("still.csv"), "");
}

TEST_F(AdviseWorkflow, SaysThatALogIsShortAndOfAnotherRobot) {
    const auto usual = advise(twentySeconds(network(), log(), ""));
    ASSERT_TRUE(usual) << usual.error().message();
    EXPECT_THAT(usual->notices, Not(Contains(HasSubstr("was not learned from"))));
    EXPECT_THAT(usual->notices, Not(Contains(HasSubstr("hardly show"))));
    Log log;
    RobotLog& robot = log.robots.emplace_back();
    robot.robot = "other";
    Plant plant;
    plant.duration = 25;
    robot.trajectories.push_back(plantedTrajectory(plant));
    const auto other = advise(twentySeconds(network(), write("other.csv", toCsv(log)), ""));
    ASSERT_TRUE(other) << other.error().message();
    EXPECT_THAT(other->notices, Contains(HasSubstr("was not learned from robot other")));
    EXPECT_THAT(other->notices, Contains(HasSubstr("hold 25.0 s of driving")));
}

TEST_F(AdviseWorkflow, OutputIsCheckedBeforeAnythingIsRead) {
    const std::string there = write("there.csv", "earlier");
    expectError(advise(twentySeconds(path("none"), path("none"), there)), there, {"is there already"});
    EXPECT_EQ(read("there.csv"), "earlier");
    expectError(advise(twentySeconds(path("none"), path("none"), path("next.txt"))), path("next.txt"),
                {".csv or .toml"});
}

}  // namespace
}  // namespace mrose
