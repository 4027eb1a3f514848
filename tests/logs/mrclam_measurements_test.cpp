#include "logs/mrclam_measurements.h"

#include <algorithm>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "geometry/point.h"
#include "io/file.h"
#include "io/format.h"
#include "logs/mrclam_reader.h"
#include "support/mrclam_folder.h"
#include "support/referee.h"
#include "support/test_data.h"

namespace mrose {
namespace {

constexpr const char* barcodes = "# Subject #    Barcode #\n  1 \t   5 \n  2 \t  14 \n  6 \t  72 \n";
constexpr const char* landmarks = "# Subject #  x  y  x std-dev  y std-dev\n  6 \t 0.5 \t -4.25 \t 0.0001 \t 0.0002 \n";
/// Barcode 43 is no subject's.
constexpr const char* measurements =
    "# Time [s]    Subject #    range [m]    bearing [rad] \n"
    "1248444190.000 \t  72 \t  3.787 \t -0.257 \n"
    "1248444190.001 \t  14 \t  2.5 \t 0.125 \n"
    "1248444190.472 \t  43 \t  1.5 \t 0.5 \n";

/// A folder of two robots in which robot 1 measured.
class MrclamMeasurements : public testing::Test {
protected:
    MrclamMeasurements() {
        write("Barcodes.dat", barcodes);
        write("Landmark_Groundtruth.dat", landmarks);
        folder.write(1, "Measurement", measurements);
        folder.write(2, "Measurement", measurements);
    }
    void write(const std::string& name, const std::string& text) const {
        ASSERT_TRUE(writeFileAtomically(folder.path() + '/' + name, text));
    }
    Log read() const {
        auto log = readMrclam(folder.path());
        EXPECT_TRUE(log) << log.error().message();
        return log.value_or(Log{});
    }
    std::string message() const {
        const auto log = readMrclam(folder.path());
        if (log) return "no error";
        EXPECT_EQ(log.error().file.rfind(folder.path(), 0), 0u);
        return log.error().message().substr(folder.path().size() + 1);
    }
    const MrclamFolder folder{2};
};

TEST_F(MrclamMeasurements, AreLooksOfSubjects) {
    const Log log = read();
    EXPECT_THAT(log.incomplete, testing::IsEmpty());
    ASSERT_EQ(log.subjects.size(), 3u);
    EXPECT_EQ(log.subjects[0].kind, LogSubject::Kind::robot);
    EXPECT_EQ(log.subjects[0].robot, "1");
    EXPECT_EQ(log.subjects[2].name, "6");
    EXPECT_EQ(log.subjects[2].kind, LogSubject::Kind::landmark);
    EXPECT_EQ(log.subjects[2].position, (Point{0.5, -4.25}));
    ASSERT_EQ(log.robots.at(0).trajectories.at(0).sensors.size(), 1u);
    const SensorLog& camera = log.robots[0].trajectories[0].sensors[0];
    EXPECT_EQ(camera.sensor, "camera");
    ASSERT_EQ(camera.looks.size(), 3u);
    EXPECT_EQ(camera.looks[0].time, 1'248'444'190'000'000'000);
    EXPECT_THAT(camera.looks[0].readings,
                testing::ElementsAre(LogReading{2, 3.787, -0.257}, LogReading{1, 2.5, 0.125}));
    EXPECT_EQ(camera.looks[1].time, 1'248'444'190'236'000'000) << "it looked between the others";
    EXPECT_TRUE(camera.looks[1].readings.empty());
    EXPECT_TRUE(camera.looks[2].readings.empty()) << "of what carries no known barcode nothing is kept but the look";
    EXPECT_EQ(camera.defects.joinedStamps, 1);
    EXPECT_EQ(camera.defects.unknownSubjects, 1);
    EXPECT_EQ(camera.defects.emptyLooks, 1);
    EXPECT_EQ(log.files.size(), 4u) << "what motion is learned from";
    EXPECT_EQ(log.measurementFiles.size(), 4u);
}

TEST_F(MrclamMeasurements, BarcodesOfNobodyAreSaidWhereTheyAreMany) {
    std::string more = measurements;
    for (int i = 0; i < 8; ++i)
        more += "1248444191." + std::to_string(i) + "00 " + (i < 6 ? "61" : "62") + " 1.5 0.5\n";
    folder.write(2, "Measurement", more);
    EXPECT_THAT(
        read().incomplete,
        testing::ElementsAre("Robot2_Measurement.dat:4: barcode 43, and 2 others, are nobody's in Barcodes.dat: "
                             "9 of 11 readings dropped."));
    for (int i = 0; i < 1000; ++i)
        more += "12484441" + std::to_string(92 + i / 200) + '.' + std::to_string(200 + i % 200) + " 72 1.5 0.5\n";
    folder.write(2, "Measurement", more);
    EXPECT_THAT(read().incomplete, testing::IsEmpty()) << "9 of 1011";
}

TEST_F(MrclamMeasurements, WithoutThemALogIsAsItWas) {
    for (const char* number : {"1", "2"})
        std::filesystem::remove(folder.path() + "/Robot" + number + "_Measurement.dat");
    const Log log = read();
    EXPECT_TRUE(log.robots.at(0).trajectories.at(0).sensors.empty());
    EXPECT_TRUE(log.subjects.empty());
    EXPECT_TRUE(log.measurementFiles.empty());
    EXPECT_TRUE(log.incomplete.empty());
}

TEST_F(MrclamMeasurements, OfWhatIsMissingTheLogSaysSo) {
    std::filesystem::remove(folder.path() + "/Robot2_Measurement.dat");
    EXPECT_THAT(read().incomplete,
                testing::ElementsAre("Robot2_Measurement.dat is missing: nothing says what robot 2 saw."));
    folder.write(2, "Measurement", "# none\n");
    EXPECT_THAT(read().incomplete,
                testing::ElementsAre("Robot2_Measurement.dat has no rows: nothing says what robot 2 saw."));
    folder.write(2, "Measurement", measurements + std::string("1248444191 5 1"));
    EXPECT_THAT(read().incomplete,
                testing::ElementsAre("The last line of Robot2_Measurement.dat is cut off: it is left out."));
    EXPECT_EQ(read().robots.at(1).trajectories.at(0).sensors.at(0).defects.cutLines, 1);
    std::filesystem::remove(folder.path() + "/Landmark_Groundtruth.dat");
    EXPECT_THAT(read().incomplete,
                testing::ElementsAre("Landmark_Groundtruth.dat is missing: nothing says what the cameras saw."));
}

TEST_F(MrclamMeasurements, EachWrongRowIsSaidByFileLineAndColumn) {
    const auto wrong = [&](const std::string& row) {
        folder.write(1, "Measurement", "# c\n1248444190 5 1 0\n" + row + "\n1248444191 5 1 0\n");
        return message();
    };
    EXPECT_EQ(wrong("1248444190.5 5 -0.257 3.787"),
              "Robot1_Measurement.dat:3: range: expected a range of at least 0 m, found -0.257: are columns swapped?");
    EXPECT_EQ(wrong("1248444190.5 5 3.787 14.7"),
              "Robot1_Measurement.dat:3: bearing: expected radians within +-2 pi, found 14.7: are these degrees?");
    EXPECT_EQ(wrong("1248444190.5 5.5 3.787 0"),
              "Robot1_Measurement.dat:3: barcode: expected a whole number, found 5.5");
    EXPECT_EQ(wrong("1248444190.5 5 nan 0"),
              "Robot1_Measurement.dat:3:16: range: expected a number within +-1e9, found 'nan'");
    EXPECT_EQ(wrong("1248444190.5 5 3"), "Robot1_Measurement.dat:3:17: bearing: missing: 3 of 4 columns");
    write("Barcodes.dat", "1 5\n2 5\n");
    EXPECT_EQ(message(), "Barcodes.dat:2: barcode: 5 is there twice");
    write("Barcodes.dat", "1 5\n1.5 6\n");
    EXPECT_EQ(message(), "Barcodes.dat:2: subject: expected a whole number, found 1.5");
    write("Barcodes.dat", barcodes);
    write("Landmark_Groundtruth.dat", "6 1 2 0 0\n6 1 2 0 0\n");
    EXPECT_EQ(message(), "Landmark_Groundtruth.dat:2: subject: 6 is there twice");
    write("Landmark_Groundtruth.dat", "6 1 2 0\n");
    EXPECT_EQ(message(), "Landmark_Groundtruth.dat:1:8: y std-dev: missing: 4 of 5 columns");
}

TEST_F(MrclamMeasurements, AClockOfAnotherLogIsAnError) {
    folder.write(2, "Measurement", "# c\n1248450000 5 1 0\n1248450001 5 1 0\n");
    EXPECT_EQ(message(),
              "Robot2_Measurement.dat:2: time: readings from 1248450000.000 to 1248450001.000 s; expected some within "
              "the robot's commands and poses, 1248444187.000 to 1248444247.000 s");
}

/// Truth between two poses, as straight as the referee's.
std::optional<Pose> poseBetween(const std::vector<StampedPose>& poses, Nanoseconds time) {
    const auto after = std::lower_bound(poses.begin(), poses.end(), time,
                                        [](const StampedPose& pose, Nanoseconds t) { return pose.time < t; });
    if (after == poses.begin() || after == poses.end()) return std::nullopt;
    const StampedPose &a = *std::prev(after), &b = *after;
    if (b.time - a.time > 200'000'000) return std::nullopt;
    const double share = toSeconds(time - a.time) / toSeconds(b.time - a.time);
    return Pose{a.pose.x + share * (b.pose.x - a.pose.x), a.pose.y + share * (b.pose.y - a.pose.y),
                a.pose.heading + share * (b.pose.heading - a.pose.heading)};
}

/// The queries that follow from a robot's looks, as cameraQueries prints them.
void addQueries(std::vector<std::string>& lines, const Log& log, const RobotLog& robot) {
    for (const Look& look : robot.trajectories.at(0).sensors.at(0).looks) {
        const auto pose = poseBetween(robot.trajectories[0].poses, look.time);
        if (!pose) continue;
        for (std::size_t i = 0; i < log.subjects.size(); ++i) {
            if (!log.subjects[i].position) continue;
            const Point way = *log.subjects[i].position - position(*pose);
            if (length(way) > 9 || std::abs(wrapAngle(std::atan2(way.y, way.x) - pose->heading)) > 50 / degrees)
                continue;
            const auto reading = std::find_if(look.readings.begin(), look.readings.end(),
                                              [&](const LogReading& r) { return r.subject == i; });
            const bool reported = reading != look.readings.end();
            lines.push_back(robot.robot + ',' + fixed(std::nearbyint(toSeconds(look.time) * 1e3) / 1e3, 3) + ',' +
                            log.subjects[i].name + ',' + (reported ? '1' : '0') + ',' +
                            (reported ? fixed(reading->range, 3) + ',' + fixed(reading->bearing + 0.0, 3) : "nan,nan"));
        }
    }
}

TEST(MrclamCameras, LooksGiveTheQueriesOfTheReferee) {
    const auto data = realData();
    if (!data) GTEST_SKIP() << "no real logs: set MROSE_DATA";
    for (const auto& [dataset, robots] : {std::pair(6, "1,2,3,4,5"), std::pair(7, "1,2")}) {
        const auto folder = *data / "mrclam" / ("MRCLAM_Dataset" + std::to_string(dataset));
        if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
        const auto theirs = cameraQueries((*data / "mrclam").string(), dataset, robots);
        if (!theirs) GTEST_SKIP() << "no referee of cameras with numpy: set MROSE_CAMERA_REFEREE";
        const auto log = readMrclam(folder);
        ASSERT_TRUE(log) << log.error().message();
        std::vector<std::string> ours, expected;
        for (const RobotLog& robot : log->robots) addQueries(ours, *log, robot);
        std::istringstream lines(*theirs);
        for (std::string line; std::getline(lines, line);) expected.push_back(line);
        EXPECT_GT(expected.size(), 10000u) << *theirs;
        std::sort(ours.begin(), ours.end());
        std::sort(expected.begin(), expected.end());
        EXPECT_EQ(ours.size(), expected.size());
        const auto differ = std::mismatch(ours.begin(), ours.end(), expected.begin(), expected.end());
        EXPECT_TRUE(differ.first == ours.end()) << *differ.first << "\n" << *differ.second;
    }
}

}  // namespace
}  // namespace mrose
