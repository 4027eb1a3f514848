#include "experiment/experiment_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <set>

#include "io/format.h"
#include "scenario/description_library.h"
#include "scenario/description_reader.h"
#include "scenario/settings_file.h"
#include "scenario/value_file.h"

namespace mrose {
namespace {

constexpr std::size_t mostOfUnit = 16;
constexpr std::int64_t mostTrials = 10'000'000, mostSeeds = 1'000'000, mostChoices = 1000;
constexpr std::array measureWords{std::string_view("least"),   std::string_view("most"),  std::string_view("mean"),
                                  std::string_view("seconds"), std::string_view("times"), std::string_view("first"),
                                  std::string_view("longest")};

constexpr std::array<std::string_view, 22> luaKeywords{
    "and", "break", "do",  "else", "elseif", "end",    "false",  "for",  "function", "goto",  "if",
    "in",  "local", "nil", "not",  "or",     "repeat", "return", "then", "true",     "until", "while"};

class ExperimentReader {
public:
    ExperimentReader(const Value::File& file, DescriptionSource& source, const ScenarioLoading& loading)
        : file_(file),
          library_(source),
          loading_{loading.plugins, loading.playLogs, false},
          root_(openDescription(file->content, library_.shown(file->name), DescriptionKind::experiment)) {}

    Expected<Experiment> read() {
        experiment_.file = library_.shown(file_->name);
        experiment_.name = name(root_, "name");
        readScenario();
        if (root_.failed()) return tl::unexpected(root_.error());
        readRuns();
        readSets();
        for (TomlTable& table : root_.tablesOrNone("draw"))
            if (!root_.failed()) readDraw(table);
        if (!root_.failed()) orderDraws();
        for (TomlTable& table : root_.tablesOrNone("variant"))
            if (!root_.failed()) readVariant(table);
        for (TomlTable& table : root_.tablesOrNone("sweep"))
            if (!root_.failed()) readSweep(table);
        if (experiment_.variants.empty()) experiment_.variants.emplace_back();
        readFeatures();
        readMeasures();
        root_.rejectUnknown();
        if (root_.failed()) return tl::unexpected(root_.error());
        return std::move(experiment_);
    }

private:
    void readScenario() {
        if (root_.has("scenario") && root_.string("scenario").empty())
            return root_.reject("scenario", "expected a scenario's file");
        const Value::File file =
            library_.file(root_, "scenario", file_->name, "resources/scenarios", DescriptionLibrary::Holds::tables);
        if (!file) return;
        const auto value = scenarioOf(file, library_.shown(file->name));
        if (!value) return root_.adopt(value.error());
        auto loaded = loadScenario(*value, library_, loading_);
        if (!loaded) return root_.adopt(loaded.error());
        experiment_.scenario = std::move(loaded->value);
        duration_ = loaded->parts.duration;
        tick_ = loaded->parts.scene.tickLength;
    }

    void readRuns() {
        experiment_.trials = static_cast<std::uint32_t>(root_.integer("trials", 1, mostTrials));
        experiment_.firstTrial = static_cast<std::uint32_t>(root_.integerOr("first_trial", 1, 1, mostTrials));
        experiment_.seed = static_cast<std::uint64_t>(root_.integerOr("seed", 1, 0, std::int64_t{1} << 52));
        experiment_.seeds = static_cast<std::uint32_t>(root_.integerOr("seeds", 1, 1, mostSeeds));
        const Nanoseconds duration = durationOr(root_, "duration_s", duration_, {0.001, 1e6});
        experiment_.every = durationOr(root_, "every_s", 0, {0.001, 1000});
        if (experiment_.every % tick_ != 0) root_.reject("every_s", "expected whole ticks of the scenario");
        if (experiment_.every > duration) root_.reject("every_s", "is longer than a run");
        if (root_.has("require")) experiment_.require = expression(root_, "require");
        if (root_.has("until")) experiment_.until = expression(root_, "until");
        if (root_.has("branch")) experiment_.branch = expression(root_, "branch");
        experiment_.branchWithin = durationOr(root_, "branch_within_s", duration, {0.001, 1e6});
        if (root_.has("branch_within_s") && experiment_.branch.empty())
            root_.reject("branch_within_s", "is there without `branch`");
        if (root_.failed()) return;
        keep(root_, "duration_s", "duration_s", toSeconds(duration));
        keep(root_, "seed", "seed", static_cast<std::int64_t>(experiment_.seed));
    }

    FileExpression expression(TomlTable& table, std::string_view key, const std::string& within = {}) {
        const Value* const value = table.value(key);
        FileExpression result{table.string(key), within + std::string(key), 0, 0};
        if (value != nullptr) result.line = value->line, result.column = value->column;
        if (!table.failed() && result.empty()) table.reject(key, "expected an expression");
        return result;
    }

    /// A name that columns and expressions have.
    bool plain(const std::string& name) const {
        return !name.empty() && name.size() <= 40 && std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
               std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
    }

    void readDraw(TomlTable& table) {
        Draw draw;
        draw.name = table.string("name");
        if (!table.failed() && !plain(draw.name)) table.reject("name", "expected letters, digits and _, at most 40");
        if (const Value* const named = table.value("name")) draw.line = named->line, draw.column = named->column;
        if (std::ranges::find(luaKeywords, draw.name) != luaKeywords.end())
            table.reject("name", "is a word of Lua: expressions could not name it");
        if (!names_.insert(draw.name).second) table.reject("name", "is the name of another draw, too");
        if (!experiment_.branch.empty() && draw.name == branchedAt)
            table.reject("name", "is what expressions call the instant of the branch");
        if (table.has("path")) {
            const Value* const path = table.value("path");
            if (path->asArray() != nullptr)
                draw.paths = table.strings("path");
            else
                draw.paths = {table.string("path")};
            if (!table.failed() && draw.paths.empty()) table.reject("path", "expected at least one");
        }
        readDistribution(table, draw);
        table.rejectUnknown();
        if (root_.failed()) return;
        for (const std::string& path : draw.paths) {
            checkPath(table, path);
            const bool isNew = paths_.insert(path).second && places_.insert(experiment_.scenario.places(path)).second;
            if (!isNew) table.reject("path", path + " is that of another draw, too");
        }
        experiment_.draws.push_back(std::move(draw));
    }

    /// As the keys of a table that sets them.
    void orderDraws() {
        const auto placesOf = [&](const std::string& path) { return experiment_.scenario.places(path); };
        Value::Table drawOf;
        for (std::size_t i = 0; i < experiment_.draws.size(); ++i)
            for (const std::string& path : experiment_.draws[i].paths) {
                const std::vector<std::string> places = placesOf(path);
                // In one way of writing it, so that a whole comes before its parts.
                drawOf[places.size() == 1 ? places.front() : path] = static_cast<std::int64_t>(i);
            }
        for (const auto& [path, draw] : generalFirst(drawOf))
            experiment_.drawPlaces.push_back({path, static_cast<std::size_t>(*draw.asInteger())});
        std::vector<std::string> later;
        for (auto at = experiment_.drawPlaces.rbegin(); at != experiment_.drawPlaces.rend(); ++at) {
            const std::vector<std::string> places = placesOf(at->path);
            const Draw& draw = experiment_.draws[at->draw];
            if (areWithin(places, later))
                return root_.adopt({experiment_.file, static_cast<int>(draw.line), static_cast<int>(draw.column),
                                    "draw[\"" + draw.name + "\"]",
                                    at->path + " has no effect: other draws set each of its elements"});
            later.insert(later.end(), places.begin(), places.end());
        }
    }

    void readDistribution(TomlTable& table, Draw& draw) {
        if (table.has("bodies")) {
            draw.kind = Draw::Kind::bodies;
            draw.bodies = table.strings("bodies");
            const auto count = static_cast<std::int64_t>(draw.bodies.size());
            draw.least = static_cast<double>(table.integerOr("from", 0, 0, count));
            draw.most = static_cast<double>(table.integerOr("to", count, 0, count));
            for (std::size_t i = 0; i < draw.bodies.size(); ++i)
                if (experiment_.scenario.bodyPath(draw.bodies[i]).empty())
                    table.rejectElement("bodies", i, "is the name of no body in the scenario");
                else if (!bodies_.insert(draw.bodies[i]).second)
                    table.rejectElement("bodies", i, "is there twice");
            if (!draw.paths.empty()) table.reject("path", "is for numbers; expected none beside `bodies`");
        } else if (table.has("of")) {
            draw.kind = Draw::Kind::choice;
            const Value* const of = table.value("of");
            const Value::Array* const choices = of != nullptr ? of->asArray() : nullptr;
            if (choices == nullptr || choices->empty() || choices->size() > mostChoices)
                return table.reject("of", "expected an array of 1 to 1000 values");
            draw.choices = *choices;
        } else if (table.has("value")) {
            draw.kind = Draw::Kind::computed;
            draw.expression = expression(table, "value", "draw[\"" + draw.name + "\"].");
        } else if (table.has("mean")) {
            draw.kind = Draw::Kind::normal;
            draw.mean = table.number("mean");
            draw.deviation = table.number("deviation", {0, 1e9});
            draw.least = table.numberOr("least", -std::numeric_limits<double>::infinity());
            draw.most = table.numberOr("most", std::numeric_limits<double>::infinity());
            if (!(draw.least <= draw.mean && draw.mean <= draw.most))
                table.reject("mean", "expected one between `least` and `most`");
        } else {
            if (!table.has("from") && !table.has("to"))
                return table.reject(
                    "name",
                    "says nothing of what is drawn; expected `from` and `to`, `mean` and `deviation`, `of`, "
                    "`value` or `bodies`");
            draw.least = table.number("from");
            draw.most = table.number("to");
            draw.whole = table.booleanOr("whole", false);
            if (draw.most < draw.least) table.reject("to", "is less than `from`");
            if (draw.whole && (std::floor(draw.least) != draw.least || std::floor(draw.most) != draw.most))
                table.reject("whole", "expected whole numbers `from` and `to`");
        }
        resolveChoices(table, draw);
    }

    /// What a value is when it stands somewhere in the scenario: with the files that it names. Error: why it does not
    /// fit there.
    tl::expected<Value, std::string> resolved(const ScenarioValue& scenario, const std::string& path,
                                              const Value& value) {
        auto changed = scenario.with(path, value);
        if (!changed) return tl::unexpected(path + ": " + changed.error().cause);
        const auto loaded = loadScenario(*changed, library_, loading_);
        if (!loaded) {
            // Lines of the scenario are not those of what is set in it.
            const Error& error = loaded.error();
            return tl::unexpected((error.key.empty() ? path : error.key) + ": " + error.cause);
        }
        const Value* const there = loaded->value.at(path);
        return there != nullptr ? *there : value;
    }
    /// Rejects what does not fit.
    Value resolvedIn(const ScenarioValue& scenario, TomlTable& table, std::string_view key, const std::string& path,
                     const Value& value) {
        auto there = resolved(scenario, path, value);
        if (!there) table.reject(key, there.error());
        return there.value_or(value);
    }
    Value resolved(TomlTable& table, std::string_view key, const std::string& path, const Value& value) {
        return resolvedIn(experiment_.scenario, table, key, path, value);
    }
    /// Puts it there for all trials.
    void keep(TomlTable& table, std::string_view key, const std::string& path, const Value& value) {
        Value kept = resolved(table, key, path, value);
        kept.line = kept.column = 0;  // they are none of the scenario's file
        auto changed = experiment_.scenario.with(path, std::move(kept));
        if (!changed) return table.reject(key, changed.error().cause);
        experiment_.scenario = std::move(*changed);
    }
    void resolveChoices(TomlTable& table, Draw& draw) {
        for (Value& choice : draw.choices)
            for (const std::string& path : draw.paths)
                if (!root_.failed()) choice = resolved(table, "of", path, choice);
    }
    /// There must be such a place; whether its last key is known, the first trial says.
    void checkPath(TomlTable& table, const std::string& path) {
        for (const char* const own : {"seed", "duration_s", "name", "format", "version"})
            if (path == own) return table.reject("path", "\"" + path + "\" is not for draws");
        if (const auto changed = experiment_.scenario.with(path, 0.0); !changed)
            table.reject("path", path + ": " + changed.error().cause);
    }

    static void checkFree(TomlTable& sets, const std::string& path) {
        if (path == "seed" || path == "duration_s") sets.reject(path, "is a key of the experiment itself");
    }

    /// What is set for all trials and variants.
    void readSets() {
        TomlTable sets = root_.tableOrEmpty("set");
        const Value* const named = root_.has("set") ? root_.value("set") : nullptr;
        if (named == nullptr || named->asTable() == nullptr) return;
        for (const auto& [path, value] : generalFirst(*named->asTable())) {
            sets.value(path);
            checkFree(sets, path);
            if (!root_.failed()) keep(sets, path, path, value);
        }
    }

    void readSettingsOf(TomlTable& table, Variant& variant) {
        const Value::File file =
            library_.file(table, "settings", file_->name, "resources/experiments", DescriptionLibrary::Holds::tables);
        if (!file) return;
        const auto settings = readSettings(file->content, library_.shown(file->name));
        if (!settings) return root_.adopt(settings.error());
        const auto with = settings->putInto(experiment_.scenario);
        if (!with) return root_.adopt(with.error());
        const auto loaded = loadScenario(*with, library_, loading_);
        if (!loaded) return root_.adopt(settings->placed(loaded.error(), *with));
        // One at a time: of what all elements have, a later one may set another value of some.
        ScenarioValue varied = experiment_.scenario;
        for (const auto& [path, value] : settings->set) {
            if (auto changed = varied.with(path, value)) varied = std::move(*changed);
            const auto alone = loadScenario(varied, library_, loading_);
            if (const Value* const there = alone ? alone->value.at(path) : nullptr) {
                variant.set.emplace_back(path, *there);
                continue;
            }
            // It fits with those after it alone: as all of them together make it.
            for (const std::string& place : loaded->value.places(path)) {
                const Value* const there = loaded->value.at(place);
                variant.set.emplace_back(place, there != nullptr ? *there : value);
            }
        }
        experiment_.settings.push_back(file);
    }

    /// A variant, and the scenario with all that it sets so far: one place may be within what another has set.
    struct Varied {
        Variant variant;
        ScenarioValue scenario;
    };

    Varied readSet(TomlTable& table) {
        Varied varied{{}, experiment_.scenario};
        if (const Value* const called = table.value("name"))
            varied.variant.line = called->line, varied.variant.column = called->column;
        if (table.has("settings")) readSettingsOf(table, varied.variant);
        for (const auto& [path, value] : varied.variant.set)
            if (auto with = varied.scenario.with(path, value)) varied.scenario = std::move(*with);
        TomlTable sets = table.tableOrEmpty("set");
        const Value* const named = table.has("set") ? table.value("set") : nullptr;
        if (named != nullptr && named->asTable() != nullptr)
            for (const auto& [path, value] : generalFirst(*named->asTable())) put(varied, sets, path, value);
        return varied;
    }
    void put(Varied& varied, TomlTable& sets, const std::string& path, const Value& value) {
        sets.value(path);
        checkFree(sets, path);
        if (root_.failed()) return;
        set(varied, path, resolvedIn(varied.scenario, sets, path, path, value));
    }
    static void set(Varied& varied, const std::string& path, const Value& value) {
        varied.variant.set.emplace_back(path, value);
        if (auto with = varied.scenario.with(path, value)) varied.scenario = std::move(*with);
    }
    void add(TomlTable& table, std::string_view key, Variant variant) {
        const bool taken =
            std::ranges::any_of(experiment_.variants, [&](const Variant& other) { return other.name == variant.name; });
        if (taken) table.reject(key, "\"" + variant.name + "\" is the name of another variant, too");
        experiment_.variants.push_back(std::move(variant));
    }

    void readVariant(TomlTable& table) {
        Varied varied = readSet(table);
        varied.variant.name = name(table, "name");
        table.rejectUnknown();
        add(table, "name", std::move(varied.variant));
    }

    /// A variant for each value.
    void readSweep(TomlTable& table) {
        SweepPoint point{name(table, "name"), table.has("unit") ? name(table, "unit") : "", 0};
        if (point.unit.size() > mostOfUnit) table.reject("unit", "is too long; expected at most 16 characters");
        const std::vector<double> values = table.someNumbers("values", 2, mostChoices, {-1e12, 1e12});
        const Varied base = readSet(table);
        TomlTable scaled = table.table("scaled");
        const Value* const factors = table.value("scaled");
        table.rejectUnknown();
        if (root_.failed()) return;
        for (const Variant& other : experiment_.variants)
            if (other.sweep && other.sweep->name == point.name)
                return table.reject("name", "is the name of another sweep, too");
        if (factors->asTable()->empty()) table.reject("scaled", "expected at least one place and its factor");
        for (std::size_t i = 0; i < values.size() && !root_.failed(); ++i) {
            point.at = values[i] + 0.0;  // no -0
            Varied varied = base;
            varied.variant.name =
                point.name + ' ' + plainNumberText(point.at) + (point.unit.empty() ? "" : " ") + point.unit;
            varied.variant.sweep = point;
            for (const auto& [path, factor] : generalFirst(*factors->asTable())) {
                checkFree(scaled, path);
                const double product = point.at * scaled.number(path);
                if (root_.failed()) return;
                const auto value = resolved(varied.scenario, path, Value(product));
                if (!value) return table.rejectElement("values", i, value.error());
                set(varied, path, *value);
            }
            add(table, "values", std::move(varied.variant));
        }
    }

    std::vector<std::string> keysOf(std::string_view key) {
        std::vector<std::string> keys;
        const Value* const value = root_.has(key) ? root_.value(key) : nullptr;
        if (value == nullptr || value->asTable() == nullptr) return keys;
        std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, std::string>> placed;
        for (const auto& [name, node] : *value->asTable()) placed.push_back({{node.line, node.column}, name});
        std::sort(placed.begin(), placed.end());  // as they are written
        for (auto& [place, name] : placed) keys.push_back(std::move(name));
        return keys;
    }
    void readFeatures() {
        TomlTable table = root_.tableOrEmpty("features");
        for (const std::string& key : keysOf("features")) {
            if (!plain(key)) table.reject(key, "expected a name of letters, digits and _, at most 40");
            experiment_.features.push_back({key, expression(table, key, "features.")});
        }
    }
    void readMeasures() {
        TomlTable table = root_.tableOrEmpty("measures");
        for (const std::string& key : keysOf("measures")) {
            if (!plain(key)) table.reject(key, "expected a name of letters, digits and _, at most 40");
            Measure measure{key, Measure::Of::end, {}};
            const Value* const value = table.value(key);
            if (value == nullptr || value->asTable() == nullptr) {
                measure.expression = expression(table, key, "measures.");
            } else {
                TomlTable of = table.table(key);
                std::size_t there = 0, word = 0;
                for (std::size_t i = 0; i < measureWords.size(); ++i)
                    if (of.has(measureWords[i])) ++there, word = i;
                if (there != 1)
                    table.reject(key,
                                 "expected one of `least`, `most`, `mean`, `seconds`, `times`, `first`, `longest`");
                measure.of = static_cast<Measure::Of>(word + 1);
                if (there == 1) measure.expression = expression(of, measureWords[word], "measures." + key + '.');
                of.rejectUnknown();
            }
            experiment_.measures.push_back(std::move(measure));
        }
    }

    Value::File file_;
    DescriptionLibrary library_;
    ScenarioLoading loading_;  ///< as it is written bodies may overlap: trials are drawn until they do not
    TomlTable root_;
    Experiment experiment_;
    Nanoseconds duration_ = 0, tick_ = 1;
    std::set<std::string> names_, paths_, bodies_;
    std::set<std::vector<std::string>> places_;  ///< of the paths: one may be written in several ways
};

}  // namespace

Error FileExpression::placed(Error inText, const std::string& file) const {
    const bool first = inText.line <= 1;
    // Of a text in quotation marks on one line.
    const int before = first ? static_cast<int>(column) : 0;
    inText.column = inText.column > 0 ? before + inText.column : static_cast<int>(column);
    inText.line = static_cast<int>(line) + std::max(0, inText.line - 1);
    inText.file = file;
    inText.key = key;
    return inText;
}

Error FileExpression::placed(std::string cause, const std::string& file) const {
    return {file, static_cast<int>(line), static_cast<int>(column), key, std::move(cause)};
}

Expected<Experiment> readExperiment(const Value::File& file, DescriptionSource& source,
                                    const ScenarioLoading& loading) {
    return ExperimentReader(file, source, loading).read();
}

bool isExperiment(const Value& content) {
    const auto kind = descriptionKind(content, "");
    return kind && *kind == DescriptionKind::experiment;
}

}  // namespace mrose
