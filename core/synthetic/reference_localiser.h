#pragma once

#include <cstdint>

#include "logs/measurements.h"
#include "synthetic/true_path.h"

namespace mrose {

/// A self-localisation as a robot's own program might have: bearings of the field's landmarks are triangulated and
/// correct what odometry carries on. All constants are assumptions. Lengths in m, angles in rad, times in s.
struct ReferenceLocaliserParameters {
    double period = 0.100;
    double latency = 0.100, latencyJitter = 0.020;  ///< the jitter: evenly, up to so much to either side

    double range = 9, fieldOfView = 4;                  ///< of the landmarks that are used
    double bearingNoise = 0.2;                          ///< of each landmark: Laplace's distribution
    double blur = 1;                                    ///< s/rad: how much more noise there is while turning
    double lens = 0.008;                                ///< largest error of a bearing by where it is in the picture
    double priorPosition = 0.5, priorHeading = 0.3;     ///< within which a fit is sought about the last belief
    double gain = 0.08;                                 ///< share of a fit that is taken over
    double slip = 0.05, turnSlip = 0.06;                ///< of what is driven and turned, in the root of the way
    double whitePosition = 0.02, whiteHeading = 0.015;  ///< of each report: Student's distribution
    double mapError = 0.025;                            ///< the field is measured wrong by so much, in waves

    double burstRate = 0.05, turningBurstRate = 0.5;  ///< 1/s: standing, and at 1 rad/s, by the square
    double burstLength = 0.35;
    double jump = 0.005, jumpDistance = 0.5;  ///< share of the reports
    double mirrored = 0.001;                  ///< share at the pose turned by half a turn about the field's middle

    bool operator==(const ReferenceLocaliserParameters&) const = default;
};

/// What it reports along a path: a sensor "localisation" with poses. A function of the seed.
SensorLog localise(const TruePath& path, std::uint64_t seed, const ReferenceLocaliserParameters& parameters = {});

}  // namespace mrose
