#pragma once

#include <filesystem>
#include <string>

#include "io/error.h"
#include "logs/robot_log.h"

namespace mrose {

/// The log as the text that readCsv reads: commands, poses and what sensors reported come back bit for bit, times to
/// the nanosecond. Columns are there where they say something; commands and poses always. Asserts that numbers are
/// finite.
std::string toCsv(const Log& log);

/// Error: what the system says, with an earlier file at `path` untouched.
Expected<void> writeCsv(const std::filesystem::path& path, const Log& log);

}  // namespace mrose
