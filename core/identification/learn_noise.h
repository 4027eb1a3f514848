#pragma once

#include <optional>
#include <string>
#include <vector>

#include "identification/motion_samples.h"
#include "identification/network_trainer.h"
#include "io/progress.h"
#include "logs/robot_log.h"

namespace mrose {

/// How many networks like the one whose noise it is are learned, each from the logs without one part of so many.
constexpr int noiseParts = 3;

struct LearnedNoise {
    std::optional<ResidualNoise> noise;
    std::string missing;         ///< why there is none
    bool cancelled = false;      ///< then there is none
    bool ofKnownRobots = false;  ///< the logs have too few robots to keep some from learning: only time was kept
};

/// The noise of networks of this blueprint: of what those that are learned from two thirds of the logs get wrong over
/// the third that they do not know. The thirds are whole robots where there are three, for robots differ from each
/// other too; else groups of trajectories or blocks of time. `sampling` and `options`: as the network itself was
/// learned; the noise itself in at most as many epochs. `learns` is told of the members of all noiseParts networks
/// together, the first of them being 0.
LearnedNoise learnNoise(std::vector<Log> logs, const MotionNetwork& blueprint, const SampleOptions& sampling,
                        const NetworkTrainerOptions& options, const NetworkProgressCallback& learns = {},
                        const Progress& fits = {});

}  // namespace mrose
