#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "logs/log_reader.h"

namespace mrose {

/// A CSV log, or a folder whose *.csv files are one log (README.md in this folder defines the format). Robots and
/// trajectories come in the order of their first row, files in the order of their names. Error: the first thing wrong.
Expected<Log> readCsv(const std::filesystem::path& source, const LogOptions& options = {});

/// One file's text as a log of its own, for tests and fuzzing.
Expected<Log> parseCsv(std::string_view content, const std::string& name, const LogOptions& options = {});

/// True where the header has a column t.
bool looksLikeCsvLog(std::string_view content);

}  // namespace mrose
