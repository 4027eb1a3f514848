#include "workflow/overrides.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "scenario/description_library.h"
#include "scenario/scenario_file.h"

namespace mrose {
namespace {

std::string placeHere(const std::string& name) {
    std::error_code ignored;
    return std::filesystem::absolute(name, ignored).lexically_normal().string();
}

/// What an override calls a file; nullptr: it names none.
const std::string* fileNamedBy(const ScenarioOverride& given) {
    constexpr std::array files{"network", "type", "environment", "shape", "initial_state", "log", "library"};
    const std::string key = given.path.substr(given.path.find_last_of('.') + 1);
    return std::ranges::find(files, key) != files.end() ? given.value.asText() : nullptr;
}

/// Such a file is seen from the current folder, otherwise as the scenario's own are.
Value seenFromHere(const ScenarioOverride& given) {
    const std::string* const name = fileNamedBy(given);
    std::error_code ignored;
    return name != nullptr && std::filesystem::exists(*name, ignored) ? Value(placeHere(*name)) : given.value;
}

bool isSetBy(const Variant& variant, const Experiment& experiment, const std::string& path) {
    // Until it branches, a trial goes as the scenario is written.
    if (!experiment.branch.empty()) return false;
    std::vector<std::string> set;
    for (const auto& [own, value] : variant.set)
        for (std::string& place : experiment.scenario.places(own)) set.push_back(std::move(place));
    return areWithin(experiment.scenario.places(path), set);
}

/// Why a value at a path would be another one in every run; "" where it would not.
std::string uselessIn(const Experiment& experiment, const std::string& path) {
    const std::string useless = "has no effect: ";
    if (path == "seed") return useless + "each run has a seed of its own";
    const std::vector<std::string> places = experiment.scenario.places(path);
    std::vector<std::string> all;
    for (const Draw& draw : experiment.draws) {
        std::vector<std::string> drawn;
        for (const std::string& own : draw.paths)
            for (std::string& place : experiment.scenario.places(own)) drawn.push_back(std::move(place));
        if (areWithin(places, drawn)) return useless + "draw \"" + draw.name + "\" sets it in each trial";
        all.insert(all.end(), drawn.begin(), drawn.end());
    }
    if (areWithin(places, all)) return useless + "draws set each of its elements in each trial";
    const std::vector<Variant>& variants = experiment.variants;
    if (std::ranges::all_of(variants, [&](const Variant& one) { return isSetBy(one, experiment, path); }))
        return useless + (variants.size() > 1 ? "each variant sets it" : "its variant sets it");
    return "";
}

}  // namespace

Expected<ScenarioOverrides> readOverrides(const std::vector<std::string>& settings,
                                          const std::vector<std::string>& assignments, DescriptionSource& source) {
    constexpr std::string_view folders[] = {"resources/experiments"};
    DescriptionLibrary library(source);
    ScenarioOverrides overrides{{}, assignments};
    for (const std::string& name : settings) {
        const auto file = library.file(name, folders);
        if (!file) return tl::unexpected(file.error());
        auto read = readSettings((*file)->content, library.shown((*file)->name));
        if (!read) return tl::unexpected(read.error());
        overrides.settings.push_back(std::move(*read));
    }
    return overrides;
}

Expected<ScenarioValue> withOverrides(ScenarioValue value, const ScenarioOverrides& overrides,
                                      DescriptionSource& source) {
    DescriptionLibrary library(source);
    for (const Settings& settings : overrides.settings) {
        auto with = settings.putInto(value);
        if (!with) return with;
        const auto loaded = loadScenario(*with, library, {.checkStarts = false});
        if (!loaded) return tl::unexpected(settings.placed(loaded.error(), *with));
        value = loaded->value;
    }
    for (const std::string& assignment : overrides.assignments) {
        const auto given = parseOverride(assignment);
        if (!given) return tl::unexpected(given.error());
        auto changed = value.with(given->path, seenFromHere(*given));
        if (!changed) return changed;
        value = std::move(*changed);
    }
    return value;
}

Error soughtHere(Error error, const ScenarioOverrides& overrides) {
    for (const std::string& assignment : overrides.assignments) {
        const auto given = parseOverride(assignment);
        const std::string* const name = given ? fileNamedBy(*given) : nullptr;
        if (name == nullptr || std::filesystem::path(*name).is_absolute()) continue;
        const std::string missing = '"' + *name + "\" was not found; expected ", here = placeHere(*name);
        if (error.cause.starts_with(missing) && error.cause.find(here, missing.size()) == std::string::npos)
            error.cause.insert(missing.size(), here + ", ");
    }
    return error;
}

Expected<void> checkOverrides(const Experiment& experiment, const ScenarioOverrides& overrides) {
    for (const Settings& settings : overrides.settings)
        for (const auto& [path, value] : settings.set)
            if (std::string cause = uselessIn(experiment, path); !cause.empty())
                return tl::unexpected(settings.about(path, value, std::move(cause)));
    for (const std::string& assignment : overrides.assignments) {
        const auto given = parseOverride(assignment);
        if (!given) return tl::unexpected(given.error());
        if (std::string cause = uselessIn(experiment, given->path); !cause.empty())
            return fail("", std::move(cause), 0, "--set " + given->path);
    }
    return {};
}

bool hasEffect(const Settings& settings, const Experiment& experiment, const Variant& variant) {
    return std::ranges::any_of(settings.set, [&](const auto& one) { return !isSetBy(variant, experiment, one.first); });
}

bool hasEffect(const std::string& assignment, const Experiment& experiment, const Variant& variant) {
    const auto given = parseOverride(assignment);
    return !given || !isSetBy(variant, experiment, given->path);
}

Expected<std::vector<std::string>> checkOverrides(const Experiment& experiment, const Variant& variant,
                                                  const ScenarioOverrides& overrides) {
    const std::string useless = "has no effect: variant \"" + variant.name + "\" sets ";
    std::vector<std::string> notes;
    for (const Settings& settings : overrides.settings) {
        if (!hasEffect(settings, experiment, variant)) return fail(settings.file, useless + "all that it does");
        for (const auto& [path, value] : settings.set)
            if (isSetBy(variant, experiment, path))
                notes.push_back(settings.about(path, value, useless + "it").message());
    }
    for (const std::string& assignment : overrides.assignments)
        if (!hasEffect(assignment, experiment, variant))
            return fail("", useless + "it", 0, "--set " + parseOverride(assignment)->path);
    return notes;
}

}  // namespace mrose
