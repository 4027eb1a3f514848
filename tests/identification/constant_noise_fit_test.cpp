#include "identification/constant_noise_fit.h"

#include <gtest/gtest.h>

#include "assessment/sensor_model.h"
#include "support/toy_camera.h"

namespace mrose {
namespace {

TEST(ConstantNoiseFit, FindsTheNoiseOfAnIdealSensor) {
    SensorNetwork sensor;
    sensor.view = {6, 1.2};
    sensor.latency = 40'000'000;
    sensor.constant = {0.7, 0.02, {0.05, 0.01}};
    const Log log = seenLog(IdealSensorModel(sensor, IdealSensorModel::Noise::constant), 600);
    const SensorSamples samples =
        sensorSamples({&log, 1}, {.sensor = "camera", .latency = sensor.latency, .view = sensor.view});
    const ConstantNoise found = fitConstantNoise(sensor, samples, soundErrors(samples, 2));
    EXPECT_NEAR(found.seen, 0.7, 0.03);
    EXPECT_NEAR(found.unseen, 0.02, 0.01);
    EXPECT_NEAR(found.spread[0], 0.05, 0.003);
    EXPECT_NEAR(found.spread[1], 0.01, 0.0006);
}

}  // namespace
}  // namespace mrose
