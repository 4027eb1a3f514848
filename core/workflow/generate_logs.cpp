#include "workflow/generate_logs.h"

#include "io/file.h"
#include "io/made_folder.h"
#include "logs/csv_writer.h"

namespace mrose {
namespace {

constexpr double longestLog = 1e6;  // s, of all trajectories of a file

bool shapedByItself(DrivePattern pattern) { return pattern == DrivePattern::jink || pattern == DrivePattern::ellipse; }

Expected<std::vector<SyntheticPart>> partsOf(const GenerateRequest& request) {
    if (request.set.empty() == request.pattern.empty())
        return fail({}, "exactly one of them says what to drive", 0, "--set, --pattern");
    std::vector<SyntheticPart> parts;
    for (const SyntheticSet& set : syntheticSets())
        if (set.name == request.set) parts = set.parts;
    for (int i = 0; i < patternCount; ++i)
        if (name(DrivePattern(i)) == request.pattern) parts = {{DrivePattern(i)}};
    if (parts.empty())
        return fail({}, '"' + request.set + request.pattern + "\" is none that is known", 0,
                    request.set.empty() ? "--pattern" : "--set");
    for (SyntheticPart& part : parts) {
        if (!shapedByItself(part.pattern)) part.duration = request.duration.value_or(part.duration);
        part.trajectories = request.trajectories.value_or(part.trajectories);
        part.repeats = request.repeats.value_or(part.repeats);
        part.sensors = request.sensors;
    }
    return parts;
}

double secondsOf(const SyntheticPart& part) { return durationOf(part) * part.trajectories * part.repeats; }

std::filesystem::path fileOf(const GenerateRequest& request, const SyntheticPart& part) {
    return std::filesystem::path(request.folder) / (std::string(name(part)) + ".csv");
}

/// The folder, made; error where a file could not be written into it, or is there already.
Expected<MadeFolder> prepare(const GenerateRequest& request, const std::vector<SyntheticPart>& parts) {
    for (const SyntheticPart& part : parts)
        if (secondsOf(part) > longestLog)
            return fail({}, "more than 1,000,000 s of driving in one file", 0, "--trajectories");
    auto made = MadeFolder::make(request.folder);
    if (!made) return made;
    for (const SyntheticPart& part : parts)
        if (auto can = checkWritable(fileOf(request, part), request.overwrite); !can)
            return tl::unexpected(can.error());
    return made;
}

/// All logs; fewer where `progress` ended it.
std::vector<Log> drive(const std::vector<SyntheticPart>& parts, std::uint64_t seed, const Progress& progress) {
    double seconds = 0, before = 0;
    for (const SyntheticPart& part : parts) seconds += secondsOf(part);
    std::vector<Log> logs;
    for (const SyntheticPart& part : parts) {
        auto log = generateLog(
            part, seed, [&](double done) { return mayGoOn(progress, (before + done * secondsOf(part)) / seconds); });
        if (!log) break;
        before += secondsOf(part);
        logs.push_back(std::move(*log));
    }
    return logs;
}

}  // namespace

Expected<std::vector<GeneratedLog>> generateLogs(const GenerateRequest& request, const Progress& progress) {
    const auto parts = partsOf(request);
    if (!parts) return tl::unexpected(parts.error());
    const auto folder = prepare(request, *parts);
    if (!folder) return tl::unexpected(folder.error());
    const std::vector<Log> logs = drive(*parts, request.seed, progress);
    if (logs.size() < parts->size()) return fail(request.folder, "was not filled: cancelled");
    std::vector<GeneratedLog> generated;
    for (std::size_t i = 0; i < logs.size(); ++i) {
        const SyntheticPart& part = (*parts)[i];
        const std::filesystem::path file = fileOf(request, part);
        if (auto written = writeCsv(file, logs[i]); !written) return tl::unexpected(written.error());
        generated.push_back(
            {file, std::string(name(part)), logs[i].robots.front().trajectories.size(), part.repeats, secondsOf(part)});
    }
    return generated;
}

}  // namespace mrose
