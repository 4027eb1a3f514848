// A camera of another class than what is learned: quantised, skewed, blind in a sector, and for a while.
#include <gtest/gtest.h>

#include "identification/calibration.h"
#include "identification/sensor_summary.h"
#include "identification/sensor_trainer.h"

namespace mrose {
namespace {

TEST(SyntheticCameras, DetectionsAndErrorsAreCalibrated) {
    const std::vector<Log> logs = referenceLogs(40, 1);
    const SensorSummary found = summariseSensor(logs, "camera", {});
    ASSERT_TRUE(found.lateness.identified) << found.lateness.reason;
    EXPECT_NEAR(found.lateness.lateness, 0.06, 0.005);
    SensorNetwork blueprint;
    blueprint.sensor = "camera";
    blueprint.latency = fromSeconds(found.lateness.lateness);
    blueprint.view = {7.5, 1.2};
    const SensorSampleOptions sampling{.sensor = "camera", .latency = blueprint.latency, .view = blueprint.view};
    SensorTrainerOptions options{.components = 3};
    options.reported.folds = options.error.folds = 2;
    options.reported.epochs = options.error.epochs = 200;
    const SensorSamples samples = sensorSamples(logs, sampling);
    const auto trained = trainSensor(blueprint, samples, options);
    ASSERT_TRUE(trained) << trained.error().message();
    const Calibration calibration(LearnedSensor(*trained), sensorSamples(referenceLogs(40, 2), sampling),
                                  constantNoise(samples, *trained));
    RecordProperty("log_likelihood", std::to_string(calibration.likelihood));
    RecordProperty("constant", std::to_string(calibration.ofConstant));
    RecordProperty("expected", std::to_string(calibration.expected / calibration.readings));
    EXPECT_GT(calibration.likelihood, calibration.ofConstant + 0.3);
    EXPECT_NEAR(calibration.readings / calibration.expected, 1, 0.05);
    for (std::size_t d = 0; d < 2; ++d) {
        RecordProperty("half_" + std::to_string(d), std::to_string(calibration.half[d]));
        RecordProperty("nearly_all_" + std::to_string(d), std::to_string(calibration.nearlyAll[d]));
        EXPECT_NEAR(calibration.half[d], 0.5, 0.05) << d;
        EXPECT_NEAR(calibration.nearlyAll[d], 0.9, 0.03) << d;
    }
}

}  // namespace
}  // namespace mrose
