#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "logs/log_reader.h"

namespace mrose {

/// The windows of a Clearpath Husky cut from norlab-ulaval/DRIVE: one robot "husky", one trajectory for each window,
/// with `group` its calib_step (that of its command where the file has the one before) and `steady` from the column.
/// Wheel commands become body commands by LogOptions::drive.
///
/// Poses are those of the column icp_*: each window has its own origin, sample-and-hold at about 10 Hz, 0.15 s late
/// against the gyro. The column imu_yaw_rad is a yaw *rate* in spite of its name (its integral follows icp_yaw_rad with
/// a slope of 0.99): it becomes Trajectory::measuredRotation. Wheel speeds become Trajectory::measuredVelocity.
///
/// Windows follow each other without a pause within a calib_step and mostly between steps too. Where they do
/// (README.md), commands and measured velocities of up to 4 s before the window stand in its trajectory as its past;
/// poses never. Error: the first thing wrong with the file.
Expected<Log> readHusky(const std::filesystem::path& file, const LogOptions& options = {});

Expected<Log> parseHusky(std::string_view content, const std::string& name, const LogOptions& options = {});

/// True where the header is that of the windows.
bool looksLikeHusky(std::string_view content);

}  // namespace mrose
