#include "scenarios.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>

#include "io/file.h"
#include "scenario/variation.h"
#include "workflow/opening.h"
#include "workflow/resources.h"

namespace mrose::cli {

namespace {

/// A file that is named on the command line is seen from the current folder, otherwise as the scenario's own are.
Value seenFromHere(const ScenarioOverride& given) {
    constexpr std::array files{"network", "type", "environment", "shape", "initial_state", "log", "library"};
    const std::string key = given.path.substr(given.path.find_last_of('.') + 1);
    const std::string* const name = given.value.asText();
    std::error_code ignored;
    const bool here =
        name && std::filesystem::exists(*name, ignored) && std::find(files.begin(), files.end(), key) != files.end();
    return here ? Value(std::filesystem::absolute(*name, ignored).lexically_normal().string()) : given.value;
}

/// With what is overridden; plug-ins are loaded once, when it is.
Expected<LoadedScenario> loadOverridden(const RunFlags& flags, const PluginLoader& plugins) {
    DiskDescriptions source = openDescriptions(flags.log);
    if (flags.overrides.empty()) return loadScenario(flags.scenario, source, {plugins});
    auto loaded = loadScenario(flags.scenario, source);
    if (!loaded) return loaded;
    for (const std::string& assignment : flags.overrides) {
        const auto given = parseOverride(assignment);
        if (!given) return tl::unexpected(given.error());
        auto changed = loaded->value.with(given->path, seenFromHere(*given));
        if (!changed) return tl::unexpected(changed.error());
        loaded->value = std::move(*changed);
    }
    return loadScenario(loaded->value, source, {plugins});
}

}  // namespace

Expected<OpenScenario> openScenario(const RunFlags& flags, std::uint32_t trial) {
    std::map<std::string, std::string> hashes;
    const PluginLoader load = pluginLoader(flags.plugins);
    const auto loadAndHash = [&](const std::string& path, const std::string& options) {
        if (const auto content = readFile(path)) hashes[path] = contentHash(*content);
        return load(path, options);
    };
    auto loaded = loadOverridden(flags, loadAndHash);
    if (!loaded) return tl::unexpected(loaded.error());
    watchPlugins(loaded->parts);
    for (const std::string& sentence : startsApartText(*loaded)) report({"", 0, 0, "note", sentence});
    loaded = varied(*loaded, trial);
    if (!loaded) return tl::unexpected(loaded.error());
    sayStartsOutside(loaded->parts.scene);
    auto scenario = std::make_shared<const Scenario>(loaded->parts);
    return OpenScenario{std::move(*loaded), std::move(hashes), std::move(scenario)};
}

void sayStartsOutside(const Scene& scene) {
    for (const std::string& sentence : startsOutsideText(scene)) report({"", 0, 0, "note", sentence});
}

void addRunFlags(CLI::App& sub, RunFlags& flags) {
    sub.add_option("SCENARIO", flags.scenario, "Scenario file, or the name of one that ships: soccer.toml")->required();
    sub.get_option("--seed")->default_str("the scenario's");
    sub.add_option("--duration", flags.duration, "How long to simulate, in s; otherwise what the scenario says")
        ->check(numberRange(0.001, 1e7));
    sub.add_option("--until", flags.until, "Ends a run when this Lua expression over the state holds")
        ->check(
            [](const std::string& text) { return text.empty() ? std::string("is empty; expected a condition") : ""; });
    sub.add_option("--set", flags.overrides,
                   "Overrides something in the scenario: PATH=VALUE, such as robot[2].network=create.net")
        ->type_name("PATH=VALUE")
        ->allow_extra_args(false);
    sub.add_option("--log", flags.log, "Read this log instead of those that the scenario names");
    addPluginFlags(sub, flags.plugins);
}

Expected<std::optional<Condition>> openCondition(const std::string& text, const Scenario& scenario) {
    if (text.empty()) return std::optional<Condition>{};
    auto compiled = compileCondition(text, scenario, "--until");
    if (!compiled) return tl::unexpected(compiled.error());
    return std::optional<Condition>(std::move(*compiled));
}

std::string statisticsText(const Scenario& scenario, const RunStatistics& statistics) {
    const Scene& scene = scenario.scene();
    std::string text;
    char line[200];
    for (std::size_t g = 0; g < statistics.goals.size(); ++g)
        text += (g == 0 ? "goals: " : ", ") + std::to_string(statistics.goals[g]) + " in " +
                scene.environment.goals[g].name;
    if (!text.empty()) text += '\n';
    text += "touches: " + std::to_string(statistics.touches);
    const bool kickers = std::any_of(scene.robots.begin(), scene.robots.end(), [&](const SceneRobot& robot) {
        return !scene.robotTypes[robot.type].manipulators.empty();
    });
    if (kickers)
        text += "; kicks: " + std::to_string(statistics.kicks) + ", " + std::to_string(statistics.hits) +
                " of them on a ball";
    text += '\n';
    TextTable table({"", "driven, m"});
    for (std::size_t i = 0; i < statistics.driven.size(); ++i) {
        std::snprintf(line, sizeof line, "%.2f", statistics.driven[i]);
        table.add({bodyName(scene, i), line});
    }
    text += table.text();
    if (statistics.faults > 0) {
        std::snprintf(line, sizeof line, "faults: %lld, the first of ", static_cast<long long>(statistics.faults));
        text += line + statistics.firstFault + '\n';
    }
    return text;
}

nlohmann::json statisticsJson(const Scenario& scenario, const RunStatistics& statistics) {
    nlohmann::json json{{"touches", statistics.touches},
                        {"kicks", statistics.kicks},
                        {"hits", statistics.hits},
                        {"faults", statistics.faults},
                        {"first_fault", statistics.firstFault}};
    for (std::size_t g = 0; g < statistics.goals.size(); ++g)
        json["goals"][scenario.scene().environment.goals[g].name] = statistics.goals[g];
    for (std::size_t i = 0; i < statistics.driven.size(); ++i)
        json["driven_m"][scenario.scene().robots[i].name] = statistics.driven[i];
    return json;
}

std::string hexadecimal(std::uint64_t value) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
    return text;
}

}  // namespace mrose::cli
