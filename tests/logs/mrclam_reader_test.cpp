#include "logs/mrclam_reader.h"

#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "io/file.h"
#include "support/temporary_folder.h"
#include "support/test_data.h"

namespace mrose {
namespace {

constexpr const char* odometryText =
    "# UTIAS Multi-Robot Cooperative Localization and Mapping Dataset\n"
    "# Time [s]    forward velocity [m/s]    angular velocity[rad/s] \n"
    "1248444187.156 \t  0.086 \t -0.398 \n"
    "1248444187.186 \t  0.086 \t  0.4 \r\n"
    "\n"
    "  1248444187.197\t.067 +0.000\n";

constexpr const char* truthText =
    "# Time [s]    x [m]    y [m]    orientation [rad] \n"
    "1248444175.103 \t 1.41277290 \t -3.89107760 \t 3.14 \n"
    "1248444175.115 \t 1.41278500 \t -3.89107880 \t -3.14 \n";

std::string odometryMessage(const std::string& text) {
    LogDefects defects;
    const auto rows = parseMrclamOdometry(text, "o.dat", defects);
    return rows ? "no error" : rows.error().message();
}

TEST(MrclamReader, ReadsRowsAsTheyStand) {
    LogDefects defects;
    const auto rows = parseMrclamOdometry(odometryText, "o.dat", defects);
    ASSERT_TRUE(rows) << rows.error().message();
    ASSERT_EQ(rows->size(), 3u);
    EXPECT_EQ((*rows)[0].time, 1'248'444'187'156'000'000);
    EXPECT_EQ((*rows)[0].command, (Command{0.086, -0.398}));
    EXPECT_EQ((*rows)[2].time, 1'248'444'187'197'000'000);
    EXPECT_EQ((*rows)[2].command, (Command{0.067, 0}));
    const auto poses = parseMrclamGroundtruth(truthText, "g.dat", defects);
    ASSERT_TRUE(poses) << poses.error().message();
    EXPECT_EQ((*poses)[1].pose, (Pose{1.412785, -3.8910788, -3.14}));
    EXPECT_EQ(defects.cutLines, 0);
}

TEST(MrclamReader, EachWrongRowIsToldByFileLineAndKey) {
    EXPECT_EQ(odometryMessage("1 2 3\n2 x 3\n"), "o.dat:2:3: v: expected a number within +-1e9, found 'x'");
    EXPECT_EQ(odometryMessage("# c\n1 2 nan\n2 2 3\n"), "o.dat:2:5: w: expected a number within +-1e9, found 'nan'");
    EXPECT_EQ(odometryMessage("1 2 inf\n2 2 3\n"), "o.dat:1:5: w: expected a number within +-1e9, found 'inf'");
    EXPECT_EQ(odometryMessage("1 2 3\n2 2 1e300\n"), "o.dat:2:5: w: expected a number within +-1e9, found '1e300'");
    EXPECT_EQ(odometryMessage("1 2 3\n2 2 3.4.5\n"), "o.dat:2:5: w: expected a number within +-1e9, found '3.4.5'");
    EXPECT_EQ(odometryMessage("1 2 3\n12;3 2 1\n"), "o.dat:2:1: time: expected seconds within +-4e9, found '12;3'");
    EXPECT_EQ(odometryMessage("1 2 3\n2 2\n3 2 1\n"), "o.dat:2:4: w: missing: 2 of 3 columns");
    EXPECT_EQ(odometryMessage("1 2 3\n2 2 3 4\n3 2 1\n"), "o.dat:2:7: more than 3 columns");
}

TEST(MrclamReader, ALastLineThatIsCutOffIsLeftOutAndCounted) {
    const std::string sound = "1 2 3\n2 2 3\n";
    // The last number may be the beginning of a longer one.
    for (const char* cut : {"3", "3 ", "3 -", "3 2", "3 2\t ", "3 2 -", "3 2 -0.3", "3 2 -0.3 "}) {
        LogDefects defects;
        const auto rows = parseMrclamOdometry(sound + cut, "o.dat", defects);
        ASSERT_TRUE(rows) << rows.error().message();
        EXPECT_EQ(rows->size(), 2u) << cut;
        EXPECT_EQ(defects.cutLines, 1) << cut;
    }
    EXPECT_EQ(odometryMessage(sound + "3 x 3"), "o.dat:3:3: v: expected a number within +-1e9, found 'x'");
    EXPECT_EQ(odometryMessage(sound + "3 2 3 4"), "o.dat:3:7: more than 3 columns");
    EXPECT_EQ(odometryMessage(sound + "3 2\n"), "o.dat:3:4: w: missing: 2 of 3 columns") << "a whole line";
}

TEST(MrclamReader, TimeRunningBackwardsForGoodIsAnError) {
    std::string text = "# comment\n";
    for (int i = 0; i < 40; ++i) text += std::to_string(i < 20 ? 1000 + i : i) + " 0.1 0\n";
    EXPECT_EQ(odometryMessage(text), "o.dat:22: time runs backwards for good: 999.000 s before line 21");
}

TEST(MrclamReader, AFolderGivesOneRobotForEachOdometryFileInTheOrderOfTheirNumbers) {
    const TemporaryFolder temporary;
    for (const char* number : {"2", "10", "1"})
        temporary.write("MRCLAM_Dataset6/Robot" + std::string(number) + "_Odometry.dat", odometryText);
    temporary.write("MRCLAM_Dataset6/Robot2_Groundtruth.dat", truthText);
    temporary.write("MRCLAM_Dataset6/Robot7_Groundtruth.dat", truthText);
    temporary.write("MRCLAM_Dataset6/RobotX_Odometry.dat", "not one");
    for (const char* suffix : {"", "/"}) {
        const auto log = readMrclam(temporary.path().string() + "/MRCLAM_Dataset6" + suffix);
        ASSERT_TRUE(log) << log.error().message();
        EXPECT_EQ(log->format, "mrclam");
        EXPECT_EQ(log->dataset, 6);
        ASSERT_EQ(log->robots.size(), 3u);
        EXPECT_EQ(log->robots[0].robot, "1");
        EXPECT_EQ(log->robots[1].robot, "2");
        EXPECT_EQ(log->robots[2].robot, "10");
        ASSERT_EQ(log->robots[1].trajectories.size(), 1u);
        EXPECT_EQ(log->robots[1].trajectories[0].poses.size(), 2u);
        EXPECT_EQ(log->robots[1].defects.headingWraps, 1);
        EXPECT_TRUE(log->robots[0].trajectories[0].poses.empty());
        ASSERT_EQ(log->files.size(), 4u);
        EXPECT_EQ(log->files[0].hash, contentHash(odometryText));
    }
}

TEST(MrclamReader, ErrorsInAFolderNameTheFile) {
    const TemporaryFolder temporary;
    temporary.write("Robot1_Odometry.dat", odometryText);
    const auto truth = temporary.write("Robot1_Groundtruth.dat", "1 2 3 4\n2 3 4\n");
    const auto log = readMrclam(temporary.path());
    ASSERT_FALSE(log);
    EXPECT_EQ(log.error().message(), truth.string() + ":2:6: heading: missing: 3 of 4 columns");
    const TemporaryFolder empty;
    EXPECT_EQ(readMrclam(empty.path()).error().message(), empty.path().string() + ": holds no Robot<N>_Odometry.dat");
}

/// Robots 1 to 3 with all of their files.
class MrclamFiles : public testing::Test {
protected:
    MrclamFiles() {
        for (const char* number : {"1", "2", "3"}) {
            write(number, "Odometry", odometryText);
            write(number, "Groundtruth", truthText);
        }
    }
    void write(const std::string& number, const std::string& what, const std::string& text) {
        folder.write("Robot" + number + '_' + what + ".dat", text);
    }
    Log read() const {
        auto log = readMrclam(folder.path());
        EXPECT_TRUE(log) << log.error().message();
        return log.value_or(Log{});
    }
    const TemporaryFolder folder;
};

TEST_F(MrclamFiles, SoundOneLacksNothing) { EXPECT_TRUE(read().incomplete.empty()); }

TEST_F(MrclamFiles, EmptyTruthLeavesTheOthers) {
    for (const char* text : {"", "# Time [s]    x [m]    y [m]    orientation [rad] \n"}) {
        write("2", "Groundtruth", text);
        const Log log = read();
        ASSERT_EQ(log.robots.size(), 3u);
        for (const std::size_t robot : {0u, 1u, 2u}) {
            const Trajectory& trajectory = log.robots[robot].trajectories.at(0);
            EXPECT_EQ(trajectory.commands.size(), 3u);
            EXPECT_EQ(trajectory.poses.size(), robot == 1 ? 0u : 2u);
        }
        EXPECT_EQ(log.incomplete,
                  std::vector<std::string>{"Robot2_Groundtruth.dat has no rows: nothing says where robot 2 was."});
        EXPECT_EQ(log.files.size(), 6u);
    }
}

TEST_F(MrclamFiles, EmptyOdometryLeavesTheOthers) {
    write("3", "Odometry", "1248444187.156 0.1 0.2\n");
    Log log = read();
    ASSERT_EQ(log.robots.size(), 3u);
    EXPECT_TRUE(log.robots[2].trajectories.at(0).commands.empty());
    EXPECT_EQ(log.robots[2].trajectories.at(0).poses.size(), 2u);
    EXPECT_EQ(log.incomplete,
              std::vector<std::string>{"Robot3_Odometry.dat has a single row: nothing says what was sent to robot 3."});
    write("3", "Groundtruth", "");
    log = read();
    EXPECT_EQ(log.robots.size(), 2u) << "nothing is left of it";
    EXPECT_EQ(log.incomplete.size(), 2u);
}

TEST_F(MrclamFiles, CutLineIsSaidOfItsFileAndCountedOfItsRobot) {
    write("2", "Groundtruth", truthText + std::string("1248444175.2 \t 1.4"));
    const Log log = read();
    EXPECT_EQ(log.robots.at(1).trajectories.at(0).poses.size(), 2u);
    EXPECT_EQ(log.robots[0].defects.cutLines + log.robots[2].defects.cutLines, 0);
    EXPECT_EQ(log.robots[1].defects.cutLines, 1);
    EXPECT_EQ(log.incomplete,
              std::vector<std::string>{"The last line of Robot2_Groundtruth.dat is cut off: it is left out."});
}

TEST_F(MrclamFiles, MissingTruthIsSaidWhereOthersHaveIt) {
    std::filesystem::remove(folder.path() / "Robot1_Groundtruth.dat");
    EXPECT_EQ(read().incomplete,
              std::vector<std::string>{"Robot1_Groundtruth.dat is missing: nothing says where robot 1 was."});
    for (const char* number : {"2", "3"})
        std::filesystem::remove(folder.path() / ("Robot" + std::string(number) + "_Groundtruth.dat"));
    EXPECT_TRUE(read().incomplete.empty()) << "a log without ground truth";
}

TEST_F(MrclamFiles, DamageInTheMiddleAndALogOfNothingAreErrors) {
    write("2", "Groundtruth", "1 2 3 4\n2 x 3 4\n3 2 3 4\n");
    const std::string place = folder.path().string();
    EXPECT_EQ(readMrclam(folder.path()).error().message(),
              place + "/Robot2_Groundtruth.dat:2:3: x: expected a number within +-1e9, found 'x'");
    for (const char* number : {"1", "2", "3"})
        for (const char* what : {"Odometry", "Groundtruth"}) write(number, what, "");
    EXPECT_EQ(readMrclam(folder.path()).error().message(), place + ": too short: 0 rows; expected at least 2");
}

/// An independent and slow reading of a column of a published file.
struct PlainFile {
    std::size_t rows = 0;
    std::set<std::string> stamps;
    std::size_t gaps = 0;  // longer than the limit, in file order
    double longest = 0;
};

PlainFile readPlainly(const std::filesystem::path& path, double gapLimit) {
    PlainFile plain;
    std::ifstream stream(path);
    double before = 0;
    for (std::string line, stamp; std::getline(stream, line);) {
        if (line.starts_with("#")) continue;
        std::istringstream(line) >> stamp;
        const double time = std::stod(stamp.substr(3));  // fewer digits: milliseconds stay exact enough
        if (plain.rows > 0 && time - before > gapLimit + 1e-6) {
            ++plain.gaps;
            plain.longest = std::max(plain.longest, time - before);
        }
        before = time;
        plain.stamps.insert(stamp);
        ++plain.rows;
    }
    return plain;
}

TEST(MrclamReader, RealLogsAgreeWithAPlainReadingOfTheFiles) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs: set MROSE_DATA";
    for (const int dataset : {6, 7}) {
        const auto folder = *data / "mrclam" / ("MRCLAM_Dataset" + std::to_string(dataset));
        if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
        const auto log = readMrclam(folder);
        ASSERT_TRUE(log) << log.error().message();
        EXPECT_EQ(log->dataset, dataset);
        EXPECT_EQ(log->robots.size(), dataset == 6 ? 5u : 2u);
        for (const RobotLog& robot : log->robots) {
            const auto& trajectory = robot.trajectories.at(0);
            const auto commands = readPlainly(folder / ("Robot" + robot.robot + "_Odometry.dat"), 0.5);
            const auto poses = readPlainly(folder / ("Robot" + robot.robot + "_Groundtruth.dat"), 0.2);
            EXPECT_EQ(robot.defects.outOfOrder, 0);
            EXPECT_EQ(robot.defects.poseOutliers, 0);
            EXPECT_EQ(static_cast<std::size_t>(robot.defects.duplicates), commands.rows - commands.stamps.size());
            EXPECT_EQ(trajectory.commands.size() + static_cast<std::size_t>(robot.defects.blips),
                      commands.stamps.size());
            EXPECT_EQ(trajectory.poses.size(), poses.rows);
            EXPECT_EQ(static_cast<std::size_t>(robot.defects.commandGaps), commands.gaps);
            EXPECT_NEAR(robot.defects.longestCommandGap, commands.longest, 1e-6);
            EXPECT_EQ(static_cast<std::size_t>(robot.defects.poseGaps), poses.gaps);
            EXPECT_NEAR(robot.defects.longestPoseGap, poses.longest, 1e-6);
            // As published: hundreds of blips of one sample, of which those between equal commands are dropped.
            EXPECT_EQ(trajectory.blips.size(), static_cast<std::size_t>(robot.defects.blips));
            EXPECT_GE(robot.defects.blips, 90);
            EXPECT_LE(robot.defects.blips, 265);
        }
    }
}

}  // namespace
}  // namespace mrose
