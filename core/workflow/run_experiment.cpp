#include "workflow/run_experiment.h"

#include <memory>

#include "experiment/trial.h"
#include "io/file.h"
#include "io/format.h"
#include "io/shell_quoted.h"
#include "io/value_bytes.h"
#include "recording/origin.h"
#include "report/experiment_report.h"
#include "scenario/description_library.h"
#include "workflow/open_scenario.h"
#include "workflow/resources.h"
#include "workflow/version.h"

namespace mrose {
namespace {

/// What was put into the scenario, as far as a variant leaves it so: the rest is refused beside that.
std::string overrideFlags(const ExperimentRequest& request, const OpenedExperiment& opened, const Variant& variant) {
    std::string flags;
    for (std::size_t i = 0; i < request.settings.size(); ++i)
        if (hasEffect(opened.overrides.settings[i], opened.experiment, variant))
            flags += " --settings " + shellQuoted(request.settings[i]);
    for (const std::string& assignment : request.overrides)
        if (hasEffect(assignment, opened.experiment, variant)) flags += " --set " + shellQuoted(assignment);
    return flags;
}

/// The window isolates plug-ins without being told.
std::string pluginFlags(const PluginUse& plugins) {
    std::string flags = plugins.isolate ? " --isolate" : "";
    if (plugins.limit != PluginUse().limit) flags += " --plugin-limit " + numberText(plugins.limit);
    return flags;
}

/// What all rows depend on. Which trials there are is no part of it: more of them may be added.
BatchIdentity identityOf(const Value& content, const Experiment& experiment, const ExperimentRequest& request) {
    BatchIdentity identity{{"mrose", std::string(MROSE_VERSION) + ' ' + thisOrigin().commit}};
    for (const std::string& assignment : request.overrides) identity["--set " + assignment] = "given";
    identity["experiment"] = experiment.name;
    const std::string of(contentOf);
    identity[of + "the experiment"] = hexadecimal(hashOf(content.without("first_trial").without("trials")));
    for (const Value::File& file : experiment.scenario.files())
        identity[of + file->name] = hexadecimal(hashOf(file->content));
    for (const Value::File& file : experiment.settings) identity[of + file->name] = hexadecimal(hashOf(file->content));
    return identity;
}

}  // namespace

Expected<ExperimentSummary> runExperiment(const ExperimentRequest& request, const ExperimentWatch& watch) {
    DiskDescriptions source = openDescriptions();
    auto opened = openExperiment(request.file, request.overrides, source, request.settings);
    if (!opened) return tl::unexpected(opened.error());
    if (!*opened) {
        // Why it is none, its reader says; what was read once may be there no more.
        constexpr std::string_view folders[] = {"resources/experiments"};
        const auto file = DescriptionLibrary(source).file(request.file, folders);
        if (!file) return tl::unexpected(file.error());
        const auto wrong = readExperiment(*file, source);
        return wrong ? fail(request.file, "is no experiment") : tl::unexpected(wrong.error());
    }
    Experiment& experiment = (*opened)->experiment;
    if (request.trials) experiment.trials = *request.trials;
    if (watch.opened) watch.opened(experiment);
    ExperimentOptions options;
    // What is in their files is part of what the rows depend on: the first trial loads them.
    HashingLoader plugins(request.plugins);
    options.loading.plugins = plugins.loader();
    options.loaded = request.plugins.loaded;
    {
        TrialExpressions expressions(experiment);
        if (const auto first = TrialMaker(experiment, expressions, options.loading).make(experiment.firstTrial); !first)
            return tl::unexpected(first.error());
    }
    options.command = "mrose run " + shellQuoted(request.file) + pluginFlags(request.plugins);
    options.window = "mrose-gui " + shellQuoted(request.file);
    options.flags = [&](const Variant& variant) { return overrideFlags(request, **opened, variant); };
    options.identity = identityOf((*opened)->content, experiment, request);
    for (const auto& [path, hash] : plugins.hashes()) options.identity[std::string(contentOf) + path] = hash;
    options.begins = watch.runBegins;
    options.progress = watch.progress;
    options.goesOn = watch.goesOn;
    options.fits = watch.fits;
    auto summary = runExperiment(experiment, options, request.folder);
    if (!summary || !summary->complete) return summary;
    ReportContext context;
    context.program = std::string("mrose ") + MROSE_VERSION;
    context.commandLine = request.command;
    const NamedFile page[] = {
        {std::filesystem::path(request.folder) / "report.html", experimentReport(experiment, *summary, context)}};
    if (const auto written = writeFilesAtomically(page); !written) return tl::unexpected(written.error());
    return summary;
}

}  // namespace mrose
