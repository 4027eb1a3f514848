#include "scenario/perception_reader.h"

#include "scenario/description_reader.h"

namespace mrose {
namespace {

constexpr NumberRange probability{0, 1};
/// Late sensors need the poses of so much of the past in every state.
constexpr NumberRange latency{0, 1};
constexpr NumberRange metres{0, 100};
constexpr NumberRange degrees{0, 360};

/// { x_m, y_m, heading_deg }, standard deviations.
Pose deviation(TomlTable table) {
    const Pose pose{table.numberOr("x_m", 0, metres), table.numberOr("y_m", 0, metres),
                    angleOr(table, "heading_deg", 0, degrees)};
    table.rejectUnknown();
    return pose;
}

SelfLocalisation readSelf(TomlTable table) {
    SelfLocalisation self;
    self.noise = deviation(table.tableOrEmpty("noise"));
    self.bias = deviation(table.tableOrEmpty("bias"));
    self.biasTime = table.numberOr("bias_time_s", self.biasTime, {0.001, 1e6});
    self.latency = durationOr(table, "latency_s", self.latency, latency);
    self.dropOut = table.numberOr("drop_out", self.dropOut, probability);
    self.jump = table.numberOr("jump", self.jump, probability);
    self.jumpDistance = table.numberOr("jump_distance_m", self.jumpDistance, metres);
    table.rejectUnknown();
    return self;
}

BodySight readSight(TomlTable table) {
    BodySight sight;
    sight.present = table.booleanOr("present", sight.present);
    sight.bearingNoise = angleOr(table, "bearing_noise_deg", 0, degrees);
    sight.rangeNoise = table.numberOr("range_noise", sight.rangeNoise, {0, 10});
    sight.rangeNoiseSlope = table.numberOr("range_noise_per_m", sight.rangeNoiseSlope, {0, 10});
    sight.bearingBias = angleOr(table, "bearing_bias_deg", 0, degrees);
    sight.fieldOfView = angleOr(table, "field_of_view_deg", sight.fieldOfView, {1, 360});
    sight.range = table.numberOr("range_m", sight.range, {0, 10000});
    sight.latency = durationOr(table, "latency_s", sight.latency, latency);
    sight.dropOut = table.numberOr("drop_out", sight.dropOut, probability);
    sight.occlusion = table.booleanOr("occlusion", sight.occlusion);
    table.rejectUnknown();
    return sight;
}

}  // namespace

Perception readPerception(TomlTable table) {
    Perception perception;
    perception.self = readSelf(table.tableOrEmpty("self"));
    perception.objects = readSight(table.tableOrEmpty("objects"));
    perception.robots = readSight(table.tableOrEmpty("robots"));
    perception.velocityNoise = table.numberOr("velocity_noise_mps", 0, metres);
    perception.rotationNoise = angleOr(table, "rotation_noise_degps", 0, degrees);
    table.rejectUnknown();
    return perception;
}

}  // namespace mrose
