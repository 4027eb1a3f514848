#include "experiment/experiment_row.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "experiment/possible_values.h"
#include "experiment/results_row.h"
#include "experiment/trial.h"
#include "io/format.h"
#include "world/seconds_text.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

constexpr std::size_t experimentEndCell = 4, firstDrawCell = 6, faultBehind = 3;  // the last, the measures

/// Of tables and arrays, which of the draw's choices it is, from 1.
std::string drawnText(const Value& value, const Draw& draw) {
    if (const double* const number = value.asFloat()) return numberText(*number);
    if (const std::int64_t* const whole = value.asInteger()) return std::to_string(*whole);
    if (const bool* const truth = value.asBoolean()) return *truth ? "true" : "false";
    if (const std::string* const text = value.asText()) return csvCell(*text);
    if (const DescriptionFile* const file = value.asFile()) return csvCell(file->reference);
    return std::to_string(std::ranges::find(draw.choices, value) - draw.choices.begin() + 1);
}

/// NaN has no sign worth a reader's time.
std::string measuredText(double value) { return std::isnan(value) ? "nan" : numberText(value); }

void add(MeasureSummary& summary, double value) {
    if (!std::isfinite(value)) return;
    summary.share = (value == 0 || value == 1) && (summary.share || summary.count == 0);
    ++summary.count;
    summary.least = summary.count == 1 ? value : std::min(summary.least, value);
    summary.most = summary.count == 1 ? value : std::max(summary.most, value);
    const double off = value - summary.mean;
    summary.mean += off / static_cast<double>(summary.count);
    summary.deviation += off * (value - summary.mean);  // a sum of squares until all are added
}

/// What a measure came to in the runs of a trial.
struct TrialSum {
    std::uint32_t trial = 0;
    double sum = 0;
    double count = 0;
};

/// Of a mean over runs, with runs of a trial as one: how far its sum is from what so many runs have on average.
Estimate estimateOf(const MeasureSummary& summary, const std::vector<TrialSum>& trials) {
    const auto runs = static_cast<double>(summary.count);
    std::vector<double> off, means;
    for (const TrialSum& trial : trials) {
        off.push_back(static_cast<double>(trials.size()) * (trial.sum - trial.count * summary.mean) / runs);
        means.push_back(trial.sum / trial.count);
    }
    if (summary.share) return wilsonShare(summary.mean, effectiveCount(means, runs));
    const Estimate around = meanOf(off);  // 0
    return {summary.mean, summary.mean + around.low, summary.mean + around.high};
}

bool hasSweeps(const Experiment& experiment) {
    return std::ranges::any_of(experiment.variants, [](const Variant& one) { return one.sweep.has_value(); });
}
std::string sweptText(const Variant& variant) { return variant.sweep ? plainNumberText(variant.sweep->at) : ""; }

/// All of a row before what was drawn.
std::string rowStart(const Experiment& experiment, const RunKey& key, RunEnd end, const std::string& time) {
    return std::to_string(key.trial) + ',' + std::to_string(key.seed) + ',' + std::to_string(key.variant) + ',' +
           csvCell(experiment.variants[key.variant - 1].name) + ',' + name(end) + ',' + time;
}
/// All of it behind the hash.
std::string rowEnd(const Experiment& experiment, const RunKey& key, const std::string& time, std::string fault,
                   const RunCommands& commands) {
    std::ranges::replace(fault, '\n', ' ');  // a row is a line
    return ',' + csvCell(commands.alone) + ',' + csvCell(commands.window + " --at " + time) + ',' + csvCell(fault) +
           (hasSweeps(experiment) ? ',' + sweptText(experiment.variants[key.variant - 1]) : "");
}

}  // namespace

std::string experimentHeader(const Experiment& experiment) {
    std::string line = "trial,seed,variant,variant_name,end,time_s";
    for (const Draw& draw : experiment.draws) line += ",draw." + draw.name;
    for (const Feature& feature : experiment.features) line += ",feature." + feature.name;
    for (const Measure& measure : experiment.measures) line += ",measure." + measure.name;
    return line + ",world_hash,command,window,fault" + (hasSweeps(experiment) ? ",swept" : "");
}

std::string experimentRow(const Experiment& experiment, const RunKey& key, const DrawnValues& drawn,
                          const TrialMeasurement& measurement, const RunResult& result, Nanoseconds tick,
                          const RunCommands& commands) {
    const std::string time = plainSeconds(result.state.tick * tick);
    std::string line = rowStart(experiment, key, result.end, time);
    for (std::size_t i = 0; i < experiment.draws.size(); ++i)
        line += ',' + drawnText(drawn[i].value, experiment.draws[i]);
    for (const double feature : measurement.features()) line += ',' + measuredText(feature);
    for (const double measure : measurement.measures()) line += ',' + measuredText(measure);
    line += ',' + hexadecimal(hashOf(result.state).world);
    return line + rowEnd(experiment, key, time, result.statistics.firstFault, commands);
}

std::string faultyRow(const Experiment& experiment, const RunKey& key, const Error& error,
                      const RunCommands& commands) {
    std::string line = rowStart(experiment, key, RunEnd::fault, "0") + std::string(experiment.draws.size(), ',');
    for (std::size_t i = 0; i < experiment.features.size() + experiment.measures.size(); ++i) line += ",nan";
    return line + ',' + rowEnd(experiment, key, "0", error.message(), commands);
}

RowOutcome rowOutcome(const Experiment& experiment, const std::string& row) {
    const std::vector<std::string> cells = resultsCells(row);
    const std::size_t first = firstDrawCell + experiment.draws.size() + experiment.features.size();
    RowOutcome outcome{cells.size() > experimentEndCell && cells[experimentEndCell] == name(RunEnd::fault), {}};
    for (std::size_t i = first; i < first + experiment.measures.size(); ++i) {
        double value = std::nan("");
        if (i < cells.size()) std::from_chars(cells[i].data(), cells[i].data() + cells[i].size(), value);
        outcome.measures.push_back(value);
    }
    const std::size_t fault = first + experiment.measures.size() + faultBehind;
    if (fault < cells.size()) outcome.fault = cells[fault];
    return outcome;
}

std::vector<VariantSummary> summarised(const Experiment& experiment, const std::map<RunKey, std::string>& rows) {
    std::vector<VariantSummary> summaries;
    for (const Variant& variant : experiment.variants) {
        VariantSummary& summary = summaries.emplace_back();
        summary.name = variant.name;
        summary.sweep = variant.sweep;
        for (const Feature& feature : experiment.features) summary.measures.push_back({"feature." + feature.name});
        for (const Measure& measure : experiment.measures) summary.measures.push_back({"measure." + measure.name});
    }
    std::vector<std::vector<std::vector<TrialSum>>> trials(summaries.size());  // [variant][measure][trial]
    for (std::size_t v = 0; v < summaries.size(); ++v) trials[v].resize(summaries[v].measures.size());
    for (const auto& [key, row] : rows) {
        const std::vector<std::string> cells = resultsCells(row);
        VariantSummary& summary = summaries[key.variant - 1];
        const std::size_t first = firstDrawCell + experiment.draws.size();
        if (cells.size() <= first + summary.measures.size() + faultBehind) continue;
        ++summary.runs;
        summary.ended += cells[experimentEndCell] == name(RunEnd::condition) ? 1 : 0;
        if (cells[experimentEndCell] == name(RunEnd::fault) && ++summary.faulty == 1) {
            const std::string &fault = cells[first + summary.measures.size() + faultBehind], trial = inTrial(cells[0]);
            summary.firstFault = fault + (fault.ends_with(trial) ? "" : trial);
        }
        for (std::size_t i = 0; i < summary.measures.size(); ++i) {
            double value = std::nan("");
            const std::string& cell = cells[first + i];
            std::from_chars(cell.data(), cell.data() + cell.size(), value);
            add(summary.measures[i], value);
            if (!std::isfinite(value)) continue;
            std::vector<TrialSum>& ofMeasure = trials[key.variant - 1][i];
            if (ofMeasure.empty() || ofMeasure.back().trial != key.trial) ofMeasure.push_back({key.trial});
            ofMeasure.back().sum += value;
            ++ofMeasure.back().count;
        }
    }
    for (std::size_t v = 0; v < summaries.size(); ++v)
        for (std::size_t i = 0; i < summaries[v].measures.size(); ++i) {
            MeasureSummary& measure = summaries[v].measures[i];
            measure.deviation =
                measure.count > 1 ? std::sqrt(measure.deviation / static_cast<double>(measure.count - 1)) : 0;
            const std::size_t features = experiment.features.size();
            const Measure* const measured = i < features ? nullptr : &experiment.measures[i - features];
            // A mean over looks that is 0 or 1 throughout is no yes or no.
            measure.share = measure.share && (measured == nullptr || measured->of == Measure::Of::end);
            if (measure.count == 0) continue;
            measure.estimate = limited(
                estimateOf(measure, trials[v][i]),
                measured != nullptr ? possibleValues(*measured) : writtenRange(experiment.features[i].expression.text));
        }
    return summaries;
}

}  // namespace mrose
