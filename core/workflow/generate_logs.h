#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/error.h"
#include "io/progress.h"
#include "synthetic/log_generator.h"

namespace mrose {

/// What the reference robot is to drive: a set of drive patterns, or one.
struct GenerateRequest {
    std::string folder;                   ///< for the logs, a CSV file for each pattern; made where it is missing
    bool overwrite = false;               ///< of files that are there already
    std::string set = {}, pattern = {};   ///< by name: one of them
    std::optional<double> duration = {};  ///< s, of a trajectory; jink and ellipse take as long as they take
    std::optional<int> trajectories = {}, repeats = {};
    bool sensors = false;  ///< with what the robot's localisation and camera report
    std::uint64_t seed = 1;
};

struct GeneratedLog {
    std::filesystem::path file;
    std::string pattern;  ///< or what was done with the ball
    std::size_t trajectories = 0;
    int repeats = 1;
    double seconds = 0;  ///< of all trajectories
};

/// Drives all, then writes. Error: not exactly one of set and pattern; too long; a file cannot be written
/// or is there already; it was cancelled.
Expected<std::vector<GeneratedLog>> generateLogs(const GenerateRequest& request, const Progress& progress = {});

}  // namespace mrose
