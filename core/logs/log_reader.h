#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "io/error.h"
#include "logs/robot_log.h"
#include "world/differential_drive.h"

namespace mrose {

struct LogOptions {
    double commandGap = 0.5;    ///< s: longer pauses between commands are counted as gaps
    double poseGap = 0.2;       ///< s: likewise between poses; nothing is interpolated across them
    double ballGap = 0.2;       ///< s: likewise between positions of the ball
    double lookSpan = 0.005;    ///< s: stamps of one sensor of a CSV log that are no farther apart are of one look
    bool dropBlips = true;      ///< single-sample zero commands
    DifferentialDrive drive{};  ///< for logs of wheel commands
};

/// Whether a place holds a log of some format, as far as its beginning shows: without reading it.
bool looksLikeLog(const std::filesystem::path& source);

/// The log that a file is of: of an MRCLAM folder any of its .dat files stands for the folder. Otherwise the file
/// itself.
std::filesystem::path logOfFile(const std::filesystem::path& file);

/// What to say of a folder that is no log but holds some, as folders or as CSV files: "is not a log itself; it holds a
/// and b: open one of them". "": it holds none.
std::string logsWithin(const std::filesystem::path& folder);

/// By Log::format.
constexpr std::array<std::string_view, 3> logFormats{"mrclam", "husky-windows", "csv"};

/// Whether a log's commands are of wheels, which are read by LogOptions::drive.
bool hasWheelCommands(const Log& log);

/// Opens a log of any known format: an MRCLAM folder, a Husky windows file, a CSV file or a folder of CSV files. Its
/// content says which one it is. Error: nothing known, or the first thing wrong with it.
Expected<Log> readLog(const std::filesystem::path& source, const LogOptions& options = {});

}  // namespace mrose
