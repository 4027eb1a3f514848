#include "support/referee.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "support/places.h"

namespace mrose {
namespace {

std::optional<std::filesystem::path> named(const char* variable) {
    const char* const value = std::getenv(variable);
    return value == nullptr ? std::nullopt : std::optional<std::filesystem::path>(value);
}

std::filesystem::path rolloutReferee() {
    return named("MROSE_REFEREE").value_or(sourceFolder().parent_path() / "shared/tools/score_rollouts.py");
}

std::filesystem::path cameraReferee() {
    return named("MROSE_CAMERA_REFEREE").value_or(rolloutReferee().parent_path() / "score_perception.py");
}

/// A Python that has numpy.
std::optional<std::string> python() {
    for (const char* const name : {"python3", "/usr/bin/python3"})
        if (outputOf(name + std::string(" -c 'import numpy'"))) return name;
    return std::nullopt;
}

}  // namespace

std::optional<std::string> outputOf(const std::string& command) {
    FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    if (pipe == nullptr) return std::nullopt;
    std::string output;
    char part[4096];
    while (const std::size_t got = std::fread(part, 1, sizeof part, pipe)) output.append(part, got);
    if (pclose(pipe) != 0) return std::nullopt;
    return output;
}

std::optional<std::string> referee() {
    const auto runner = python();
    if (!runner || !std::filesystem::exists(rolloutReferee())) return std::nullopt;
    return *runner + " '" + rolloutReferee().string() + "'";
}

std::optional<std::string> cameraQueries(const std::string& folder, int dataset, const std::string& robots) {
    const auto script = cameraReferee();
    const auto runner = python();
    if (!runner || !std::filesystem::exists(script)) return std::nullopt;
    const std::string program =
        "import sys; sys.path.insert(0, sys.argv[1]); import " + script.stem().string() +
        " as referee\n"
        "for row in referee.queries(sys.argv[2], int(sys.argv[3]), [int(r) for r in sys.argv[4].split(\",\")]):\n"
        "    print(\"%d,%.3f,%d,%d,%.3f,%.3f\" % (row[0], row[1], row[2], row[5], row[6], row[7] + 0.0))";
    return outputOf(*runner + " -B -c '" + program + "' '" + script.parent_path().string() + "' '" + folder + "' " +
                    std::to_string(dataset) + " " + robots);
}

std::optional<std::string> cameraVerdict(const std::string& folder, int dataset, const std::string& robots,
                                         const std::string& file) {
    const auto runner = python();
    if (!runner || !std::filesystem::exists(cameraReferee())) return std::nullopt;
    return outputOf(*runner + " -B '" + cameraReferee().string() + "' score '" + folder + "' --dataset " +
                    std::to_string(dataset) + " --robots " + robots + " '" + file + "'");
}

double numberAfter(const std::string& text, const std::string& label) {
    const std::size_t at = text.find(label);
    return at == std::string::npos ? std::nan("") : std::strtod(text.c_str() + at + label.size(), nullptr);
}

}  // namespace mrose
