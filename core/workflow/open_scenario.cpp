#include "workflow/open_scenario.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "experiment/branching.h"
#include "experiment/trial.h"
#include "experiment/trial_run.h"
#include "io/file.h"
#include "io/format.h"
#include "io/shell_quoted.h"
#include "motion/learned_model.h"
#include "motion/noisy_model.h"
#include "scenario/start_check.h"
#include "scenario/state_scenario.h"
#include "scenario/variation.h"
#include "validation/validation_file.h"
#include "workflow/resources.h"
#include "world/seconds_text.h"

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

/// With what is set and overridden; plug-ins are loaded once, when it is.
Expected<LoadedScenario> loadOverridden(const ScenarioRequest& request, DescriptionSource& source,
                                        const PluginLoader& plugins) {
    if (request.overrides.empty() && request.settings.empty()) return loadScenario(request.file, source, {plugins});
    auto loaded = loadScenario(request.file, source);
    if (!loaded) return loaded;
    const auto overrides = readOverrides(request.settings, request.overrides, source);
    if (!overrides) return tl::unexpected(overrides.error());
    const auto value = withOverrides(std::move(loaded->value), *overrides, source);
    if (!value) return tl::unexpected(value.error());
    loaded = loadScenario(*value, source, {plugins});
    return loaded ? std::move(loaded) : tl::unexpected(soughtHere(loaded.error(), *overrides));
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
        return std::optional(OpenedExperiment{std::move(validation->experiment), std::move(validation->content), {}});
    }
    if (!isExperiment(file->content)) return std::optional<OpenedExperiment>();
    auto experiment = readExperiment(file, source);
    if (!experiment) return tl::unexpected(experiment.error());
    return std::optional(OpenedExperiment{std::move(*experiment), file->content, {}});
}

/// A variant that begins where its trial branched.
Expected<LoadedScenario> goingOnFrom(const BranchPoint& point, const LoadedScenario& variant,
                                     const PluginLoader& plugins) {
    const Scenario scenario(variant.parts);
    const auto value = withState(variant.value, scenario, branchedState(point, scenario, point.before.state.seed));
    if (!value) return tl::unexpected(value.error());
    return loadScenario(*value, ScenarioLoading{plugins});
}

/// A trial that does not branch, for as long as that is waited for.
Expected<LoadedScenario> withoutBranch(const Experiment& experiment, const ScenarioValue& before,
                                       const PluginLoader& plugins) {
    const auto value = before.with("duration_s", toSeconds(experiment.branchWithin));
    if (!value) return tl::unexpected(value.error());
    return loadScenario(*value, ScenarioLoading{plugins});
}

std::string noBranchText(const Experiment& experiment, std::uint32_t trial, const BranchPoint& point) {
    const std::string within = point.before.end == RunEnd::fault
                                   ? " does not branch: there is a fault before"
                                   : " does not branch within " + plainSeconds(experiment.branchWithin) + " s";
    return "trial " + std::to_string(trial) + within +
           "; until then it goes as the scenario is written, whatever its variant and seed";
}

/// As before the first trial of all: what one trial alone cannot answer, its run says as its row does.
Expected<void> checkFirst(const Experiment& experiment, TrialMaker& maker, std::uint32_t number,
                          const DrawnValues& drawn) {
    if (number == experiment.firstTrial) return maker.checkExpressions(number, drawn);
    const auto first = maker.make(experiment.firstTrial);
    return first ? maker.checkExpressions(experiment.firstTrial, first->drawn) : Expected<void>();
}

/// A trial of `opened.experiment`. What must be known of it is added to `notes`.
Expected<LoadedScenario> loadTrial(const ScenarioRequest& request, const ScenarioOverrides& overrides,
                                   const PluginLoader& plugins, OpenedTrial& opened, std::vector<std::string>& notes) {
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
    auto useless = checkOverrides(experiment, *variant, overrides);
    if (!useless) return tl::unexpected(useless.error());
    notes = std::move(*useless);
    TrialExpressions expressions(experiment);
    const std::uint32_t number = request.trial > 0 ? request.trial : experiment.firstTrial;
    TrialMaker maker(experiment, expressions, {plugins});
    auto trial = maker.make(number);
    if (!trial) return tl::unexpected(trial.error());
    if (const auto fit = checkFirst(experiment, maker, number, trial->drawn); !fit) return tl::unexpected(fit.error());
    LoadedScenario& loaded = trial->scenarios[static_cast<std::size_t>(variant - variants.begin())];
    if (trial->before) {
        if (request.plugins.loaded) request.plugins.loaded(trial->before->parts);
        auto point = runToBranch(experiment, expressions, std::move(trial->before->parts), trial->drawn);
        if (!point) return tl::unexpected(point.error());
        auto begun = point->isReached() ? goingOnFrom(*point, loaded, plugins)
                                        : withoutBranch(experiment, trial->before->value, plugins);
        if (!begun) return begun;
        loaded = std::move(*begun);
        if (point->isReached())
            trial->drawn = point->drawn;
        else
            notes.push_back(noBranchText(experiment, number, *point));
        opened.branch = std::make_shared<const BranchPoint>(std::move(*point));
    }
    opened.number = number;
    opened.variant = variant->name;
    opened.drawn = std::move(trial->drawn);
    loaded.parts.drawn = std::make_shared<const DrawnValues>(opened.drawn);
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
        auto given = readOverrides(settings, overrides, source);
        if (!given) return tl::unexpected(given.error());
        if (const auto used = checkOverrides(experiment, *given); !used) return tl::unexpected(used.error());
        auto value = withOverrides(std::move(experiment.scenario), *given, source);
        if (!value) return tl::unexpected(value.error());
        auto loaded = loadScenario(*value, source, {.checkStarts = false});
        if (!loaded) return tl::unexpected(soughtHere(loaded.error(), *given));
        experiment.scenario = std::move(loaded->value);
        (*opened)->overrides = std::move(*given);
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
    std::vector<std::string> notes;
    Expected<LoadedScenario> loaded;
    if (*experiment) {
        trial.emplace().experiment = std::make_shared<const Experiment>(std::move((*experiment)->experiment));
        loaded = loadTrial(request, (*experiment)->overrides, hashed, *trial, notes);
    } else if (!request.variant.empty()) {
        return fail(request.file, "is no experiment, and has no variant \"" + request.variant + '"');
    } else {
        loaded = loadOverridden(request, source, hashed);
    }
    if (!loaded) return tl::unexpected(loaded.error());
    if (request.plugins.loaded) request.plugins.loaded(loaded->parts);
    for (std::string& sentence : startsApartText(*loaded)) notes.push_back(std::move(sentence));
    if (!trial) loaded = varied(*loaded, request.trial);
    if (!loaded) return tl::unexpected(loaded.error());
    for (std::string& sentence : startsOutsideText(loaded->parts.scene)) notes.push_back(std::move(sentence));
    for (std::string& sentence : meanAloneText(loaded->parts.scene)) notes.push_back(std::move(sentence));
    auto scenario = std::make_shared<const Scenario>(loaded->parts);
    return OpenedScenario{std::move(*loaded), plugins.hashes(), std::move(scenario), std::move(notes),
                          std::move(trial)};
}

WorldState OpenedScenario::initialState(std::optional<std::uint64_t> seed) const {
    const bool unbranched = trial && trial->branch && !trial->branch->isReached();
    return seed && !unbranched ? scenario->initialState(*seed) : scenario->initialState();
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
