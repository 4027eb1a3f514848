// mrose predict of a learned sensor: from the truth of a log alone.
#include <algorithm>
#include <fstream>
#include <random>
#include <sstream>

#include <gmock/gmock.h>

#include "logs/csv_writer.h"
#include "logs/log_reader.h"
#include "perception/some_sensor.h"
#include "support/camera_folder.h"
#include "support/toy_camera.h"
#include "support/workshop.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

/// Two robots that both see landmarks and each other.
Log twoCameras() {
    Log log = seenLog(ToyCamera{}, 20);
    for (RobotLog& robot : log.robots) robot.trajectories[0].name = "whole";
    log.robots[1].trajectories[0].sensors = log.robots[0].trajectories[0].sensors;
    for (Look& look : log.robots[1].trajectories[0].sensors[0].looks)
        for (LogReading& reading : look.readings)
            if (reading.subject == 1) reading.subject = 0;  // not itself
    return log;
}

std::vector<Look*> looksOf(Log& log) {
    std::vector<Look*> all;
    for (RobotLog& robot : log.robots)
        for (SensorLog& sensor : robot.trajectories[0].sensors)
            for (Look& look : sensor.looks) all.push_back(&look);
    return all;
}

/// The same log with the ranges and bearings of its readings in any order, and without every second reading. Its looks
/// stay.
Log garbled(Log log) {
    std::vector<std::pair<double, double>> values;
    for (const Look* const look : looksOf(log))
        for (const LogReading& reading : look->readings) values.emplace_back(reading.range, reading.bearing);
    std::mt19937 random(5);
    std::ranges::shuffle(values, random);
    std::size_t count = 0;
    for (Look* const look : looksOf(log)) {
        std::vector<LogReading> kept;
        for (const LogReading& reading : look->readings) {
            const auto& [range, bearing] = values[count++];
            if (count % 2 == 0) kept.push_back({reading.subject, range, bearing});
        }
        look->readings = kept;
    }
    return log;
}

class PredictReadings : public Workshop {
protected:
    void SetUp() override { ASSERT_TRUE(saveSensor(test::someCamera(), path("some.net"))); }

    /// Of every subject at every look.
    std::string queriesOf(Log log) {
        std::string text = "dataset,robot,t,subject\n";
        for (const RobotLog& robot : log.robots)
            for (const SensorLog& sensor : robot.trajectories[0].sensors)
                for (const Look& look : sensor.looks)
                    for (const LogSubject& subject : log.subjects)
                        if (subject.robot != robot.robot)
                            text += std::to_string(log.dataset) + ',' + robot.robot + ',' + secondsText(look.time) +
                                    ',' + subject.name + '\n';
        return write("queries.csv", text);
    }
    /// The bytes that it writes.
    std::string predicted(const std::string& log, const std::string& queries) {
        const ProgramResult result = runMrose({"predict", path("some.net"), "--log", log, "--queries", queries,
                                               "--samples", "3", "-q", "--overwrite", "-o", path("predicted.csv")});
        EXPECT_EQ(result.status, 0) << result.err;
        return read("predicted.csv");
    }
};

TEST_F(PredictReadings, NoReadingOfTheLogIsRead) {
    Log log = twoCameras();
    const std::string queries = queriesOf(log);
    ASSERT_TRUE(writeCsv(path("log.csv"), log));
    ASSERT_TRUE(writeCsv(path("garbled.csv"), garbled(log)));
    const auto one = readLog(path("log.csv")), other = readLog(path("garbled.csv"));
    ASSERT_TRUE(one) << one.error().message();
    ASSERT_TRUE(other) << other.error().message();
    for (std::size_t i = 0; i < 2; ++i) {
        const SensorLog &before = one->robots[i].trajectories[0].sensors[0],
                        &after = other->robots[i].trajectories[0].sensors[0];
        ASSERT_TRUE(std::ranges::equal(before.looks, after.looks, {}, &Look::time, &Look::time));
        std::size_t same = 0, kept = 0;
        for (std::size_t k = 0; k < before.looks.size(); ++k)
            for (const LogReading& reading : after.looks[k].readings) {
                ++kept;
                same += static_cast<std::size_t>(std::ranges::count(before.looks[k].readings, reading));
            }
        ASSERT_GT(kept, 50u);
        ASSERT_LT(same, kept / 10);
    }
    const std::string predictions = predicted(path("log.csv"), queries);
    EXPECT_GT(std::ranges::count(predictions, '\n'), 6000);
    EXPECT_THAT(predictions, testing::HasSubstr("\n0,2,"));
    EXPECT_TRUE(predictions == predicted(path("garbled.csv"), queries));

    // as another truth does not go unnoticed
    log.subjects[7].position->x += 0.01;
    ASSERT_TRUE(writeCsv(path("moved.csv"), log));
    EXPECT_FALSE(predictions == predicted(path("moved.csv"), queries));
    log.subjects[7].position->x -= 0.01;
    for (StampedPose& pose : log.robots[1].trajectories[0].poses) pose.pose.y += 0.01;
    ASSERT_TRUE(writeCsv(path("elsewhere.csv"), log));
    EXPECT_FALSE(predictions == predicted(path("elsewhere.csv"), queries));
}

TEST_F(PredictReadings, TakeASeedWithoutSamples) {
    const Log log = twoCameras();
    ASSERT_TRUE(writeCsv(path("log.csv"), log));
    queriesOf(log);
    const std::string queries = write("few.csv", firstLines(read("queries.csv"), 50));
    const auto drawn = [&](const std::string& seed) {
        const ProgramResult result = runMrose({"predict", path("some.net"), "--log", path("log.csv"), "--queries",
                                               queries, "--seed", seed, "-q", "-o", path(seed + ".csv")});
        EXPECT_EQ(result.status, 0) << result.err;
        return read(seed + ".csv");
    };
    EXPECT_NE(drawn("1"), drawn("2")) << "there are 40 unless more or fewer are asked for";
}

TEST_F(PredictReadings, SaysWhichDatasetALogWithoutNumberIsAndKnowsNoFlagsOfMotion) {
    const Log log = twoCameras();
    ASSERT_TRUE(writeCsv(path("log.csv"), log));
    const auto words = [&](const std::string& queries) {
        return std::vector<std::string>{
            "predict", path("some.net"), "--log", path("log.csv"),      "--queries", queries, "--samples",
            "1",       "--overwrite",    "-o",    path("predicted.csv")};
    };
    expectOneLine(runMrose(words(write("none.csv", "robot,t,subject\n"))),
                  {"none.csv:1: dataset", "dataset is 0 where the log has no number"});
    for (const char* const ofMotion : {"--horizon", "--at"}) {
        std::vector<std::string> more = words(path("none.csv"));
        more.insert(more.end(), {ofMotion, "3"});
        expectOneLine(runMrose(more), {ofMotion, "--queries"}, 2);
    }
    const ProgramResult done = runMrose(words(queriesOf(log)));
    ASSERT_EQ(done.status, 0) << done.err;
    EXPECT_THAT(done.out, testing::HasSubstr(" readings predicted, 1 sample of each\n"));
}

/// The looks of such a folder are the stamps of its readings: one reading of each stays.
TEST_F(PredictReadings, NoReadingOfAnMrclamFolderIsRead) {
    const CameraFolder folder;
    const auto log = readLog(folder.path());
    ASSERT_TRUE(log) << log.error().message();
    const std::string queries = queriesOf(*log), predictions = predicted(folder.path(), queries);
    EXPECT_THAT(predictions, testing::HasSubstr("\n1,1,"));

    struct Row {
        std::string time, barcode, values;
    };
    std::vector<Row> rows;
    std::vector<std::string> values;
    std::ifstream file(folder.path() + "/Robot1_Measurement.dat");
    for (std::string line; std::getline(file, line);) {
        Row row;
        if (line.starts_with('#') || !(std::istringstream(line) >> row.time >> row.barcode)) continue;
        row.values = line.substr(line.find(row.barcode, row.time.size()) + row.barcode.size());
        values.push_back(row.values);
        rows.push_back(row);
    }
    ASSERT_GT(rows.size(), 1000u);
    std::mt19937 random(5);
    std::ranges::shuffle(values, random);
    std::string text, before;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].time == before) continue;
        before = rows[i].time;
        text += before + ' ' + rows[i].barcode + values[i] + '\n';
        ++kept;
    }
    EXPECT_LT(kept, 3 * rows.size() / 4);
    folder.write(1, "Measurement", text);
    EXPECT_TRUE(predictions == predicted(folder.path(), queries));
}

}  // namespace
}  // namespace mrose
