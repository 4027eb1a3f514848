#pragma once

#include <cstdint>

#include "logs/measurements.h"
#include "synthetic/true_path.h"

namespace mrose {

/// A camera as a picture is made: bearings are columns of it, and ranges follow from how high a landmark appears. All
/// constants are assumptions. Lengths in m, angles in rad, times in s, pictures in pixels.
struct ReferenceCameraParameters {
    double period = 0.200;
    double latency = 0.060, latencyJitter = 0.005;  ///< the jitter: evenly, up to so much to either side

    double range = 8, fieldOfView = 1.2;
    double focalLength = 500, landmarkHeight = 0.5;
    double column = 4;                            ///< pixels that are told apart only so
    double columnNoise = 1.5, heightNoise = 0.9;  ///< Laplace's distribution
    double lens = 6;                              ///< pixels by which the picture's edge is distorted
    double blooming = 0.02;                       ///< share by which a landmark appears higher
    double blindFrom = 0.24, blindTo = 0.31;      ///< bearings that a strut hides
    double halfSeen = 5.5, halfSeenWidth = 0.5;   ///< where half of the landmarks are recognised
    double burstRate = 0.02, burstLength = 1.5;   ///< of glare: 1/s; the robot sees nothing
    double confused = 0.002;                      ///< share of readings that are anywhere in the picture

    bool operator==(const ReferenceCameraParameters&) const = default;
};

/// What it reports along a path: a sensor "camera" with looks at fieldLandmarks(). A function of the seed.
SensorLog photograph(const TruePath& path, std::uint64_t seed, const ReferenceCameraParameters& parameters = {});

}  // namespace mrose
