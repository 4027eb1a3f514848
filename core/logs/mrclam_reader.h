#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "logs/log_reader.h"

namespace mrose {

/// True where the folder holds at least one Robot<N>_Odometry.dat.
bool isMrclamFolder(const std::filesystem::path& folder);

/// A folder of the UTIAS multi-robot data sets as published (Leung, Halpern, Barfoot, Liu, IJRR 2011): one robot for
/// each Robot<N>_Odometry.dat, in the order of N, with one trajectory; poses from Robot<N>_Groundtruth.dat where it
/// exists, and what the cameras saw (mrclam_measurements.h). A file with fewer than 2 rows is as good as none;
/// Log::incomplete says so, and a robot of which nothing is left is not in the log. Error: the first thing wrong with a
/// file; nothing is left of any robot.
Expected<Log> readMrclam(const std::filesystem::path& folder, const LogOptions& options = {});

/// The rows of an odometry file: time [s], v [m/s], w [rad/s], separated by blanks; lines that begin with # are
/// comments. As in the file, not conditioned; a last line that is cut off is left out and counted. `name` is for
/// errors: another number of columns, no number where one belongs, time running backwards for good.
Expected<std::vector<StampedCommand>> parseMrclamOdometry(std::string_view content, const std::string& name,
                                                          LogDefects& defects);

/// Likewise for a ground truth file: time [s], x [m], y [m], heading [rad].
Expected<std::vector<StampedPose>> parseMrclamGroundtruth(std::string_view content, const std::string& name,
                                                          LogDefects& defects);

}  // namespace mrose
