#pragma once

#include <numbers>

#include "geometry/pose.h"
#include "world/time.h"

namespace mrose {

/// How a robot knows where it is. Everything zero: exactly and at once.
struct SelfLocalisation {
    Pose noise;                 ///< standard deviations of one measurement: m, m, rad
    Pose bias;                  ///< standard deviations of a bias that drifts: m, m, rad
    double biasTime = 1.5;      ///< s, its correlation time (first-order autoregressive)
    Nanoseconds latency = 0;    ///< the age of a measurement when it arrives
    double dropOut = 0;         ///< probability that one does not
    double jump = 0;            ///< probability that one is off by about jumpDistance
    double jumpDistance = 0.5;  ///< m, standard deviation in x and y
    bool operator==(const SelfLocalisation&) const = default;
};

/// How it sees other bodies. Everything zero: exactly, at once, in all directions, through everything.
struct BodySight {
    bool present = true;         ///< false: it does not see them at all
    double bearingNoise = 0;     ///< rad, standard deviation
    double rangeNoise = 0;       ///< share of the range, standard deviation at range 0 ...
    double rangeNoiseSlope = 0;  ///< ... and what each metre adds to that share
    /// rad, standard deviation of a bias that drifts with SelfLocalisation::biasTime, of robots and objects together.
    double bearingBias = 0;
    double fieldOfView = 2 * std::numbers::pi;  ///< rad
    double direction = 0;                       ///< rad, of its middle, counter-clockwise from the heading
    double range = 0;                           ///< m; 0: as far as there is
    Nanoseconds latency = 0;
    double dropOut = 0;
    bool occlusion = false;  ///< obstacles and other bodies hide what is behind them
    bool operator==(const BodySight&) const = default;
};

struct Perception {
    /// What class of errors a robot's own pose and the bodies that it sees have.
    enum class Model {
        noise,     ///< normal and autoregressive, as the numbers here say
        reference  ///< the reference cameras' (synthetic/), of which the numbers here say only where they look, and how
                   ///< late
    };
    Model model = Model::noise;
    double errorScale = 1;  ///< of the reference model: how large its errors are, but for gross ones
    SelfLocalisation self;
    BodySight objects;  ///< the ball and other objects
    BodySight robots;
    double velocityNoise = 0;  ///< m/s, standard deviation of the robot's own speed
    double rotationNoise = 0;  ///< rad/s
    bool operator==(const Perception&) const = default;
};

}  // namespace mrose
