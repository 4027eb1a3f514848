#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/pose.h"
#include "world/command.h"
#include "world/differential_drive.h"

namespace mrose {

/// A part of a robot's log that a simulated robot is to be driven by.
struct LogExcerpt {
    std::string log;         ///< the log's name, joined from where it is referred to
    std::string reference;   ///< as it is written there
    std::string robot;       ///< as the log calls it
    std::string trajectory;  ///< "": the first
    double start = 0;        ///< s after the log's start: what becomes the run's start
    /// How wheel commands are read, where the robot's network says it: as it was learned.
    std::optional<DifferentialDrive> drive = {};

    /// What distinguishes it, in one text.
    std::string name() const;
};

/// What such a part holds.
struct ExcerptContent {
    std::vector<StampedCommand> commands;  ///< times count from the run's start; some may lie before
    std::optional<Pose> start;             ///< none: the log has no ground truth
};

/// A robot that is given the commands of a real one.
struct LogPlayer {
    std::uint32_t robot = 0;  ///< in the scene
    LogExcerpt excerpt;
};

}  // namespace mrose
