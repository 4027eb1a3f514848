#include "workflow/run_batch.h"

#include <filesystem>

#include "io/format.h"
#include "io/shell_quoted.h"
#include "io/value_bytes.h"
#include "recording/origin.h"
#include "workflow/run_scenario.h"
#include "workflow/version.h"
#include "world/seconds_text.h"

namespace mrose {
namespace {

/// What runs a trial alone but for its number and its seed.
std::string runCommand(const BatchRequest& request, Nanoseconds duration) {
    const ScenarioRequest& scenario = request.scenario;
    std::string command = "mrose run " + shellQuoted(scenario.file);
    if (!scenario.log.empty()) command += " --log " + shellQuoted(scenario.log);
    for (const std::string& file : scenario.settings) command += " --settings " + shellQuoted(file);
    for (const std::string& assignment : scenario.overrides) command += " --set " + shellQuoted(assignment);
    if (scenario.plugins.isolate) command += " --isolate";
    if (scenario.plugins.limit != PluginUse().limit) command += " --plugin-limit " + numberText(scenario.plugins.limit);
    command += " --duration " + plainSeconds(duration);
    if (!request.until.empty()) command += " --until " + shellQuoted(request.until);
    return command;
}

/// The same for a file from wherever it is named; of what ships and of parts of logs, the name.
std::string placeOf(const std::string& name) {
    std::error_code unknown;
    const std::filesystem::path place = std::filesystem::canonical(name, unknown);
    return unknown ? name : place.string();
}

/// What all rows depend on. How plug-ins are kept from doing harm is no part of it: a batch that one of them has ended
/// goes on with --isolate.
BatchIdentity identityOf(const OpenedScenario& opened, const BatchRequest& request, Nanoseconds duration) {
    BatchIdentity identity{{"mrose", std::string(MROSE_VERSION) + ' ' + thisOrigin().commit},
                           {"scenario", placeOf(opened.loaded.value.name())},
                           {"--duration", plainSeconds(duration)}};
    if (!request.until.empty()) identity["--until"] = request.until;
    if (!request.scenario.log.empty()) identity["--log"] = placeOf(request.scenario.log);
    const std::string content(contentOf);
    for (const Value::File& file : opened.loaded.value.files())
        identity[content + placeOf(file->name)] = hexadecimal(hashOf(file->content));
    for (const auto& [path, hash] : opened.plugins) identity[content + placeOf(path)] = hash;
    return identity;
}

}  // namespace

Expected<BatchSummary> runBatch(const BatchRequest& request, const BatchWatch& watch) {
    ScenarioRequest asWritten = request.scenario;
    asWritten.trial = 0;
    const auto opened = openScenario(asWritten);
    if (!opened) return tl::unexpected(opened.error());
    if (opened->trial)
        return fail(request.scenario.file, "describes an experiment; expected a scenario, or mrose experiment");
    if (watch.opened) watch.opened(*opened);
    if (const auto until = openCondition(request.until, *opened->scenario); !until)
        return tl::unexpected(until.error());
    const ScenarioParts& parts = opened->scenario->parts();
    const BatchRequest::Seeds seeds = request.seeds.value_or(BatchRequest::Seeds{parts.seed, parts.seed});
    BatchOptions options;
    options.trials = request.trials;
    options.firstSeed = seeds.first;
    options.lastSeed = seeds.last;
    options.duration = request.duration ? fromSeconds(*request.duration) : parts.duration;
    options.until = request.until;
    options.command = runCommand(request, options.duration);
    options.value = std::make_shared<const ScenarioValue>(opened->loaded.value);
    options.identity = identityOf(*opened, request, options.duration);
    options.begins = watch.runBegins;
    options.progress = watch.progress;
    options.goesOn = watch.goesOn;
    return runBatch(parts, options, request.folder);
}

}  // namespace mrose
