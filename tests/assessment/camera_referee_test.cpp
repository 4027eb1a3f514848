// Scores of a camera on real logs, beside those of the independent referee.
#include <cmath>
#include <filesystem>
#include <sstream>

#include <gtest/gtest.h>
#include <unistd.h>

#include "assessment/sensor_assessment.h"
#include "assessment/sensor_queries.h"
#include "io/file.h"
#include "logs/log_reader.h"
#include "support/places.h"
#include "support/referee.h"
#include "support/temporary_folder.h"
#include "support/test_data.h"
#include "support/toy_camera.h"
#include "workflow/predict_readings.h"

namespace mrose {
namespace {

constexpr int refereeDraws = 32;

/// What a model says of all cases, as the referee reads it.
std::string samplesOf(const SensorEvaluation& evaluation) {
    std::vector<SensorQuery> queries;
    std::vector<SensorPrediction> predictions;
    for (const LoggedLook& look : evaluation.log.looks)
        for (std::size_t i = look.first; i < look.first + look.count; ++i) {
            queries.push_back({evaluation.log.dataset, evaluation.log.robots[look.robot].name,
                               evaluation.log.subjects[evaluation.log.cases[i].subject], look.time});
            const CasePrediction& of = evaluation.models[0].predictions[i];
            SensorPrediction& prediction = predictions.emplace_back();
            prediction.state.range = of.range;
            prediction.state.bearing = of.bearing;
            prediction.distribution = of.distribution;
            prediction.inView = true;
        }
    return sensorSamplesCsv(SensorMeasures::subjects, queries, predictions, refereeDraws, 1);
}

/// How likely a reading that has so much probability below it is in the central part by the referee: by its rank among
/// so many samples.
double likelyInside(double below, double part) {
    double likely = 0;
    for (int rank = 0; rank <= refereeDraws; ++rank) {
        if (std::abs((rank + 0.5) / (refereeDraws + 1) - 0.5) > 0.5 * part) continue;
        double binomial = 1;
        for (int i = 0; i < rank; ++i) binomial *= static_cast<double>(refereeDraws - i) / (i + 1);
        likely += binomial * std::pow(below, rank) * std::pow(1 - below, refereeDraws - rank);
    }
    return likely;
}

/// In percent, of the sound readings of a robot.
double insideByRank(const SensorEvaluation& evaluation, std::size_t robot, std::size_t dimension, double part) {
    double inside = 0, readings = 0;
    for (const LoggedLook& look : evaluation.log.looks)
        for (std::size_t i = look.first; look.robot == robot && i < look.first + look.count; ++i) {
            if (!evaluation.log.cases[i].sound) continue;
            ++readings;
            inside += likelyInside(evaluation.models[0].scores[i].below[dimension], part);
        }
    return 100 * inside / readings;
}

TEST(CameraReferee, FindsTheSameCasesAndScores) {
    const auto data = realData();
    if (!data || !std::filesystem::is_directory(*data / "mrclam/MRCLAM_Dataset7")) GTEST_SKIP() << "no real logs";
    const auto log = readLog(*data / "mrclam/MRCLAM_Dataset7");
    ASSERT_TRUE(log) << log.error().message();
    const std::vector<std::string> robots{"1", "2"};
    auto cases = loggedCases(*log, "camera", robots, {});
    ASSERT_TRUE(cases) << cases.error().message();
    const ToyCamera camera;
    const NamedSensor named{"toy", &camera};
    const auto evaluation = evaluateSensors(*log, std::move(*cases), {&named, 1});
    ASSERT_TRUE(evaluation) << evaluation.error().message();
    const auto file = std::filesystem::temp_directory_path() / ("mrose_camera_" + std::to_string(getpid()) + ".csv");
    ASSERT_TRUE(writeFileAtomically(file, samplesOf(*evaluation)));
    const auto verdict = cameraVerdict((*data / "mrclam").string(), 7, "1,2", file.string());
    std::filesystem::remove(file);
    if (!verdict) GTEST_SKIP() << "no referee of cameras with numpy";
    const SensorAssessment& toy = evaluation->models[0];
    const std::string total = verdict->substr(verdict->find("queries="));
    // It refuses predictions of other queries than its own.
    EXPECT_EQ(numberAfter(total, "queries="), static_cast<double>(toy.all.cases)) << *verdict;
    EXPECT_EQ(numberAfter(total, "reported="), static_cast<double>(toy.all.readings));
    EXPECT_NEAR(numberAfter(total, "detection="), toy.all.detection, 1e-4);
    EXPECT_NEAR(numberAfter(total, "off="), 100 * toy.all.off, 0.06);
    EXPECT_NEAR(numberAfter(total, "range="), 100 * toy.all.error[0].crps, 0.05);
    for (std::size_t i = 0; i < robots.size(); ++i)
        for (std::size_t d = 0; d < readingDimensions; ++d) {
            const std::string row =
                verdict->substr(verdict->find("robot " + robots[i] + "  " + (d == 0 ? "range" : "bearing")));
            const ErrorScores& ours = toy.byRobot[i].error[d];
            const double unit = d == 0 ? 100 : 1000;
            // three standard deviations of a share, in percent
            const double sampling = 150 / std::sqrt(static_cast<double>(toy.byRobot[i].sound));
            EXPECT_NEAR(numberAfter(row, "crps"), unit * ours.crps, 0.02 * unit * ours.crps) << row;
            EXPECT_NEAR(numberAfter(row, "rmse"), unit * ours.rmse, 0.04 * unit * ours.rmse) << row;
            EXPECT_NEAR(numberAfter(row, "50 %:"), insideByRank(*evaluation, i, d, 0.5), sampling) << row;
            EXPECT_NEAR(numberAfter(row, "90 %:"), insideByRank(*evaluation, i, d, 0.9), sampling) << row;
        }
}

/// What nets/create_camera.net has to reach on a data set that it was not learned from, by a program independent of
/// this one.
TEST(CameraReferee, FindsTheShippedNetworkWithinItsBounds) {
    const auto data = realData();
    if (!data || !std::filesystem::is_directory(*data / "mrclam/MRCLAM_Dataset7"))
        GTEST_SKIP() << "no real logs: set MROSE_DATA";
    const std::string folder = (*data / "mrclam").string();
    const auto rows = cameraQueries(folder, 7, "1,2");
    if (!rows) GTEST_SKIP() << "no referee of cameras, or no Python with numpy";
    std::istringstream lines(*rows);
    std::string queries = "dataset,robot,t,subject\n";
    for (std::string line; std::getline(lines, line);) {
        std::size_t end = 0;
        for (int column = 0; column < 3; ++column) end = line.find(',', end + 1);
        queries += "7," + line.substr(0, end) + '\n';
    }
    const TemporaryFolder work;
    const std::string samples = (work.path() / "samples.csv").string();
    PredictReadingsRequest request{(sourceFolder() / "nets/create_camera.net").string(), folder + "/MRCLAM_Dataset7",
                                   work.write("queries.csv", queries).string(), samples};
    request.robots = {"1", "2"};
    request.samples = 40;
    const auto predicted = predictReadings(request);
    ASSERT_TRUE(predicted) << predicted.error().message();
    const auto verdict = cameraVerdict(folder, 7, "1,2", samples);
    ASSERT_TRUE(verdict) << "the referee refuses the predictions";
    const std::string total = verdict->substr(verdict->find("queries="));
    EXPECT_EQ(numberAfter(total, "queries="), static_cast<double>(predicted->queries));
    EXPECT_LE(numberAfter(total, "range="), 1.5) << "cm";
    EXPECT_LE(numberAfter(total, "bearing[2]="), 4.6) << "mrad";
    EXPECT_GE(numberAfter(total, "detection="), -0.4) << "mean logarithm of the likelihood";
    EXPECT_LE(numberAfter(total, "off="), 6) << "percentage points";
}

}  // namespace
}  // namespace mrose
