#include "workflow/sensor_families.h"

#include <algorithm>
#include <filesystem>

#include "logs/log_reader.h"
#include "workflow/resources.h"
#include "workflow/train_sensor.h"

namespace mrose {
namespace {

/// The log that a file is of, where it was when it was learned from, or by its name.
Expected<std::string> logThatHolds(const std::filesystem::path& file) {
    const std::filesystem::path byName = file.parent_path().filename() / file.filename();
    for (const std::filesystem::path& candidate : {file, byName, file.filename()}) {
        const std::filesystem::path place = logOfFile(placeOfLog(candidate.string()));
        if (looksLikeLog(place)) return place.string();
    }
    return existingLog(byName.string()).and_then([&](const std::string& place) -> Expected<std::string> {
        return fail(place, "is no log any more");
    });
}

Expected<std::vector<std::string>> logsOf(const SensorNetwork& network, const std::string& path) {
    std::vector<std::string> logs;
    const std::vector<NetworkSource>& sources = network.learned.training.logs;
    if (sources.empty()) return fail(path, "does not say which logs it was learned from", 0, "training.logs");
    for (const NetworkSource& source : sources) {
        auto log = logThatHolds(source.path);
        if (!log) return tl::unexpected(log.error());
        if (std::ranges::find(logs, *log) == logs.end()) logs.push_back(std::move(*log));
    }
    return logs;
}

Expected<void> checkContent(const std::vector<std::string>& logs, const SensorNetwork& network,
                            const std::string& path) {
    for (const std::string& place : logs) {
        const auto log = readLog(place);
        if (!log) return tl::unexpected(log.error());
        for (const auto* files : {&log->files, &log->measurementFiles})
            for (const LogFile& file : *files)
                if (std::ranges::find(network.learned.training.logs, file.hash, &NetworkSource::hash) ==
                    network.learned.training.logs.end())
                    return fail(file.path, "has other content than what " + path + " was learned from");
    }
    return {};
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
    if (auto same = checkContent(*logs, network, path); !same) return tl::unexpected(same.error());
    TrainSensorRequest request{.logs = std::move(*logs), .sensor = network.sensor};
    request.robots = network.robots;
    request.latency = toSeconds(network.latency);
    request.training.seed = network.learned.training.seed;
    std::vector<SensorNetwork> others;
    for (std::size_t i = 0; i < regressorFamilyNames.size(); ++i) {
        request.training.family = static_cast<RegressorFamily>(i);
        if (request.training.family == familyOf(network.learned.regressor)) continue;
        const double done = static_cast<double>(others.size());
        auto trained = trainSensor(request, [&](double share) {
            return mayGoOn(progress, (done + share) / (regressorFamilyNames.size() - 1));
        });
        if (!trained) return tl::unexpected(trained.error());
        if (trained->cancelled) return fail(path, "was not compared: cancelled");
        others.push_back(std::move(trained->network));
    }
    return others;
}

}  // namespace mrose
