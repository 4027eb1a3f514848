#pragma once

#include <string>
#include <vector>

#include "io/error.h"
#include "logs/robot_log.h"
#include "world/differential_drive.h"

namespace mrose {

/// Which wheel speeds are taken for the truth of the wheels.
enum class WheelSource {
    commands,  ///< Trajectory::commands
    measured   ///< Trajectory::measuredVelocity: on slippery ground wheels do not reach what they are commanded
};

/// One stretch of steady motion: mean wheel speeds against how the body moved.
struct SteadyMotion {
    DifferentialDrive::WheelSpeeds wheels;  ///< rad/s, mean over the poses' duration
    double duration = 0;                    ///< s
    Pose end;                               ///< in the frame of the first pose
    double path = 0;                        ///< m, summed over steps of at least 0.1 s
    int group = 0;
};

/// Of every trajectory that is marked steady. `readWith` is the drive that turned the log's wheels into commands.
/// Stretches with a path below 2 cm are left out.
std::vector<SteadyMotion> steadyMotions(const Log& log, WheelSource source, const DifferentialDrive& readWith = {});

struct DriveFit {
    DifferentialDrive drive;
    double wheelRadiusError = 0, trackError = 0;  ///< m, one standard error, by leaving groups out (jackknife)
    std::size_t motions = 0;
};

/// Effective geometry by least squares of the mean body twists: a skid-steered robot's track comes out larger than the
/// distance of its wheels, because they scrub. Error: fewer than 3 motions, or none that turns or none that drives.
Expected<DriveFit> fitDrive(const std::vector<SteadyMotion>& motions, const std::string& source = "log");

}  // namespace mrose
