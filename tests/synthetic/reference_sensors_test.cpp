#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "geometry/point.h"
#include "logs/csv_reader.h"
#include "logs/csv_writer.h"
#include "support/temporary_folder.h"
#include "synthetic/field_landmarks.h"
#include "synthetic/log_generator.h"
#include "synthetic/reference_camera.h"
#include "synthetic/reference_localiser.h"

namespace mrose {
namespace {

constexpr double runTime = 60;  // s

SyntheticRun someRun(std::uint32_t index) {
    return runReferenceRobot(patternCommands(DrivePattern::random, runTime, 7, index), runTime, {4, 2, 1.0 * index}, 3);
}

double deviationOf(const std::vector<double>& values) {
    double sum = 0, squares = 0;
    for (const double value : values) sum += value;
    const double mean = sum / static_cast<double>(values.size());
    for (const double value : values) squares += (value - mean) * (value - mean);
    return std::sqrt(squares / static_cast<double>(values.size()));
}

double correlationAt(const std::vector<double>& values, std::size_t apart) {
    double sum = 0, squares = 0;
    for (std::size_t i = apart; i < values.size(); ++i) {
        sum += values[i] * values[i - apart];
        squares += 0.5 * (values[i] * values[i] + values[i - apart] * values[i - apart]);
    }
    return sum / squares;
}

TEST(ReferenceLocaliser, ErrsByAFewCentimetresAndDegreesThatLast) {
    constexpr std::uint32_t runs = 20;
    std::vector<double> x, heading;
    double farOff = 0, reports = 0;
    for (std::uint32_t i = 0; i < runs; ++i) {
        const SyntheticRun run = someRun(i);
        const TruePath path(run.truth);
        for (const StampedPose& reported : localise(path, 5 + i).poses) {
            const Pose error = relative(path.at(reported.time - 100'000'000), reported.pose);
            ++reports;
            if (std::hypot(error.x, error.y) > 0.4)
                ++farOff;
            else
                x.push_back(error.x), heading.push_back(error.heading);
        }
    }
    const double dropped = 1 - reports / (10 * runTime * runs);
    RecordProperty("x_m", std::to_string(deviationOf(x)));
    RecordProperty("heading_deg", std::to_string(deviationOf(heading) * 57.3));
    RecordProperty("dropped", std::to_string(dropped));
    RecordProperty("far_off", std::to_string(farOff / reports));
    RecordProperty("correlation",
                   std::to_string(correlationAt(x, 15)) + " " + std::to_string(correlationAt(heading, 15)));
    EXPECT_GT(deviationOf(x), 0.05);
    EXPECT_LT(deviationOf(x), 0.12);
    EXPECT_GT(deviationOf(heading), 0.035);
    EXPECT_LT(deviationOf(heading), 0.07);
    EXPECT_GT(dropped, 0.02);
    EXPECT_LT(dropped, 0.10);
    EXPECT_GT(farOff / reports, 0.002);
    EXPECT_LT(farOff / reports, 0.02);
    EXPECT_GT(correlationAt(x, 15), 0.2) << "after 1.5 s";
    EXPECT_LT(correlationAt(x, 60), 0.5) << "after 6 s";
}

TEST(ReferenceLocaliser, IsLateByTheTimeThatIsPlanted) {
    const std::vector<StampedPose> turning = [] {
        std::vector<StampedPose> poses;
        for (int i = 0; i <= 1000; ++i) poses.push_back({i * 10'000'000LL, {4, 2, 0.01 * i}});
        return poses;
    }();
    ReferenceLocaliserParameters exact{.latency = 0.3, .latencyJitter = 0, .gain = 0, .slip = 0};
    exact.turnSlip = exact.whitePosition = exact.whiteHeading = exact.mapError = 0;
    exact.jump = exact.mirrored = exact.burstRate = exact.turningBurstRate = 0;
    const SensorLog log = localise(TruePath(turning), 1, exact);
    ASSERT_GE(log.poses.size(), 99u);
    for (const StampedPose& reported : log.poses) {
        EXPECT_NEAR(reported.pose.heading, toSeconds(reported.time) - 0.3, 1e-6);
        EXPECT_NEAR(reported.pose.x, 4, 1e-6);
    }
}

TEST(ReferenceCamera, SeesNothingBehindTheStrutNorOutsideAndCountsInColumns) {
    const ReferenceCameraParameters camera;
    std::size_t readings = 0, confused = 0, behind = 0;
    std::vector<double> nearShares, farShares;
    for (std::uint32_t i = 0; i < 20; ++i) {
        const SyntheticRun run = someRun(i);
        const TruePath path(run.truth);
        for (const Look& look : photograph(path, 5 + i).looks)
            for (const LogReading& reading : look.readings) {
                ++readings;
                const double column = camera.focalLength * std::tan(reading.bearing) / camera.column;
                EXPECT_NEAR(column, std::round(column), 1e-6);
                const Pose pose = path.at(look.time - 60'000'000);
                const Point offset = *fieldLandmarks()[reading.subject].position - position(pose);
                const double off = wrapAngle(reading.bearing - direction(offset) + pose.heading);
                if (std::abs(off) > 0.05 || std::abs(reading.range / length(offset) - 1) > 0.3) {
                    ++confused;
                    continue;
                }
                if (length(offset) < 0.5) continue;
                behind += reading.bearing - off > 0.26 && reading.bearing - off < 0.29;
                (length(offset) < 2 ? nearShares : farShares).push_back(reading.range / length(offset) - 1);
            }
    }
    ASSERT_GT(readings, 1000u);
    EXPECT_LT(confused, readings / 50);
    EXPECT_EQ(behind, 0u);
    EXPECT_GT(deviationOf(farShares), deviationOf(nearShares));
}

TEST(ReferenceSensors, SameSeedSameReportsAndTheLogIsTheSameWithoutThem) {
    const SyntheticPart without{DrivePattern::random, 2, 20};
    SyntheticPart with = without;
    with.sensors = true;
    Log log = generateLog(with, 5).value();
    EXPECT_EQ(toCsv(log), toCsv(generateLog(with, 5).value()));
    for (const Trajectory& trajectory : log.robots[0].trajectories) {
        ASSERT_EQ(trajectory.sensors.size(), 2u);
        EXPECT_GT(trajectory.sensors[0].poses.size(), 100u);
        EXPECT_EQ(trajectory.sensors[1].looks.size(), 100u);
    }
    for (Trajectory& trajectory : log.robots[0].trajectories) trajectory.sensors.clear();
    log.subjects.clear();
    EXPECT_EQ(toCsv(log), toCsv(generateLog(without, 5).value()));
}

TEST(ReferenceSensors, ComeBackFromTheirFile) {
    const TemporaryFolder folder;
    SyntheticPart part{DrivePattern::random, 2, 20};
    part.sensors = true;
    const Log log = generateLog(part, 5).value();
    ASSERT_TRUE(writeCsv(folder.path() / "random.csv", log));
    const auto again = readCsv(folder.path() / "random.csv");
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_TRUE(again->synthetic);
    EXPECT_EQ(again->subjects.size(), fieldLandmarks().size());
    for (std::size_t i = 0; i < 2; ++i) {
        const auto &a = log.robots[0].trajectories[i].sensors, &b = again->robots[0].trajectories[i].sensors;
        ASSERT_EQ(b.size(), 2u);
        EXPECT_EQ(a[0].poses.back().time, b[0].poses.back().time);
        EXPECT_EQ(a[0].poses.back().pose.x, b[0].poses.back().pose.x);
        EXPECT_EQ(a[1].looks, b[1].looks);
    }
}

}  // namespace
}  // namespace mrose
