#include "experiment/trial_expressions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "condition/lua_paths.h"
#include "io/text_position.h"
#include "quantities/part.h"
#include "quantities/value_key.h"

namespace mrose {
namespace {

constexpr double never = std::numeric_limits<double>::quiet_NaN();

std::string signatureOf(const Scene& scene) {
    std::string signature;
    for (const SceneRobot& robot : scene.robots) signature += robot.name + '\n';
    signature += '\n';
    for (const SceneObject& object : scene.objects) signature += object.name + '\n';
    signature += '\n';
    for (const Goal& goal : scene.environment.goals) signature += goal.name + '\n';
    return signature;
}

std::vector<const FileExpression*> allOf(const Experiment& experiment) {
    std::vector<const FileExpression*> all{&experiment.require, &experiment.branch, &experiment.until};
    for (const Feature& feature : experiment.features) all.push_back(&feature.expression);
    for (const Measure& measure : experiment.measures) all.push_back(&measure.expression);
    return all;
}

/// What controllers and motion models remember is known by what they explain at the start.
Expected<void> entriesAreThere(const FileExpression& expression, const Moment& start, const std::string& file) {
    for (const LuaPath& path : luaPaths(expression.text)) {
        const auto key = keyOfPath(*start.scenario, std::string(path.text));
        const auto value = key ? boundValue(*start.scenario, *key) : Expected<BoundValue>(fail("", ""));
        if (!value || value->quantity != &partQuantity() || value->other >= firstSensorPart) continue;
        const std::vector<MemoryEntry> entries = partEntries(start, value->body, value->other);
        if (std::ranges::any_of(entries, [&](const MemoryEntry& entry) { return entry.name == value->item; })) continue;
        std::string names;
        for (const MemoryEntry& entry : entries) names += (names.empty() ? "'" : ", '") + entry.name + '\'';
        const TextPosition where = positionIn(expression.text, path.offset + path.parts.back().begin);
        const Error error{
            "", where.line, where.column, "",
            "there is no '" + value->item + "' in '" + key->quantity + "': it has " + (names.empty() ? "none" : names)};
        return tl::unexpected(expression.placed(error, file));
    }
    return {};
}

}  // namespace

Expected<CompiledExpressions*> TrialExpressions::of(const Moment& start) {
    const std::string signature = signatureOf(start.scene());
    auto found = compiled_.find(signature);
    if (found == compiled_.end()) {
        auto all = compiled(start, false);  // of another trial the start may tell something else
        if (!all) return tl::unexpected(all.error());
        found = compiled_.emplace(signature, std::move(*all)).first;
    }
    return &found->second;
}

Expected<void> TrialExpressions::check(const Moment& start) const {
    if (const auto fit = compiled(start, true); !fit) return tl::unexpected(fit.error());
    for (const FileExpression* one : allOf(experiment_))
        if (auto there = entriesAreThere(*one, start, experiment_.file); !there) return there;
    return {};
}

Expected<CompiledExpressions> TrialExpressions::compiled(const Moment& start, bool tried) const {
    CompiledExpressions all;
    const Scenario& scenario = *start.scenario;
    const auto condition = [&](const FileExpression& expression, std::optional<Condition>& result) -> Expected<void> {
        if (expression.empty()) return {};
        auto one = compileCondition(expression.text, scenario, "", nullptr, start.drawn, tried);
        if (!one) return tl::unexpected(expression.placed(one.error(), experiment_.file));
        result.emplace(std::move(*one));
        return {};
    };
    const auto value = [&](const FileExpression& expression, std::vector<WorldValue>& values,
                           const DrawnValues* measured = nullptr) -> Expected<void> {
        auto one = compileWorldValue(expression.text, scenario, "", nullptr, start.drawn, measured, tried);
        if (!one) return tl::unexpected(expression.placed(one.error(), experiment_.file));
        values.push_back(std::move(*one));
        return {};
    };
    Expected<void> done = condition(experiment_.require, all.require);
    if (done) done = condition(experiment_.branch, all.branch);
    if (done) done = condition(experiment_.until, all.until);
    for (const Feature& feature : experiment_.features)
        if (done) done = value(feature.expression, all.features);
    DrawnValues above;
    for (const Measure& measure : experiment_.measures) {
        const bool atEnd = measure.of == Measure::Of::end;
        const bool holds = measure.of >= Measure::Of::seconds;
        std::optional<Condition> truth;
        // That it is true or false; of these, values are 1 and 0.
        if (done && holds) done = condition(measure.expression, truth);
        if (done) done = value(measure.expression, all.measures, atEnd ? &above : nullptr);
        above.push_back({measure.name, Value(never)});
    }
    if (!done) return tl::unexpected(done.error());
    all.follows = readsInsights(experiment_.until.text, scenario) ||
                  std::ranges::any_of(experiment_.measures, [&](const Measure& measure) {
                      return readsInsights(measure.expression.text, scenario);
                  });
    return all;
}

TrialMeasurement::TrialMeasurement(const Experiment& experiment, CompiledExpressions& expressions, Nanoseconds between)
    : experiment_(experiment), expressions_(expressions), between_(between), seen_(experiment.measures.size()) {
    const std::vector<Measure>& measures = experiment.measures;
    for (const Measure& measure : measures) {
        const auto isSame = [&](const Measure& one) { return one.expression.text == measure.expression.text; };
        firstOfText_.push_back(static_cast<std::size_t>(std::ranges::find_if(measures, isSame) - measures.begin()));
        isUntil_.push_back(measure.of >= Measure::Of::seconds && measure.expression.text == experiment.until.text);
    }
}

Expected<void> TrialMeasurement::begin(const Moment& start) {
    features_.clear();
    looks_ = 0;
    for (std::size_t i = 0; i < expressions_.features.size(); ++i) {
        const auto value = expressions_.features[i].value(start);
        if (!value) return tl::unexpected(experiment_.features[i].expression.placed(value.error(), experiment_.file));
        features_.push_back(*value);
    }
    measures_.assign(experiment_.measures.size(), never);
    held_.assign(measures_.size(), 0);
    for (std::size_t i = 0; i < measures_.size(); ++i) {
        const Measure::Of of = experiment_.measures[i].of;
        if (of >= Measure::Of::mean && of != Measure::Of::first) measures_[i] = 0;
    }
    return {};
}

void TrialMeasurement::skip() {
    features_.resize(expressions_.features.size(), never);
    measures_.assign(experiment_.measures.size(), never);
}

Expected<double> TrialMeasurement::valueOf(std::size_t measure, const Moment& at) {
    if (isUntil_[measure]) {
        const auto over = isOver(at);
        if (!over) return tl::unexpected(over.error());
        return *over ? 1 : 0;
    }
    std::optional<double>& seen = seen_[firstOfText_[measure]];
    if (seen) return *seen;
    auto value = expressions_.measures[measure].value(at);
    if (value) return *(seen = *value);
    return tl::unexpected(experiment_.measures[measure].expression.placed(value.error(), experiment_.file));
}

Expected<bool> TrialMeasurement::look(const Moment& at) {
    ++looks_;
    seen_.assign(seen_.size(), std::nullopt);
    over_.reset();
    for (std::size_t i = 0; i < measures_.size(); ++i) {
        const Measure::Of of = experiment_.measures[i].of;
        double& measured = measures_[i];
        if (of == Measure::Of::end || (of == Measure::Of::first && !std::isnan(measured))) continue;
        const auto value = valueOf(i, at);
        if (!value) return tl::unexpected(value.error());
        const bool holds = *value != 0 && !std::isnan(*value);
        if (of == Measure::Of::least) measured = std::fmin(measured, *value);
        if (of == Measure::Of::most) measured = std::fmax(measured, *value);
        if (of == Measure::Of::mean) measured += (*value - measured) / static_cast<double>(looks_);
        if (of == Measure::Of::seconds && holds) ++measured;  // looks, until the end
        if (of == Measure::Of::times && holds && held_[i] == 0) ++measured;
        held_[i] = holds ? held_[i] + 1 : 0;
        if (of == Measure::Of::longest) measured = std::max(measured, static_cast<double>(held_[i]));  // looks
        if (of == Measure::Of::first && holds) measured = toSeconds(at.now());
    }
    return isOver(at);
}

Expected<bool> TrialMeasurement::isOver(const Moment& at) {
    if (!expressions_.until) return false;
    if (over_) return *over_;
    auto over = expressions_.until->holds(at);
    if (!over) return tl::unexpected(experiment_.until.placed(over.error(), experiment_.file));
    return *(over_ = *over);
}

double TrialMeasurement::inSeconds(double looks) const { return toSeconds(static_cast<Nanoseconds>(looks) * between_); }

Expected<void> TrialMeasurement::end(const Moment& at) {
    seen_.assign(seen_.size(), std::nullopt);
    DrawnValues above;
    Moment withMeasures = at;
    withMeasures.measured = &above;
    for (std::size_t i = 0; i < measures_.size(); ++i) {
        const Measure::Of of = experiment_.measures[i].of;
        if (of == Measure::Of::mean && looks_ == 0) measures_[i] = never;
        if (of == Measure::Of::seconds || of == Measure::Of::longest) measures_[i] = inSeconds(measures_[i]);
        if (of == Measure::Of::end) {
            const auto value = valueOf(i, withMeasures);
            if (!value) return tl::unexpected(value.error());
            measures_[i] = *value;
        }
        above.push_back({experiment_.measures[i].name, Value(measures_[i])});
    }
    return {};
}

}  // namespace mrose
