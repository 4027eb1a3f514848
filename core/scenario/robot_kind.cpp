#include "scenario/robot_kind.h"

#include <algorithm>

#include "io/file.h"
#include "io/toml_text.h"
#include "logs/log_reader.h"
#include "scenario/description_reader.h"

namespace mrose {
namespace {

constexpr std::string_view syntheticLogs = "synthetic";

bool contains(const std::vector<std::string>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

RobotTraits readTraits(TomlTable table, std::string type) {
    RobotTraits traits;
    traits.type = std::move(type);
    if (table.has("wheel_phase")) {
        TomlTable phase = table.table("wheel_phase");
        traits.wheelPhase = {phase.number("half_track_m", {0.001, 10}), phase.number("quantum_mps", {1e-6, 10})};
        phase.rejectUnknown();
    }
    traits.turnOffset = table.numberOr("turn_offset_radps", 0, {-10, 10});
    traits.turnsOnTinyCommands = table.booleanOr("turns_on_tiny_commands", false);
    table.rejectUnknown();
    return traits;
}

/// Error: two kinds that cannot be told apart.
Expected<void> checkApart(const RobotKinds& kinds, const RobotKind& kind, const std::string& shown) {
    for (const RobotKind& other : kinds) {
        if (other.traits.type == kind.traits.type)
            return fail(shown, "\"" + kind.traits.type + "\" is the kind of " + other.file + " too", 0, "kind.name");
        for (const std::string& format : kind.logs)
            if (contains(other.logs, format))
                return fail(shown, "\"" + format + "\" are the logs of " + other.file + " too", 0, "kind.logs");
    }
    return {};
}

}  // namespace

RobotKind readRobotKind(TomlTable table, const std::string& file) {
    RobotKind kind;
    kind.file = file;
    const std::string type = name(table, "name");
    if (table.has("logs")) kind.logs = table.strings("logs");
    for (std::size_t i = 0; i < kind.logs.size(); ++i)
        if (kind.logs[i] != syntheticLogs &&
            std::find(logFormats.begin(), logFormats.end(), kind.logs[i]) == logFormats.end())
            table.rejectElement("logs", i,
                                "is \"" + kind.logs[i] +
                                    "\"; expected a format of logs (mrclam, husky-windows, csv) "
                                    "or synthetic");
    kind.environment = table.stringOr("environment", "");
    kind.robotName = nameOr(table, "robot_name", "robot");
    if (table.has("robots")) kind.robots = table.strings("robots");
    kind.traits = readTraits(table.tableOrEmpty("learning"), type);
    table.rejectUnknown();
    return kind;
}

Expected<std::optional<RobotKind>> parseRobotKind(std::string_view text, const std::string& file,
                                                  const std::string& shown) {
    const auto content = parseToml(text, shown);
    if (!content) return tl::unexpected(content.error());
    TomlTable root = openDescription(*content, shown, DescriptionKind::robot);
    std::optional<RobotKind> kind;
    if (!root.failed() && root.has("kind")) kind = readRobotKind(root.table("kind"), file);
    if (root.failed()) return tl::unexpected(root.error());
    return kind;
}

Expected<RobotKinds> readRobotKinds(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
        if (entry.path().extension() == ".toml") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    RobotKinds kinds;
    for (const std::filesystem::path& file : files) {
        const auto text = readFile(file);
        if (!text) return tl::unexpected(text.error());
        auto kind = parseRobotKind(*text, file.filename().string(), file.string());
        if (!kind) return tl::unexpected(kind.error());
        if (!*kind) continue;
        if (const auto apart = checkApart(kinds, **kind, file.string()); !apart) return tl::unexpected(apart.error());
        kinds.push_back(std::move(**kind));
    }
    return kinds;
}

const RobotKind* kindOfLog(const RobotKinds& kinds, const Log& log) {
    for (const std::string_view source : {std::string_view(log.format), log.synthetic ? syntheticLogs : ""})
        for (const RobotKind& kind : kinds)
            if (contains(kind.logs, source)) return &kind;
    return nullptr;
}

const RobotKind* kindNamed(const RobotKinds& kinds, std::string_view name) {
    const auto found =
        std::find_if(kinds.begin(), kinds.end(), [&](const RobotKind& kind) { return kind.traits.type == name; });
    return found == kinds.end() ? nullptr : &*found;
}

}  // namespace mrose
