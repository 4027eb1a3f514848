#include "logs/log_reader.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "logs/csv_reader.h"
#include "logs/husky_reader.h"
#include "logs/mrclam_reader.h"

namespace mrose {
namespace {

/// Enough for comments and a header line.
std::string beginning(const std::filesystem::path& file) {
    std::string text(1 << 16, '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    return text;
}

/// Whether a folder holds a CSV file, or one that begins as a log does.
bool holdsCsv(const std::filesystem::path& folder, bool logs = false) {
    std::error_code ignored;
    for (std::filesystem::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
         entry.increment(ignored))
        if (entry->path().extension() == ".csv" && (!logs || looksLikeCsvLog(beginning(entry->path())))) return true;
    return false;
}

/// "a, b and c": the first few names.
std::string listed(std::vector<std::string> names) {
    constexpr std::size_t most = 6;
    std::sort(names.begin(), names.end());
    const std::size_t more = names.size() > most ? names.size() - most + 1 : 0;
    if (more > 0) {
        names.resize(most - 1);
        names.push_back(std::to_string(more) + " more");
    }
    std::string text = names.front();
    for (std::size_t i = 1; i < names.size(); ++i) text += (i + 1 < names.size() ? ", " : " and ") + names[i];
    return text;
}

}  // namespace

std::filesystem::path logOfFile(const std::filesystem::path& file) {
    std::error_code ignored;
    if (file.extension() != ".dat" || !std::filesystem::is_regular_file(file, ignored)) return file;
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
    return isMrclamFolder(folder) ? folder : file;
}

std::string logsWithin(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    std::error_code ignored;
    for (std::filesystem::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
         entry.increment(ignored))
        if ((entry->is_directory(ignored) || entry->path().extension() == ".csv") && looksLikeLog(entry->path()))
            names.push_back(entry->path().filename().string());
    if (names.empty()) return "";
    const bool one = names.size() == 1;
    return "is not a log itself; it holds " + listed(std::move(names)) + (one ? ": open that" : ": open one of them");
}

bool looksLikeLog(const std::filesystem::path& source) {
    std::error_code ignored;
    if (std::filesystem::is_directory(source, ignored)) return isMrclamFolder(source) || holdsCsv(source, true);
    if (!std::filesystem::is_regular_file(source, ignored)) return false;
    const std::string text = beginning(source);
    return looksLikeHusky(text) || looksLikeCsvLog(text);
}

bool hasWheelCommands(const Log& log) { return log.format == "husky-windows"; }

Expected<Log> readLog(const std::filesystem::path& source, const LogOptions& options) {
    std::error_code error;
    if (std::filesystem::is_directory(source, error)) {
        if (isMrclamFolder(source)) return readMrclam(source, options);
        const std::string within = holdsCsv(source, true) ? "" : logsWithin(source);
        if (!within.empty()) return fail(source.string(), within);
        if (holdsCsv(source)) return readCsv(source, options);
        return fail(source.string(), "is a folder without a log; expected Robot<N>_Odometry.dat or *.csv files in it");
    }
    if (!std::filesystem::exists(source, error)) return fail(source.string(), "does not exist");
    const std::string text = beginning(source);
    if (looksLikeHusky(text)) return readHusky(source, options);
    if (looksLikeCsvLog(text)) return readCsv(source, options);
    return fail(source.string(), text.empty() ? "is empty or cannot be read; expected a log"
                                              : "is no log; expected a CSV file whose first line names a column t");
}

}  // namespace mrose
