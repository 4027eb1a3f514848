#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "common.h"
#include "io/file.h"
#include "io/made_folder.h"
#include "logs/csv_writer.h"
#include "synthetic/log_generator.h"

namespace mrose::cli {
namespace {

struct GenerateFlags {
    std::string out, set, pattern;
    std::optional<double> duration;
    std::optional<int> trajectories, repeats;
};

constexpr double longestLog = 1e6;  // s, of all trajectories of a file

struct GeneratedFile {
    std::filesystem::path path;
    Log log;
};

bool shapedByItself(DrivePattern pattern) { return pattern == DrivePattern::jink || pattern == DrivePattern::ellipse; }

std::vector<SyntheticPart> partsOf(const GenerateFlags& flags) {
    std::vector<SyntheticPart> parts;
    for (const SyntheticSet& set : syntheticSets())
        if (set.name == flags.set) parts = set.parts;
    for (int i = 0; i < patternCount; ++i)
        if (name(DrivePattern(i)) == flags.pattern) parts = {{DrivePattern(i)}};
    for (SyntheticPart& part : parts) {
        if (!shapedByItself(part.pattern)) part.duration = flags.duration.value_or(part.duration);
        part.trajectories = flags.trajectories.value_or(part.trajectories);
        part.repeats = flags.repeats.value_or(part.repeats);
    }
    return parts;
}

double secondsOf(const SyntheticPart& part) {
    const double each = part.duration < 0 ? patternDuration(part.pattern) : part.duration;
    return each * part.trajectories * part.repeats;
}

/// The folder, made; error where a file could not be written into it, or is there already.
Expected<MadeFolder> prepare(const std::filesystem::path& folder, const std::vector<SyntheticPart>& parts,
                             bool overwrite) {
    for (const SyntheticPart& part : parts)
        if (secondsOf(part) > longestLog)
            return fail({}, "more than 1,000,000 s of driving in one file", 0, "--trajectories");
    auto made = MadeFolder::make(folder);
    if (!made) return made;
    for (const SyntheticPart& part : parts) {
        const auto path = folder / (std::string(name(part.pattern)) + ".csv");
        if (const auto writable = checkWritable(path, overwrite); !writable) return tl::unexpected(writable.error());
    }
    return made;
}

/// All logs; fewer when it was interrupted.
std::vector<GeneratedFile> drive(const std::vector<SyntheticPart>& parts, const GenerateFlags& flags,
                                 const CommonFlags& common) {
    ProgressLine line(common.quiet);
    double seconds = 0, before = 0;
    for (const SyntheticPart& part : parts) seconds += secondsOf(part);
    int shown = line.terminal() ? -1 : 0;
    std::vector<GeneratedFile> files;
    for (const SyntheticPart& part : parts) {
        auto log = generateLog(part, common.seed, [&](double done) {
            const int percent = static_cast<int>(100 * (before + done * secondsOf(part)) / seconds);
            const bool worth = line.terminal() ? percent > shown : percent >= shown + 25 && percent < 100;
            if (worth) line.show("driving: " + std::to_string(shown = percent) + " %");
            return !wasInterrupted();
        });
        if (!log) break;
        before += secondsOf(part);
        files.push_back(
            {std::filesystem::path(flags.out) / (std::string(name(part.pattern)) + ".csv"), std::move(*log)});
    }
    return files;
}

void print(const std::vector<GeneratedFile>& files, const std::vector<SyntheticPart>& parts,
           const CommonFlags& common) {
    nlohmann::json json{{"synthetic", true}, {"seed", common.seed}, {"files", nlohmann::json::array()}};
    for (std::size_t i = 0; i < files.size(); ++i) {
        const std::string path = files[i].path.string();
        const std::size_t count = files[i].log.robots.front().trajectories.size();
        if (!common.json && !common.quiet)
            std::printf("%s: synthetic, %zu trajector%s, %.0f s\n", path.c_str(), count, count == 1 ? "y" : "ies",
                        secondsOf(parts[i]));
        json["files"].push_back({{"file", path},
                                 {"pattern", name(parts[i].pattern)},
                                 {"trajectories", count},
                                 {"repeats", parts[i].repeats},
                                 {"seconds", secondsOf(parts[i])}});
    }
    if (common.json) std::puts(json.dump(2).c_str());
}

int generate(const GenerateFlags& flags, const CommonFlags& common) {
    if (flags.set.empty() == flags.pattern.empty())
        return report({"", 0, 0, "--set, --pattern", "exactly one of them says what to drive"});
    const std::vector<SyntheticPart> parts = partsOf(flags);
    const auto folder = prepare(flags.out, parts, common.overwrite);
    if (!folder) return report(folder.error());
    watchInterrupts();
    const std::vector<GeneratedFile> files = drive(parts, flags, common);
    if (files.size() < parts.size()) return reportInterrupted();
    for (const GeneratedFile& file : files)
        if (const auto written = writeCsv(file.path, file.log); !written) return report(written.error());
    print(files, parts, common);
    return success;
}

std::vector<std::string> setNames() {
    std::vector<std::string> names;
    for (const SyntheticSet& set : syntheticSets()) names.emplace_back(set.name);
    return names;
}

std::vector<std::string> patternNames() {
    std::vector<std::string> names;
    for (int i = 0; i < patternCount; ++i) names.emplace_back(name(DrivePattern(i)));
    return names;
}

std::string setsText() {
    std::string text;
    for (const SyntheticSet& set : syntheticSets())
        text.append("  ").append(set.name).append(": ").append(set.purpose).append("\n");
    return text;
}

}  // namespace

Subcommand addGenerate(CLI::App& app, CommonFlags& common) {
    auto flags = std::make_shared<GenerateFlags>();
    CLI::App* sub = addSubcommand(
        app, common, "generate", "Write synthetic logs, driven by the reference robot (no real robot drove them)",
        "  mrose generate --set training -o training\n"
        "  mrose generate --set held-out --seed 2 -o held-out\n"
        "  mrose generate --pattern ellipse --repeats 10 -o ellipse\n"
        "Sets:\n" +
            setsText() +
            "The files are CSV logs, one for each drive pattern, and say that they are synthetic. "
            "The folder is made if need be.");
    addSeed(*sub, common);
    addOverwrite(*sub, common);
    sub->add_option("-o,--output", flags->out, "The folder to write to")->required()->check(someName());
    sub->add_option("--set", flags->set, "What to drive: " + CLI::detail::join(setNames(), ", "))
        ->check(CLI::IsMember(setNames()));
    sub->add_option("--pattern", flags->pattern, "One drive pattern only: " + CLI::detail::join(patternNames(), ", "))
        ->check(CLI::IsMember(patternNames()));
    sub->add_option("--trajectories", flags->trajectories, "Different trajectories in each file")
        ->check(CLI::Range(1, 100'000));
    sub->add_option("--duration", flags->duration,
                    "Length of a trajectory in s; the jink and the ellipse take as long as they take")
        ->check(numberRange(5.0, 36'000.0));
    sub->add_option("--repeats", flags->repeats, "Runs of each trajectory's commands")->check(CLI::Range(1, 1000));
    return {sub, [flags, &common] { return generate(*flags, common); }};
}

}  // namespace mrose::cli
