#include "synthetic/log_generator.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "assessment/windows.h"
#include "logs/csv_reader.h"
#include "logs/csv_writer.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace mrose {
namespace {

const SyntheticSet& setNamed(std::string_view name) {
    return *std::find_if(syntheticSets().begin(), syntheticSets().end(),
                         [&](const SyntheticSet& set) { return set.name == name; });
}

Log generated(const SyntheticPart& part, std::uint64_t seed) { return generateLog(part, seed).value(); }

TEST(LogGenerator, SameSeedSameBytesAndAnotherSeedOthers) {
    const SyntheticPart part{DrivePattern::random, 2, 20, 2};
    const std::string first = toCsv(generated(part, 5));
    EXPECT_EQ(first, toCsv(generated(part, 5)));
    EXPECT_NE(first, toCsv(generated(part, 6)));
}

TEST(LogGenerator, ATrajectoryDoesNotDependOnHowManyThereAre) {
    const Log few = generated({DrivePattern::random, 1, 20}, 5), many = generated({DrivePattern::random, 3, 20}, 5);
    EXPECT_EQ(few.robots[0].trajectories[0].poses.back().pose, many.robots[0].trajectories[0].poses.back().pose);
    EXPECT_NE(many.robots[0].trajectories[1].poses.back().pose, many.robots[0].trajectories[2].poses.back().pose);
}

TEST(LogGenerator, RepetitionsHaveTheSameCommandsAndGroupAndOtherMotion) {
    const Log log = generated({DrivePattern::random, 2, 15, 3}, 5);
    const auto& trajectories = log.robots.at(0).trajectories;
    ASSERT_EQ(trajectories.size(), 6u);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(trajectories[i].group, static_cast<int>(i / 3));
    const auto &a = trajectories[0], &b = trajectories[1];
    ASSERT_EQ(a.commands.size(), b.commands.size());
    for (std::size_t i = 0; i < a.commands.size(); ++i) EXPECT_EQ(a.commands[i].command, b.commands[i].command);
    EXPECT_NE(a.poses.back().pose, b.poses.back().pose);
    EXPECT_NE(trajectories[0].commands[50].command, trajectories[3].commands[50].command);
    EXPECT_GT(b.commands.front().time, a.commands.back().time);
}

TEST(LogGenerator, TheTrackerSeesTheTruthWithItsNoise) {
    const SyntheticTracker tracker;
    const auto commands = patternCommands(DrivePattern::random, 60, 1, 0);
    const SyntheticRun run = runReferenceRobot(commands, 60, {1, 2, 3}, 9, tracker);
    ASSERT_EQ(run.tracked.size(), run.truth.size());
    ASSERT_EQ(run.truth.size(), 2501u);
    EXPECT_EQ(run.truth.front().pose, (Pose{1, 2, 3}));
    double position = 0, heading = 0;
    for (std::size_t i = 0; i < run.truth.size(); ++i) {
        const Pose &a = run.truth[i].pose, &b = run.tracked[i].pose;
        EXPECT_EQ(run.truth[i].time, run.tracked[i].time);
        position += (std::pow(b.x - a.x, 2) + std::pow(b.y - a.y, 2)) / 2;
        heading += std::pow(b.heading - a.heading, 2);
    }
    const double count = static_cast<double>(run.truth.size());
    EXPECT_NEAR(std::sqrt(position / count), tracker.positionNoise, 0.1 * tracker.positionNoise);
    EXPECT_NEAR(std::sqrt(heading / count), tracker.headingNoise, 0.1 * tracker.headingNoise);
}

TEST(LogGenerator, StopsWhenItIsTold) {
    int calls = 0;
    EXPECT_FALSE(generateLog({DrivePattern::random, 5, 5}, 1, [&](double) { return ++calls < 2; }));
    EXPECT_EQ(calls, 2);
    double last = 0;
    EXPECT_TRUE(generateLog({DrivePattern::random, 5, 5}, 1, [&](double done) {
        EXPECT_NEAR(done - last, 0.2, 1e-12);
        last = done;
        return true;
    }));
    EXPECT_DOUBLE_EQ(last, 1);
}

TEST(LogGenerator, IsLabelledSyntheticThroughItsFile) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "jink.csv";
    const Log log = generated({DrivePattern::jink}, 1);
    EXPECT_TRUE(log.synthetic);
    ASSERT_TRUE(writeCsv(file, log));
    const auto again = readCsv(file);
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_TRUE(again->synthetic);
    EXPECT_EQ(again->robots.at(0).robot, "reference");
    const Trajectory &a = log.robots[0].trajectories[0], &b = again->robots[0].trajectories.at(0);
    EXPECT_EQ(a.name, b.name);
    ASSERT_EQ(a.poses.size(), b.poses.size());
    EXPECT_EQ(a.poses.back().pose, b.poses.back().pose);
    EXPECT_EQ(a.commands.back().time, b.commands.back().time);
    const LogDefects& defects = again->robots[0].defects;
    EXPECT_EQ(defects.outOfOrder + defects.duplicates + defects.blips + defects.poseOutliers + defects.unpaired, 0);
}

TEST(LogGenerator, TheTrainingSetHasAHundredThousandPatterns) {
    double seconds = 0;
    for (const SyntheticPart& part : setNamed("training").parts)
        seconds += part.repeats * part.trajectories * (part.duration - 3);  // what the grid leaves out at the ends
    EXPECT_GE(seconds * 10, 100'000);
}

TEST(LogGenerator, TheHeldOutSetHasAHundredWindowsAndEnoughHardSwitches) {
    std::size_t windows = 0, switches = 0;
    for (const SyntheticPart& part : setNamed("held-out").parts) {
        const Log log = generated(part, 2);
        const auto found = findWindows(log);
        ASSERT_TRUE(found) << found.error().message();
        windows += found->size();
        for (const Window& window : *found) {
            EXPECT_EQ(window.steps(), 100);
            EXPECT_TRUE(window.measuredVelocity.has_value());
            switches += part.pattern == DrivePattern::hardSwitch && window.manoeuvre == Manoeuvre::hardSwitch;
        }
    }
    EXPECT_EQ(windows, 100u);
    EXPECT_EQ(switches, 20u);
}

TEST(LogGenerator, TheShippedLogsAreTheExampleSet) {
    std::uintmax_t bytes = 0;
    for (const SyntheticPart& part : setNamed("example").parts) {
        const auto file =
            sourceFolder() / "resources" / "logs" / "pioneer" / (std::string(name(part.pattern)) + ".csv");
        const auto shipped = readCsv(file);
        ASSERT_TRUE(shipped) << shipped.error().message();
        EXPECT_TRUE(shipped->synthetic);
        bytes += std::filesystem::file_size(file);
        const Log example = generated(part, 1);
        const auto& made = example.robots.at(0).trajectories;
        ASSERT_EQ(shipped->robots.at(0).trajectories.size(), made.size());
        for (std::size_t i = 0; i < made.size(); ++i) {
            const Trajectory& trajectory = shipped->robots[0].trajectories[i];
            ASSERT_EQ(trajectory.poses.size(), made[i].poses.size());
            EXPECT_NEAR(trajectory.poses.back().pose.x, made[i].poses.back().pose.x, 1e-3);
            EXPECT_NEAR(trajectory.poses.back().pose.heading, made[i].poses.back().pose.heading, 1e-3);
        }
    }
    EXPECT_LT(bytes, 800'000u);
}

/// How far two runs of the same commands are apart over the 10 s from `begin`, each seen from its own true start.
struct Apart {
    double error = 0, path = 0;  // m: mean over time; of the first run, in steps of 0.5 s
};
Apart apart(const std::vector<StampedPose>& a, const std::vector<StampedPose>& b, double begin) {
    const double period = toSeconds(a[1].time - a[0].time);
    const auto index = [&](double time) { return static_cast<std::size_t>(std::lround(time / period)); };
    const auto seen = [&](const std::vector<StampedPose>& run, double time) {
        const Pose &start = run[index(begin)].pose, &at = run[index(time)].pose;
        const double dx = at.x - start.x, dy = at.y - start.y, c = std::cos(start.heading), s = std::sin(start.heading);
        return std::pair(c * dx + s * dy, c * dy - s * dx);
    };
    Apart result;
    for (int i = 1; i <= 100; ++i) {
        const auto [ax, ay] = seen(a, begin + 0.1 * i);
        const auto [bx, by] = seen(b, begin + 0.1 * i);
        result.error += std::hypot(ax - bx, ay - by) / 100;
    }
    for (int i = 0; i < 20; ++i) {
        const Pose &from = a[index(begin + 0.5 * i)].pose, &to = a[index(begin + 0.5 * (i + 1))].pose;
        result.path += std::hypot(to.x - from.x, to.y - from.y);
    }
    return result;
}

/// P of repeated runs in %, over all ordered pairs of runs of the same commands.
double repeatability(DrivePattern pattern, std::uint32_t count, int repeats) {
    const double duration = std::max(15.0, patternDuration(pattern) < 60 ? patternDuration(pattern) : 0);
    Apart sum;
    for (std::uint32_t index = 0; index < count; ++index) {
        const auto commands = patternCommands(pattern, duration, 31, index);
        std::vector<SyntheticRun> runs;
        for (int k = 0; k < repeats; ++k)
            runs.push_back(runReferenceRobot(commands, duration, {}, 1000 * index + static_cast<std::uint64_t>(k)));
        for (const SyntheticRun& a : runs)
            for (const SyntheticRun& b : runs) {
                if (&a == &b) continue;
                const Apart one = apart(a.truth, b.truth, 3.5);
                sum.error += one.error;
                sum.path += one.path;
            }
    }
    return 100 * sum.error / sum.path;
}

TEST(LogGenerator, RepeatedRunsDifferByAboutOnePercent) {
    for (const auto& [pattern, count, repeats] :
         {std::tuple(DrivePattern::random, 150u, 3), std::tuple(DrivePattern::hardSwitch, 100u, 3),
          std::tuple(DrivePattern::jink, 20u, 6), std::tuple(DrivePattern::ellipse, 20u, 6)}) {
        const double p = repeatability(pattern, count, repeats);
        RecordProperty(std::string(name(pattern)), std::to_string(p));
        EXPECT_GT(p, 0.8) << name(pattern);
        EXPECT_LT(p, 1.2) << name(pattern);
    }
}

}  // namespace
}  // namespace mrose
