#include "workflow/file_kind.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "logs/log_reader.h"

namespace mrose {
namespace {

constexpr const char* expected =
    "expected a scenario (.toml), a recording (.mcap), a network (.net), a log or results.csv";
constexpr std::string_view recordingMagic{"\x89MCAP", 5};

std::string notThis(const std::string& what) { return what + "; " + expected; }

/// The value of the key `format`, which begins a line.
std::string formatOf(std::string_view text) {
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = text.substr(begin, end - begin);
        begin = end + 1;
        if (!line.starts_with("format")) continue;
        const std::size_t equals = line.find('='), open = line.find('"');
        const std::size_t close = open == line.npos ? line.npos : line.find('"', open + 1);
        if (equals != line.npos && close != line.npos && equals < open)
            return std::string(line.substr(open + 1, close - open - 1));
    }
    return "";
}

bool isText(std::string_view bytes) {
    for (const char c : bytes)
        if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\r' && c != '\t') return false;
    return true;
}

Expected<std::string> beginningOf(const std::string& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) return fail(path, notThis("does not exist"));
    if (std::filesystem::is_directory(status)) return fail(path, notThis("is a folder without a log"));
    if (!std::filesystem::is_regular_file(status)) return fail(path, notThis("is no regular file"));
    std::ifstream file(path, std::ios::binary);
    if (!file) return fail(path, std::string("cannot be read: ") + std::strerror(errno));
    std::string bytes(std::size_t{1} << 16, '\0');
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
}

}  // namespace

Expected<FileKind> fileKind(const std::string& path) {
    std::error_code ignored;
    const bool folder = std::filesystem::is_directory(path, ignored);
    if (folder && looksLikeLog(path)) return FileKind::log;
    if (const std::string within = folder ? logsWithin(path) : ""; !within.empty()) return fail(path, within);
    const auto bytes = beginningOf(path);
    if (!bytes) return tl::unexpected(bytes.error());
    if (bytes->empty()) return fail(path, notThis("is empty"));
    if (bytes->starts_with(recordingMagic)) return FileKind::recording;
    if (!isText(*bytes)) return fail(path, notThis("is no description, recording or network of mrose"));
    const std::string format = formatOf(*bytes);
    if (format == "mrose scenario" || format == "mrose scenario value" || format == "mrose state" ||
        format == "mrose experiment" || format == "mrose validation")
        return FileKind::scenario;
    if (format == "mrose network" || format == "mrose motion network") return FileKind::network;
    if (format == "mrose shape" || format == "mrose environment" || format == "mrose robot")
        return fail(path, "describes " + std::string(format == "mrose environment" ? "an " : "a ") + format.substr(6) +
                              "; open a scenario that names it");
    if (bytes->starts_with("trial,seed,")) return FileKind::results;
    if (looksLikeLog(logOfFile(path))) return FileKind::log;
    // Its reader says what is wrong with it, and where.
    if (std::filesystem::path(path).extension() == ".toml") return FileKind::scenario;
    if (std::filesystem::path(path).extension() == ".net") return FileKind::network;
    return fail(path, notThis("is none of the files of mrose"));
}

}  // namespace mrose
