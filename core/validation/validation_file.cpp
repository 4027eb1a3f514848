#include "validation/validation_file.h"

#include <algorithm>

#include "learning/network_file.h"
#include "learning/task_network.h"
#include "scenario/description_library.h"
#include "scenario/description_reader.h"

namespace mrose {
namespace {

constexpr std::int64_t mostTrials = 10'000'000, mostSeeds = 1'000'000;
constexpr std::size_t mostMeasures = 32, mostRanges = 1000, mostCalled = 24;

/// What one of the parts sets: values as the experiment's variants have them, and a settings file.
struct PartSet {
    std::string called;
    Value::Table set;
    std::optional<Value> settings;
    std::vector<TrialRange> used;
    bool saysUsed = false;     ///< all of them, by `used_trials`
    bool saysTunedOn = false;  ///< those of the settings file, by its evidence
};

/// Whether some of it was learned from trials.
bool holdsTaskNetwork(const Value& value) {
    if (const DescriptionFile* const file = value.asFile()) {
        const std::string* const text = file->content.asText();
        return text != nullptr ? networkKind(*text) == TaskNetwork::kind : holdsTaskNetwork(file->content);
    }
    if (const Value::Array* const array = value.asArray()) return std::ranges::any_of(*array, holdsTaskNetwork);
    const Value::Table* const table = value.asTable();
    return table != nullptr &&
           std::ranges::any_of(*table, [](const auto& entry) { return holdsTaskNetwork(entry.second); });
}

class ValidationReader {
public:
    ValidationReader(const Value::File& file, DescriptionSource& source, const ScenarioLoading& loading)
        : file_(file),
          source_(source),
          library_(source),
          loading_{loading.plugins, loading.playLogs, false},
          root_(openDescription(file->content, library_.shown(file->name), DescriptionKind::validation)) {}

    Expected<Validation> read() {
        result_.file = library_.shown(file_->name);
        result_.name = name(root_, "name");
        readBase();
        if (root_.failed()) return tl::unexpected(root_.error());
        readRuns();
        readMeasures();
        PartSet before = readPart("before", true), after = readPart("after", true);
        PartSet simulation = readPart("simulation", false), reality = readReality();
        readAccount();
        root_.rejectUnknown();
        if (root_.failed()) return tl::unexpected(root_.error());
        result_.before = before.called, result_.after = after.called;
        result_.simulation = simulation.called, result_.reality = reality.called;
        checkUnused(before);
        checkUnused(after);
        buildExperiment(before, after, simulation, reality);
        if (root_.failed()) return tl::unexpected(root_.error());
        return std::move(result_);
    }

private:
    void readBase() {
        experimentFile_ =
            library_.file(root_, "experiment", file_->name, "resources/experiments", DescriptionLibrary::Holds::tables);
        if (!experimentFile_) return;
        auto experiment = readExperiment(experimentFile_, source_, loading_);
        if (!experiment) return root_.adopt(experiment.error());
        base_ = std::move(*experiment);
        const bool several = base_.variants.size() > 1 || !base_.variants[0].name.empty();
        std::string names;
        for (const Variant& variant : base_.variants) names += (names.empty() ? "\"" : ", \"") + variant.name + '"';
        if (!root_.has("variant")) {
            if (several) root_.reject("variant", "is missing: the experiment has " + names);
            return;
        }
        const std::string wanted = root_.string("variant");
        for (const Variant& variant : base_.variants)
            if (!variant.name.empty() && variant.name == wanted)
                for (const auto& [path, value] : variant.set) common_[path] = value;
        const bool known =
            several && std::ranges::any_of(base_.variants, [&](const Variant& v) { return v.name == wanted; });
        if (!root_.failed() && !known)
            root_.reject("variant", "is no variant of the experiment; expected " + (several ? names : "none"));
    }

    void readRuns() {
        trials_ = root_.integer("trials", 1, mostTrials);
        firstTrial_ = root_.integerOr("first_trial", 1, 1, mostTrials);
        seeds_ = root_.integerOr("seeds", base_.seeds, 1, mostSeeds);
        fromStart_ = root_.booleanOr("from_start", false);
    }

    void readMeasures() {
        std::vector<TomlTable> tables = root_.tables("measure");
        if (!root_.failed() && (tables.empty() || tables.size() > mostMeasures))
            root_.reject("measure", "expected 1 to " + std::to_string(mostMeasures));
        for (TomlTable& table : tables) {
            ValidatedMeasure measure;
            measure.name = table.string("name");
            measure.unit = table.stringOr("unit", "");
            measure.lessIsBetter = table.choice("better", {"less", "more"}) == 0;
            measure.yesNo = table.booleanOr("yes_no", false);
            if (const Value* const at = table.value(table.has("yes_no") ? "yes_no" : "name"))
                measure.line = at->line, measure.column = at->column;
            table.rejectUnknown();
            if (root_.failed()) return;
            std::string known;
            for (const Measure& one : base_.measures) known += (known.empty() ? "" : ", ") + one.name;
            if (std::ranges::none_of(base_.measures, [&](const Measure& one) { return one.name == measure.name; }))
                table.reject("name", "is no measure of the experiment; expected one of " + known);
            if (std::ranges::any_of(result_.measures, [&](const auto& one) { return one.name == measure.name; }))
                table.reject("name", "is there twice");
            result_.measures.push_back(std::move(measure));
        }
    }

    std::string calledOr(TomlTable& table, const std::string& fallback) {
        if (!table.has("name")) return fallback;
        std::string called = name(table, "name");
        if (!table.failed() && called.size() > mostCalled)
            table.reject("name", "expected at most " + std::to_string(mostCalled) + " characters");
        return called;
    }

    PartSet readPart(const std::string& key, bool learns) {
        TomlTable table = learns ? root_.table(key) : root_.tableOrEmpty(key);
        PartSet part = namedSet(table, key);
        if (learns && table.has("settings"))
            if (const Value::File file = library_.file(table, "settings", file_->name, "resources/experiments",
                                                       DescriptionLibrary::Holds::tables)) {
                part.settings = Value(file);
                readEvidence(*file, part);
            }
        if (learns && table.has("used_trials")) {
            part.saysUsed = true;
            const std::vector<double> rows =
                table.rows("used_trials", 2, 0, mostRanges, {1, static_cast<double>(mostTrials)});
            for (std::size_t i = 0; i + 1 < rows.size(); i += 2)
                part.used.push_back({static_cast<std::uint32_t>(rows[i]), static_cast<std::uint32_t>(rows[i + 1])});
        }
        table.rejectUnknown();
        return part;
    }
    /// Which trials a settings file says that it was tuned on, those of its evidence included.
    void readEvidence(const DescriptionFile& file, PartSet& part) const {
        const Value* const evidence = file.content.find("evidence");
        if (evidence == nullptr) return;
        const auto whole = [&](std::string_view key) -> std::uint32_t {
            const Value* const value = evidence->find(key);
            const std::int64_t* const number = value != nullptr ? value->asInteger() : nullptr;
            return number != nullptr && *number > 0 && *number <= mostTrials ? static_cast<std::uint32_t>(*number) : 0;
        };
        const Value* const of = evidence->find("experiment");
        const std::string* const experiment = of != nullptr ? of->asText() : nullptr;
        const auto nameOf = [](const std::string& path) { return path.substr(path.rfind('/') + 1); };
        if (experiment == nullptr || whole("trials") == 0) return;
        part.saysTunedOn = true;
        if (nameOf(*experiment) != nameOf(experimentFile_->name)) return;  // trials of something else
        part.used.push_back({1, whole("trials")});
        if (whole("held_out_from") > 0) part.used.push_back({whole("held_out_from"), whole("held_out_to")});
    }
    PartSet namedSet(TomlTable& table, const std::string& key) {
        PartSet part;
        part.called = calledOr(table, key);
        readSet(table, part);
        return part;
    }

    PartSet readReality() {
        TomlTable table = root_.tableOrEmpty("reality");
        PartSet part = namedSet(table, "reality");
        if (table.has("results")) {
            if (!part.set.empty()) table.reject("results", "are there instead of `set`; expected one of them");
            std::vector<std::string> measures;
            for (const ValidatedMeasure& measure : result_.measures) measures.push_back(measure.name);
            const Value::File file =
                library_.file(table, "results", file_->name, "resources/experiments", DescriptionLibrary::Holds::text);
            if (file && !root_.failed()) {
                auto real = readRealResults(*file->content.asText(), library_.shown(file->name), measures);
                if (!real)
                    root_.adopt(real.error());
                else
                    result_.real = std::move(*real);
            }
        } else if (part.set.empty()) {
            root_.reject("reality", "says nothing of the reality; expected `set` or `results`");
        }
        table.rejectUnknown();
        return part;
    }

    /// As they are when they stand in the scenario.
    void readSet(TomlTable& table, PartSet& part) {
        TomlTable sets = table.tableOrEmpty("set");
        const Value* const named = table.has("set") ? table.value("set") : nullptr;
        if (named == nullptr || named->asTable() == nullptr) return;
        ScenarioValue varied = base_.scenario;  // one may be within what another has set
        for (const auto& [path, value] : generalFirst(*named->asTable())) {
            sets.value(path);
            if (root_.failed()) return;
            auto changed = varied.with(path, value);
            if (!changed) return sets.reject(path, changed.error().cause);
            const auto loaded = loadScenario(*changed, library_, loading_);
            if (!loaded) {
                const Error& error = loaded.error();
                return sets.reject(path,
                                   (error.key.empty() || error.key == path ? "" : error.key + ": ") + error.cause);
            }
            const Value* const there = loaded->value.at(path);
            Value& kept = part.set[path] = there != nullptr ? *there : value;
            kept.line = value.line, kept.column = value.column;
            if (auto with = varied.with(path, kept)) varied = std::move(*with);
        }
    }

    void readAccount() {
        TomlTable table = root_.tableOrEmpty("account");
        ValidationAccount& account = result_.account;
        if (table.has("log_minutes")) account.logMinutes = table.number("log_minutes", {0, 1e9});
        account.simulatedHours = table.numberOr("simulated_hours", 0, {0, 1e9});
        account.computingMinutes = table.numberOr("computing_minutes", 0, {0, 1e9});
        account.resetSeconds = table.numberOr("reset_s", 0, {0, 1e6});
        table.rejectUnknown();
    }

    void checkUnused(const PartSet& part) {
        if (root_.failed()) return;
        const std::int64_t last = firstTrial_ + trials_ - 1;
        for (const TrialRange& range : part.used)
            if (range.first <= last && range.last >= firstTrial_)
                return root_.reject("trials", "are " + std::to_string(firstTrial_) + " to " + std::to_string(last) +
                                                  "; \"" + part.called + "\" used " + std::to_string(range.first) +
                                                  " to " + std::to_string(range.last) +
                                                  "; expected others, by `first_trial`");
        if (part.saysUsed) return;
        const auto note = [&](const char* what) {
            result_.notes.push_back("It is not said which trials \"" + part.called + "\" was " + what +
                                    " (`used_trials`): they may be among these.");
        };
        if (part.settings && !part.saysTunedOn) note("tuned on");
        if (holdsTaskNetwork(part.set)) note("learned from");
    }

    void buildExperiment(const PartSet& before, const PartSet& after, const PartSet& simulation,
                         const PartSet& reality) {
        Value::Array variants;
        for (const bool real : {false, true})
            for (const bool learned : {false, true}) {
                if (real && result_.real) continue;
                const PartSet &place = real ? reality : simulation, &part = learned ? after : before;
                Value::Table set = common_;
                for (const auto& [path, value] : place.set) set[path] = value;
                for (const auto& [path, value] : part.set) {
                    if (place.set.contains(path)) {
                        TomlTable table = root_.table(learned ? "after" : "before");
                        return table.table("set").reject(path, "is set by \"" + place.called + "\", too");
                    }
                    set[path] = value;
                }
                Value::Table variant{{"name", result_.nameOf({learned, real})}, {"set", Value(std::move(set))}};
                if (part.settings) variant["settings"] = *part.settings;
                variants.emplace_back(std::move(variant));
            }
        Value::Table content = *experimentFile_->content.asTable();
        content["variant"] = Value(std::move(variants));
        content.erase("sweep");
        if (fromStart_)
            for (const char* const key : {"branch", "branch_within_s"}) content.erase(key);
        content["trials"] = trials_;
        content["first_trial"] = firstTrial_;
        content["seeds"] = seeds_;
        result_.content = Value(std::move(content));
        auto experiment = readExperiment(std::make_shared<const DescriptionFile>(DescriptionFile{
                                             experimentFile_->name, experimentFile_->reference, result_.content}),
                                         source_, loading_);
        if (!experiment) return root_.adopt(experiment.error());
        result_.experiment = std::move(*experiment);
        if (!result_.real) return;
        for (const auto& [trial, measured] : *result_.real)
            if (trial < firstTrial_ || trial >= firstTrial_ + trials_)
                return root_.reject("trials", "do not hold trial " + std::to_string(trial) + " of `reality.results`");
    }

    Value::File file_;
    DescriptionSource& source_;
    DescriptionLibrary library_;
    ScenarioLoading loading_;  ///< as it is written bodies may overlap: trials are drawn until they do not
    TomlTable root_;
    Validation result_;
    Value::File experimentFile_;
    Experiment base_;
    Value::Table common_;  ///< what the experiment's variant sets
    bool fromStart_ = false;
    std::int64_t trials_ = 0, firstTrial_ = 1, seeds_ = 1;
};

}  // namespace

std::string Validation::nameOf(const ValidationCell& cell) const {
    return (cell.after ? after : before) + " in " + (cell.real ? reality : simulation);
}

Expected<Validation> readValidation(const Value::File& file, DescriptionSource& source,
                                    const ScenarioLoading& loading) {
    return ValidationReader(file, source, loading).read();
}

bool isValidation(const Value& content) {
    const auto kind = descriptionKind(content, "");
    return kind && *kind == DescriptionKind::validation;
}

}  // namespace mrose
