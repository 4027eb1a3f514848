#include "workflow/open_scenario.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <set>

#include "experiment/branching.h"
#include "experiment/trial.h"
#include "experiment/trial_run.h"
#include "io/file.h"
#include "io/format.h"
#include "io/shell_quoted.h"
#include "motion/learned_model.h"
#include "motion/noisy_model.h"
#include "scenario/settings_file.h"
#include "scenario/start_check.h"
#include "scenario/state_scenario.h"
#include "scenario/variation.h"
#include "validation/validation_file.h"
#include "workflow/resources.h"

namespace mrose {
namespace {

/// Metres, to the millimetre.
std::string millimetresText(double metres) { return numberText(std::round(1000 * metres) / 1000); }

/// Of robots whose network was learned without its noise: a sentence for each type.
std::vector<std::string> meanAloneText(const Scene& scene) {
    std::vector<std::string> sentences;
    std::set<std::string> types;
    for (std::size_t i = 0; i < scene.robots.size(); ++i) {
        const LearnedModel* const learned = learnedModel(scene.modelOf(i));
        const bool noisy = !noiseOf(scene.modelOf(i)).none();
        if (learned == nullptr || learned->network().noise || noisy || !types.insert(scene.typeOf(i).name).second)
            continue;
        sentences.push_back("the network of robots of type \"" + scene.typeOf(i).name +
                            "\" knows its mean alone: they drive the same way every time, which real ones do not");
    }
    return sentences;
}

/// Of a scenario that goes on from a saved state: a sentence where a robot's start line is not where it stands in it.
std::vector<std::string> startsApartText(const LoadedScenario& loaded) {
    constexpr double apart = 0.0005, turned = 0.001;  // m, rad
    const ScenarioParts& parts = loaded.parts;
    if (parts.saved == nullptr || !parts.players.empty()) return {};
    const auto asWritten = loadScenario(loaded.value, {.playLogs = false});
    if (!asWritten) return {};
    std::string names;
    for (std::size_t i = 0; i < parts.scene.robots.size(); ++i) {
        const SceneRobot &robot = parts.scene.robots[i], &written = asWritten->parts.scene.robots[i];
        const bool same = distance(position(robot.start), position(written.start)) < apart &&
                          std::abs(wrapAngle(robot.start.heading - written.start.heading)) < turned;
        if (!same) names += (names.empty() ? "" : ", ") + robot.name;
    }
    if (names.empty()) return {};
    return {loaded.value.name() + ": the start lines of " + names +
            " are not where initial_state has them, which holds; without initial_state the run begins at the start "
            "lines"};
}

/// A file that is named by an override is seen from the current folder, otherwise as the scenario's own are.
Value seenFromHere(const ScenarioOverride& given) {
    constexpr std::array files{"network", "type", "environment", "shape", "initial_state", "log", "library"};
    const std::string key = given.path.substr(given.path.find_last_of('.') + 1);
    const std::string* const name = given.value.asText();
    std::error_code ignored;
    const bool here =
        name && std::filesystem::exists(*name, ignored) && std::find(files.begin(), files.end(), key) != files.end();
    return here ? Value(std::filesystem::absolute(*name, ignored).lexically_normal().string()) : given.value;
}

/// The scenario of a value with what is overridden; not yet read.
Expected<ScenarioValue> overridden(ScenarioValue value, const std::vector<std::string>& assignments) {
    for (const std::string& assignment : assignments) {
        const auto given = parseOverride(assignment);
        if (!given) return tl::unexpected(given.error());
        auto changed = value.with(given->path, seenFromHere(*given));
        if (!changed) return changed;
        value = std::move(*changed);
    }
    return value;
}

/// Whether each place of a path, or something that it lies in, is among others.
bool isWithin(const std::vector<std::string>& places, const std::vector<std::string>& others) {
    return std::ranges::all_of(places, [&](const std::string& place) {
        return std::ranges::any_of(others, [&](const std::string& other) {
            return place.starts_with(other) &&
                   (place.size() == other.size() || place[other.size()] == '.' || place[other.size()] == '[');
        });
    });
}

/// Error: an override is of something that every run has another value of.
Expected<void> checkOverrides(const Experiment& experiment, const std::vector<std::string>& assignments) {
    const auto placesOf = [&](const auto& paths, auto pathOf) {
        std::vector<std::string> all;
        for (const auto& path : paths)
            for (std::string& place : experiment.scenario.places(pathOf(path))) all.push_back(std::move(place));
        return all;
    };
    for (const std::string& assignment : assignments) {
        const auto given = parseOverride(assignment);
        if (!given) return tl::unexpected(given.error());
        const std::vector<std::string> places = experiment.scenario.places(given->path);
        if (places.empty()) continue;
        const std::string useless = "has no effect: ", key = "--set " + given->path;
        if (given->path == "seed") return fail("", useless + "each run has a seed of its own", 0, key);
        for (const Draw& draw : experiment.draws)
            if (isWithin(places, placesOf(draw.paths, std::identity())))
                return fail("", useless + "draw \"" + draw.name + "\" sets it in each trial", 0, key);
        if (std::ranges::all_of(experiment.variants, [&](const Variant& variant) {
                return isWithin(places, placesOf(variant.set, [](const auto& set) { return set.first; }));
            }))
            return fail("", useless + (experiment.variants.size() > 1 ? "each variant sets it" : "its variant sets it"),
                        0, key);
    }
    return {};
}

/// With the values of settings files, each seen to fit.
Expected<ScenarioValue> withSettings(ScenarioValue value, const std::vector<std::string>& files,
                                     DescriptionSource& source) {
    constexpr std::string_view folders[] = {"resources/experiments"};
    DescriptionLibrary library(source);
    for (const std::string& name : files) {
        const auto file = library.file(name, folders);
        if (!file) return tl::unexpected(file.error());
        const auto settings = readSettings((*file)->content, library.shown((*file)->name));
        if (!settings) return tl::unexpected(settings.error());
        auto with = settings->putInto(value);
        if (!with) return with;
        const auto loaded = loadScenario(*with, library, {.checkStarts = false});
        if (!loaded) return tl::unexpected(settings->placed(loaded.error(), *with));
        value = loaded->value;
    }
    return value;
}

/// With what is set and overridden; plug-ins are loaded once, when it is.
Expected<LoadedScenario> loadOverridden(const ScenarioRequest& request, DescriptionSource& source,
                                        const PluginLoader& plugins) {
    if (request.overrides.empty() && request.settings.empty()) return loadScenario(request.file, source, {plugins});
    auto loaded = loadScenario(request.file, source);
    if (!loaded) return loaded;
    const auto set = withSettings(std::move(loaded->value), request.settings, source);
    if (!set) return tl::unexpected(set.error());
    const auto value = overridden(*set, request.overrides);
    if (!value) return tl::unexpected(value.error());
    return loadScenario(*value, source, {plugins});
}

/// Reads each text once: what comes through a pipe is gone then.
class ReadOnce final : public DescriptionSource {
public:
    explicit ReadOnce(DescriptionSource& from) : from_(from) {}

    Expected<std::optional<std::string>> text(const std::string& name) override {
        const auto found = texts_.find(name);
        if (found != texts_.end()) return found->second;
        return texts_.emplace(name, from_.text(name)).first->second;
    }
    Expected<std::optional<ExcerptContent>> excerpt(const LogExcerpt& excerpt) override {
        return from_.excerpt(excerpt);
    }
    std::string shown(const std::string& name) const override { return from_.shown(name); }

private:
    DescriptionSource& from_;
    std::map<std::string, Expected<std::optional<std::string>>> texts_;
};

/// Of a file that describes an experiment, or a validation, which is one.
Expected<std::optional<OpenedExperiment>> experimentOf(const Value::File& file, DescriptionSource& source) {
    if (isValidation(file->content)) {
        auto validation = readValidation(file, source);
        if (!validation) return tl::unexpected(validation.error());
        return std::optional(OpenedExperiment{std::move(validation->experiment), std::move(validation->content)});
    }
    if (!isExperiment(file->content)) return std::optional<OpenedExperiment>();
    auto experiment = readExperiment(file, source);
    if (!experiment) return tl::unexpected(experiment.error());
    return std::optional(OpenedExperiment{std::move(*experiment), file->content});
}

/// A variant that begins where its trial branched.
Expected<LoadedScenario> goingOnFrom(const BranchPoint& point, const LoadedScenario& variant,
                                     const PluginLoader& plugins) {
    if (!point.isReached())
        return fail("", point.before.end == RunEnd::fault
                            ? "before it branched, there was a fault: " + point.before.statistics.firstFault
                            : "it does not come to hold");
    const Scenario scenario(variant.parts);
    const auto value = withState(variant.value, scenario, branchedState(point, scenario, point.before.state.seed));
    if (!value) return tl::unexpected(value.error());
    return loadScenario(*value, ScenarioLoading{plugins});
}

/// A trial of `opened.experiment`.
Expected<LoadedScenario> loadTrial(const ScenarioRequest& request, const PluginLoader& plugins, OpenedTrial& opened) {
    const Experiment& experiment = *opened.experiment;
    const auto isAsked = [&](const Variant& variant) { return variant.name == request.variant; };
    const auto& variants = experiment.variants;
    const auto variant =
        request.variant.empty() ? variants.begin() : std::find_if(variants.begin(), variants.end(), isAsked);
    if (variant == variants.end()) {
        std::string names;
        for (const Variant& one : variants)
            if (!one.name.empty()) names += (names.empty() ? "one of " : ", ") + shellQuoted(one.name);
        return fail(experiment.file, "has no variant " + shellQuoted(request.variant) + "; expected " +
                                         (names.empty() ? "none, it has no variants" : names));
    }
    TrialExpressions expressions(experiment);
    const std::uint32_t number = request.trial > 0 ? request.trial : experiment.firstTrial;
    TrialMaker maker(experiment, expressions, {plugins});
    auto trial = maker.make(number);
    if (!trial) return tl::unexpected(trial.error());
    if (const auto fit = maker.checkExpressions(number, trial->drawn); !fit) return tl::unexpected(fit.error());
    LoadedScenario& loaded = trial->scenarios[static_cast<std::size_t>(variant - variants.begin())];
    if (trial->before) {
        if (request.plugins.loaded) request.plugins.loaded(trial->before->parts);
        auto point = runToBranch(experiment, expressions, std::move(trial->before->parts), trial->drawn);
        if (!point) return tl::unexpected(point.error());
        auto begun = goingOnFrom(*point, loaded, plugins);
        if (!begun)
            return tl::unexpected(experiment.branch.placed(
                begun.error().cause + " (trial " + std::to_string(number) + ')', experiment.file));
        loaded = std::move(*begun);
        trial->drawn = point->drawn;
        opened.branch = std::make_shared<const BranchPoint>(std::move(*point));
    }
    opened.number = number;
    opened.variant = variant->name;
    opened.drawn = std::move(trial->drawn);
    return std::move(loaded);
}

}  // namespace

Expected<std::optional<OpenedExperiment>> openExperiment(const std::string& file,
                                                         const std::vector<std::string>& overrides,
                                                         DescriptionSource& source,
                                                         const std::vector<std::string>& settings) {
    constexpr std::string_view folders[] = {"resources/experiments", "resources/scenarios"};
    const auto found = DescriptionLibrary(source).file(file, folders);
    if (!found) return std::optional<OpenedExperiment>();
    auto opened = experimentOf(*found, source);
    if (!opened) return tl::unexpected(opened.error());
    if (*opened && (!overrides.empty() || !settings.empty())) {
        Experiment& experiment = (*opened)->experiment;
        if (const auto used = checkOverrides(experiment, overrides); !used) return tl::unexpected(used.error());
        auto set = withSettings(std::move(experiment.scenario), settings, source);
        if (!set) return tl::unexpected(set.error());
        auto value = overridden(std::move(*set), overrides);
        if (!value) return tl::unexpected(value.error());
        auto loaded = loadScenario(*value, source, {.checkStarts = false});
        if (!loaded) return tl::unexpected(loaded.error());
        experiment.scenario = std::move(loaded->value);
    }
    return opened;
}

Expected<OpenedScenario> openScenario(const ScenarioRequest& request) {
    DiskDescriptions source = openDescriptions(request.log);
    return openScenario(request, source);
}

Expected<OpenedScenario> openScenario(const ScenarioRequest& request, DescriptionSource& from) {
    ReadOnce source(from);
    HashingLoader plugins(request.plugins);
    const PluginLoader hashed = plugins.loader();
    auto experiment = openExperiment(request.file, request.overrides, source, request.settings);
    if (!experiment) return tl::unexpected(experiment.error());
    std::optional<OpenedTrial> trial;
    Expected<LoadedScenario> loaded;
    if (*experiment) {
        trial.emplace().experiment = std::make_shared<const Experiment>(std::move((*experiment)->experiment));
        loaded = loadTrial(request, hashed, *trial);
    } else if (!request.variant.empty()) {
        return fail(request.file, "is no experiment, and has no variant \"" + request.variant + '"');
    } else {
        loaded = loadOverridden(request, source, hashed);
    }
    if (!loaded) return tl::unexpected(loaded.error());
    if (request.plugins.loaded) request.plugins.loaded(loaded->parts);
    std::vector<std::string> notes = startsApartText(*loaded);
    if (!trial) loaded = varied(*loaded, request.trial);
    if (!loaded) return tl::unexpected(loaded.error());
    for (std::string& sentence : startsOutsideText(loaded->parts.scene)) notes.push_back(std::move(sentence));
    for (std::string& sentence : meanAloneText(loaded->parts.scene)) notes.push_back(std::move(sentence));
    auto scenario = std::make_shared<const Scenario>(loaded->parts);
    return OpenedScenario{std::move(*loaded), plugins.hashes(), std::move(scenario), std::move(notes),
                          std::move(trial)};
}

std::vector<std::string> startsOutsideText(const Scene& scene) {
    constexpr std::size_t most = 10;
    const std::vector<std::size_t> outside = startsOutside(scene);
    std::vector<std::string> sentences;
    for (std::size_t i = 0; i < std::min(outside.size(), most); ++i) {
        const std::size_t body = outside[i];
        const bool robot = body < scene.robots.size();
        const std::size_t object = body - scene.robots.size();
        const Pose& start = robot ? scene.robots[body].start : scene.objects[object].start;
        const std::string name = robot ? scene.robots[body].name : scene.objects[object].name;
        sentences.push_back('"' + name + "\" starts at (" + millimetresText(start.x) + ", " + millimetresText(start.y) +
                            "), outside of what the environment's walls and floor area span");
    }
    if (outside.size() > most) sentences.push_back("so do " + std::to_string(outside.size() - most) + " more");
    return sentences;
}

}  // namespace mrose
