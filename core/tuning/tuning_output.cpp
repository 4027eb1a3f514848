#include "tuning/tuning_output.h"

#include <algorithm>

#include "io/format.h"
#include "io/toml_text.h"

namespace mrose {
namespace {

Value intervalValue(const MeanInterval& interval) {
    return Value::Table{{"mean", interval.mean}, {"low", interval.low}, {"high", interval.high}};
}

Value searchedValue(const TunedParameter& parameter, double after) {
    Value::Array paths(parameter.paths.begin(), parameter.paths.end());
    return Value::Table{{"name", parameter.name},
                        {"path", std::move(paths)},
                        {"from", parameterValue(parameter, parameter.from)},
                        {"to", parameterValue(parameter, parameter.to)},
                        {"scale", parameter.logarithmic ? "log" : "linear"},
                        {"before", parameterValue(parameter, parameter.start)},
                        {"after", parameterValue(parameter, after)}};
}

}  // namespace

TuningEvidence evidenceOf(const TunerResult& result) {
    return {meanInterval(result.before), meanInterval(result.after),
            meanInterval(differences(result.after, result.before))};
}

std::string settingsText(const Tuning& tuning, const TunerResult& result,
                         const std::vector<std::pair<std::string, std::string>>& made) {
    const std::vector<TunedParameter>& parameters = tuning.options.parameters;
    const std::vector<double>& values = result.candidates[result.best].values;
    Value::Table set = tunedSets(parameters, values);
    Value::Array searched;
    for (std::size_t i = 0; i < parameters.size(); ++i) searched.push_back(searchedValue(parameters[i], values[i]));
    const TuningEvidence found = evidenceOf(result);
    const auto dropped = std::ranges::count_if(result.candidates, &Candidate::dropped);
    const std::int64_t trials = tuning.options.trials;
    Value::Table evidence{{"tuning", tuning.called},
                          {"experiment", tuning.experimentCalled},
                          {"cost", tuning.costText},
                          {"before", intervalValue(found.before)},
                          {"after", intervalValue(found.after)},
                          {"change", intervalValue(found.change)},
                          {"held_out_from", trials + 1},
                          {"held_out_to", trials + tuning.options.heldOut},
                          {"trials", trials},
                          {"seeds", std::int64_t{tuning.experiment.seeds}},
                          {"trial_seed", static_cast<std::int64_t>(tuning.experiment.seed)},
                          {"search_seed", static_cast<std::int64_t>(tuning.options.seed)},
                          {"evaluations", result.evaluations},
                          {"candidates", std::ssize(result.candidates)},
                          {"dropped", static_cast<std::int64_t>(dropped)},
                          {"searched", std::move(searched)}};
    if (const std::string& variant = tuning.experiment.variants.front().name; !variant.empty())
        evidence.emplace("variant", variant);
    for (const auto& [key, text] : made) evidence.emplace(key, text);
    const Value::Table content{{"format", "mrose settings"},
                               {"version", 1},
                               {"name", tuning.name},
                               {"set", std::move(set)},
                               {"evidence", std::move(evidence)}};
    return tomlText(content,
                    "Found by mrose tune. The evidence is of trials in which nothing was searched: means over trials "
                    "with their 95 %\nintervals; the change is paired by trial.");
}

std::string candidatesText(const Tuning& tuning, const TunerResult& result) {
    std::string text = "candidate,";
    for (const TunedParameter& parameter : tuning.options.parameters) text += csvCell(parameter.name) + ',';
    text += "trials,cost,outcome,evaluations\n";
    for (std::size_t i = 0; i < result.candidates.size(); ++i) {
        const Candidate& candidate = result.candidates[i];
        text += std::to_string(i + 1) + ',';
        for (const double value : candidate.values) text += numberText(value) + ',';
        text += std::to_string(candidate.costs.size()) + ',' + numberText(candidate.cost) + ',' +
                (candidate.dropped ? "dropped"
                 : candidate.best  ? "best"
                                   : "complete") +
                ',' + std::to_string(candidate.evaluations) + '\n';
    }
    return text;
}

}  // namespace mrose
