#include "workflow/sensor_families.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "logs/log_reader.h"
#include "workflow/resources.h"
#include "workflow/train_sensor.h"

namespace mrose {
namespace {

bool isKnown(const SensorNetwork& network, const std::string& hash) {
    const std::vector<NetworkSource>& sources = network.learned.training.logs;
    return std::ranges::find(sources, hash, &NetworkSource::hash) != sources.end();
}

std::vector<LogFile> filesOf(const Log& log) {
    std::vector<LogFile> files = log.files;
    files.insert(files.end(), log.measurementFiles.begin(), log.measurementFiles.end());
    return files;
}

/// The log that a file is of, and nothing but what was learned from: the file's folder or itself, where it was or by
/// its name.
Expected<Log> logThatHolds(const std::filesystem::path& file, const SensorNetwork& network, const std::string& path) {
    const std::filesystem::path folder = file.parent_path();
    std::optional<Error> wrong;
    for (const std::filesystem::path& candidate :
         {folder, folder.filename(), file, folder.filename() / file.filename()}) {
        const std::string place = placeOfLog(candidate.string());
        if (candidate.empty() || !looksLikeLog(place)) continue;
        auto log = readLog(place);
        if (!log) return log;
        const std::vector<LogFile> files = filesOf(*log);
        const auto other = std::ranges::find_if(files, [&](const LogFile& of) { return !isKnown(network, of.hash); });
        if (other == files.end()) return log;
        if (!wrong)
            wrong = Error{.file = other->path, .cause = "has other content than what " + path + " was learned from"};
    }
    if (wrong) return tl::unexpected(*wrong);
    const auto place = existingLog((folder.filename() / file.filename()).string());
    if (!place) return tl::unexpected(place.error());
    return fail(*place, "is no part of a log, though " + path + " was learned from it");
}

Expected<std::vector<std::string>> logsOf(const SensorNetwork& network, const std::string& path) {
    if (network.learned.training.logs.empty())
        return fail(path, "does not say which logs it was learned from", 0, "training.logs");
    std::vector<std::string> places, read;
    for (const NetworkSource& source : network.learned.training.logs) {
        if (std::ranges::find(read, source.hash) != read.end()) continue;
        const auto log = logThatHolds(source.path, network, path);
        if (!log) return tl::unexpected(log.error());
        places.push_back(log->source);
        for (const LogFile& file : filesOf(*log)) read.push_back(file.hash);
        if (std::ranges::find(read, source.hash) == read.end())
            return fail(log->source, "no longer holds " + source.path + ", which " + path + " was learned from");
    }
    return places;
}

}  // namespace

std::string describedFamily(RegressorFamily family) {
    switch (family) {
        case RegressorFamily::table:
            return "lookup table";
        case RegressorFamily::trees:
            return "decision trees";
        default:
            return "network";
    }
}

Expected<std::vector<SensorNetwork>> learnOtherFamilies(const SensorNetwork& network, const std::string& path,
                                                        const Progress& progress) {
    auto logs = logsOf(network, path);
    if (!logs) return tl::unexpected(logs.error());
    TrainSensorRequest request{.logs = std::move(*logs), .sensor = network.sensor};
    request.robots = network.robots;
    request.latency = toSeconds(network.latency);
    request.training.seed = network.learned.training.seed;
    std::vector<SensorNetwork> others;
    for (std::size_t i = 0; i < sensorFamilyNames.size(); ++i) {
        request.training.family = static_cast<RegressorFamily>(i);
        if (request.training.family == familyOf(network.learned.regressor)) continue;
        const double done = static_cast<double>(others.size());
        auto trained = trainSensor(
            request, [&](double share) { return mayGoOn(progress, (done + share) / (sensorFamilyNames.size() - 1)); });
        if (!trained) return tl::unexpected(trained.error());
        others.push_back(std::move(trained->network));
    }
    return others;
}

}  // namespace mrose
