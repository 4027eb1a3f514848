#include "tuning/tuning_file.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "io/format.h"
#include "scenario/description_library.h"
#include "scenario/description_reader.h"
#include "tuning/paired_statistics.h"

namespace mrose {
namespace {

constexpr std::int64_t mostTuningTrials = 1'000'000, mostEvaluations = 10'000'000, leastHeldOut = 10;
constexpr std::size_t mostParameters = 20;

/// By which it is found again.
std::string calledName(const std::string& name, const std::string& shown) {
    return name.starts_with(shippedPrefix) ? name.substr(name.rfind('/') + 1) : shown;
}

class TuningReader {
public:
    TuningReader(const Value::File& file, DescriptionSource& source, const ScenarioLoading& loading)
        : file_(file),
          source_(source),
          library_(source),
          loading_{loading.plugins, loading.playLogs, false},
          root_(openDescription(file->content, library_.shown(file->name), DescriptionKind::tuning)) {}

    Expected<Tuning> read() {
        tuning_.file = library_.shown(file_->name);
        tuning_.called = calledName(file_->name, tuning_.file);
        tuning_.content = file_->content;
        tuning_.name = name(root_, "name");
        readExperimentOf();
        if (root_.failed()) return tl::unexpected(root_.error());
        readBudget();
        readCost();
        if (!root_.has("parameter")) root_.reject("parameter", "is missing; expected at least one");
        for (TomlTable& table : root_.tablesOrNone("parameter"))
            if (!root_.failed()) readParameter(table);
        root_.rejectUnknown();
        if (!root_.failed() && tuning_.options.parameters.size() > mostParameters)
            root_.reject("parameter", "expected at most " + std::to_string(mostParameters));
        if (root_.failed()) return tl::unexpected(root_.error());
        return std::move(tuning_);
    }

private:
    void readExperimentOf() {
        const Value::File file =
            library_.file(root_, "experiment", file_->name, "resources/experiments", DescriptionLibrary::Holds::tables);
        if (!file) return;
        auto experiment = readExperiment(file, source_, loading_);
        if (!experiment) return root_.adopt(experiment.error());
        tuning_.experimentFile = file;
        tuning_.experiment = std::move(*experiment);
        tuning_.experimentCalled = calledName(file->name, tuning_.experiment.file);
        if (!tuning_.experiment.branch.empty())
            return root_.reject("experiment", "branches; expected one whose variants begin at the start");
        std::vector<Variant>& variants = tuning_.experiment.variants;
        if (!root_.has("variant")) {
            if (variants.size() > 1 || !variants.front().name.empty())
                root_.reject("experiment", "has variants; expected `variant`, the name of the one that is tuned");
            return;
        }
        const std::string wanted = root_.string("variant");
        const auto found = std::ranges::find(variants, wanted, &Variant::name);
        if (found == variants.end())
            return root_.reject("variant", "is the name of no variant in " + tuning_.experiment.file);
        variants = {*found};
    }

    void readBudget() {
        TunerOptions& options = tuning_.options;
        options.trials = static_cast<std::uint32_t>(root_.integer("trials", Race::firstLook, mostTuningTrials));
        options.heldOut = static_cast<std::uint32_t>(root_.integer("held_out", leastHeldOut, mostTuningTrials));
        options.evaluations = root_.integer("evaluations", 1, mostEvaluations);
        options.seed = static_cast<std::uint64_t>(root_.integerOr("seed", 1, 0, std::int64_t{1} << 52));
        options.racing = root_.booleanOr("racing", true);
        if (!root_.failed() && options.evaluations < 2 * std::int64_t{options.trials})
            root_.reject("evaluations", "expected at least twice `trials`: what is now alone takes as many as those");
    }

    std::optional<std::size_t> measureNamed(const std::string& wanted) const {
        const std::vector<Measure>& measures = tuning_.experiment.measures;
        const auto found = std::ranges::find(measures, wanted, &Measure::name);
        return found == measures.end() ? std::nullopt
                                       : std::optional(static_cast<std::size_t>(found - measures.begin()));
    }

    std::string measureNames() const {
        std::string names;
        for (const Measure& measure : tuning_.experiment.measures) names += (names.empty() ? "" : ", ") + measure.name;
        return names.empty() ? "none" : names;
    }

    void readCost() {
        if (root_.has("failure_cost")) tuning_.failureCost = root_.number("failure_cost");
        const Value* const cost = root_.value("cost");
        if (cost == nullptr) return;
        tuning_.costLine = cost->line, tuning_.costColumn = cost->column;
        const std::string none = "is no measure of the experiment; it has " + measureNames();
        if (cost->asTable() == nullptr) {
            tuning_.costText = root_.string("cost");
            const auto measure = measureNamed(tuning_.costText);
            if (!measure && !root_.failed()) return root_.reject("cost", '"' + tuning_.costText + "\" " + none);
            if (measure) tuning_.cost.push_back({*measure, 1});
            return;
        }
        TomlTable weights = root_.table("cost");
        for (const auto& [measureName, weight] : *cost->asTable()) {
            const auto measure = measureNamed(measureName);
            const double by = weights.number(measureName);
            if (!measure) return weights.reject(measureName, none);
            tuning_.cost.push_back({*measure, by});
            tuning_.costText += (tuning_.costText.empty() ? "" : " + ") + numberText(by) + ' ' + measureName;
        }
        if (tuning_.cost.empty()) root_.reject("cost", "expected a measure, or weights of some");
    }

    void readParameter(TomlTable& table) {
        TunedParameter parameter;
        parameter.name = name(table, "name");
        if (const Value* const at = table.value("name")) parameter.line = at->line, parameter.column = at->column;
        if (!names_.insert(parameter.name).second) table.reject("name", "is the name of another parameter, too");
        const Value* const path = table.value("path");
        if (path != nullptr && path->asArray() != nullptr)
            parameter.paths = table.strings("path");
        else if (path != nullptr)
            parameter.paths = {table.string("path")};
        if (!root_.failed() && parameter.paths.empty()) table.reject("path", "expected at least one");
        parameter.from = table.number("from");
        parameter.to = table.number("to");
        if (!(parameter.from < parameter.to)) table.reject("to", "expected more than `from`");
        parameter.whole = table.booleanOr("whole", false);
        if (parameter.whole &&
            (std::floor(parameter.from) != parameter.from || std::floor(parameter.to) != parameter.to))
            table.reject("whole", "expected whole numbers `from` and `to`");
        if (table.has("scale")) parameter.logarithmic = table.choice("scale", {"linear", "log"}) == 1;
        if (parameter.logarithmic && !(parameter.from > 0))
            table.reject("from", "expected more than 0 for `scale` log");
        if (!root_.failed()) readPlaces(table, parameter);
        table.rejectUnknown();
        tuning_.options.parameters.push_back(std::move(parameter));
    }

    void readPlaces(TomlTable& table, TunedParameter& parameter) {
        for (const std::string& path : parameter.paths) {
            for (const char* const own : {"seed", "duration_s", "name", "format", "version"})
                if (path == own) table.reject("path", '"' + path + "\" is not for tuning");
            const std::vector<std::string> places = tuning_.experiment.scenario.places(path);
            const bool isNew = paths_.insert(path).second && (places.empty() || places_.insert(places).second);
            if (!isNew) table.reject("path", path + " is that of another parameter, too");
            checkFree(table, path);
        }
        parameter.start = startOf(table, parameter);
        if (!root_.failed() && !(parameter.start >= parameter.from && parameter.start <= parameter.to))
            table.reject(table.has("start") ? "start" : "path",
                         "is now " + numberText(parameter.start) + "; expected it between `from` and `to`");
        if (parameter.whole && std::floor(parameter.start) != parameter.start)
            table.reject(table.has("start") ? "start" : "path", "is now no whole number");
        // Where both ends fit, what lies between them does, or the run says so.
        for (const double value : {parameter.from, parameter.to, parameter.start})
            if (!root_.failed()) checkValue(table, parameter, value);
    }

    /// Nothing else may put something there later.
    void checkFree(TomlTable& table, const std::string& path) {
        const ScenarioValue& scenario = tuning_.experiment.scenario;
        const std::vector<std::string> own = scenario.places(path);
        const auto meets = [&](const std::string& other) {
            const std::vector<std::string> others = scenario.places(other);
            return std::ranges::any_of(own, [&](const std::string& place) { return areWithin({place}, others); });
        };
        for (const Draw& draw : tuning_.experiment.draws)
            if (std::ranges::any_of(draw.paths, meets))
                table.reject("path", path + " is drawn by \"" + draw.name + "\" for each trial");
        for (const auto& [set, value] : tuning_.experiment.variants.front().set)
            if (meets(set))
                table.reject("path", path + " is set by the variant; expected it in the experiment's `set`");
    }

    double startOf(TomlTable& table, const TunedParameter& parameter) {
        if (table.has("start")) return table.number("start");
        const Value* const there =
            parameter.paths.empty() ? nullptr : tuning_.experiment.scenario.at(parameter.paths.front());
        if (there != nullptr && there->asFloat() != nullptr) return *there->asFloat();
        if (there != nullptr && there->asInteger() != nullptr) return static_cast<double>(*there->asInteger());
        if (!root_.failed())
            table.reject("path", parameter.paths.front() + " has no number in the scenario; expected `start`");
        return parameter.from;
    }

    void checkValue(TomlTable& table, const TunedParameter& parameter, double value) {
        ScenarioValue with = tuning_.experiment.scenario;
        for (const std::string& path : parameter.paths) {
            auto changed = with.with(path, parameterValue(parameter, value));
            if (!changed) return table.reject("path", path + ": " + changed.error().cause);
            with = std::move(*changed);
        }
        const auto loaded = loadScenario(with, library_, loading_);
        if (loaded) return;
        const Error& error = loaded.error();
        table.reject("path", "with " + numberText(value) + ": " + error.key + ": " + error.cause);
    }

    Value::File file_;
    DescriptionSource& source_;
    DescriptionLibrary library_;
    ScenarioLoading loading_;
    TomlTable root_;
    Tuning tuning_;
    std::set<std::string> names_, paths_;
    std::set<std::vector<std::string>> places_;  ///< of the paths: one may be written in several ways
};

}  // namespace

Value parameterValue(const TunedParameter& parameter, double value) {
    return parameter.whole ? Value(static_cast<std::int64_t>(value)) : Value(value);
}

Value::Table tunedSets(const std::vector<TunedParameter>& parameters, const std::vector<double>& values) {
    Value::Table sets;
    for (std::size_t i = 0; i < parameters.size(); ++i)
        for (const std::string& path : parameters[i].paths)
            sets.emplace(path, parameterValue(parameters[i], values[i]));
    return sets;
}

Expected<Tuning> readTuning(const Value::File& file, DescriptionSource& source, const ScenarioLoading& loading) {
    return TuningReader(file, source, loading).read();
}

bool isTuning(const Value& content) {
    const auto kind = descriptionKind(content, "");
    return kind && *kind == DescriptionKind::tuning;
}

}  // namespace mrose
