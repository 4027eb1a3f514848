#include "scenario/state_scenario.h"

#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "io/file.h"
#include "io/toml_text.h"
#include "scenario/saved_state.h"
#include "scenario/scenario_file.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

constexpr const char* comment =
    "The run goes on from `initial_state`, which holds. The starts of robots say where they are in it, those of "
    "objects\n"
    "where these go after a goal. Without `initial_state` the run begins at the starts.";

std::string absoluteName(const std::string& name) {
    std::error_code ignored;
    return std::filesystem::absolute(name, ignored).lexically_normal().generic_string();
}

/// A scenario's files on their way to another folder.
class Relocation {
public:
    Relocation(const std::filesystem::path& path, DescriptionSource& disk)
        : folder_(path.parent_path()), stem_(path.stem().string()), disk_(disk) {}

    /// What a value says, with references as they are to be from there.
    Value moved(const Value& value) {
        Value copy = value;
        if (const Value::File file = value.sharedFile()) {
            Value::File& place = moved_[file];
            if (!place) place = movedFile(file);
            copy = place;
        } else if (const Value::Table* const table = value.asTable()) {
            Value::Table tables;
            for (const auto& [key, element] : *table) tables.emplace(key, moved(element));
            copy = std::move(tables);
        } else if (const Value::Array* const array = value.asArray()) {
            Value::Array elements;
            for (const Value& element : *array) elements.push_back(moved(element));
            copy = std::move(elements);
        }
        return copy;
    }

    const std::vector<NamedFile>& files() const { return files_; }

private:
    Value::File movedFile(const Value::File& file) {
        const auto named = [&](const std::string& reference) {
            return std::make_shared<const DescriptionFile>(DescriptionFile{file->name, reference, file->content});
        };
        if (file->content.find("commands")) return named(logReference(*file));
        if (file->name.starts_with(shippedPrefix) && isThere(*file)) return named(shortName(*file));
        if (!file->name.starts_with(shippedPrefix) && isThere(*file)) return named(absoluteName(file->name));
        std::string beside = stem_ + '_' + std::filesystem::path(file->name).filename().string();
        while (!taken_.insert(beside).second) beside = '_' + beside;
        const Value content = moved(file->content);
        const std::string* const text = content.asText();
        files_.push_back({folder_ / beside, text ? *text : tomlText(content)});
        return named(beside);
    }

    /// Where a file ships in the folder that its reference is looked for in, the reference will do.
    std::string shortName(const DescriptionFile& file) const {
        std::error_code ignored;
        const bool ends = !file.reference.empty() && file.name.ends_with('/' + file.reference);
        return ends && !std::filesystem::exists(folder_ / file.reference, ignored) ? file.reference : file.name;
    }

    /// One that is not beside the scenario is looked for where logs are kept.
    std::string logReference(const DescriptionFile& file) const {
        std::error_code ignored;
        return std::filesystem::exists(file.name, ignored) ? absoluteName(file.name) : file.reference;
    }

    /// Whether the file lies there as it was read, with all that it names.
    bool isThere(const DescriptionFile& file) {
        const auto text = disk_.text(file.name);
        if (!text || !*text) return false;
        if (const std::string* const own = file.content.asText()) return **text == *own;
        const auto content = parseToml(**text, file.name);
        return content && says(*content, file.content);
    }

    /// Whether a description says what another one does whose files are known.
    bool says(const Value& text, const Value& known) {
        if (const DescriptionFile* const file = known.asFile())
            return text.asText() && *text.asText() == file->reference && isThere(*file);
        const Value::Table *const table = known.asTable(), *const own = text.asTable();
        if (!table || !own) return text == known;
        if (table->size() != own->size()) return false;
        for (const auto& [key, element] : *table) {
            const Value* const other = text.find(key);
            if (!other || !says(*other, element)) return false;
        }
        return true;
    }

    std::filesystem::path folder_;
    std::string stem_;
    DescriptionSource& disk_;
    std::map<Value::File, Value::File> moved_;
    std::set<std::string> taken_;
    std::vector<NamedFile> files_;
};

/// Plug-ins are named by full paths.
Expected<ScenarioValue> withPluginPaths(ScenarioValue value) {
    for (const char* const kind : {"robot", "person"}) {
        const Value* const bodies = value.content().find(kind);
        const std::size_t count = bodies && bodies->asArray() ? bodies->asArray()->size() : 0;
        for (std::size_t i = 1; i <= count; ++i) {
            const std::string path = kind + ('[' + std::to_string(i) + "].controller.library");
            const Value* const library = value.at(path);
            if (!library || !library->asText()) continue;
            auto changed = value.with(path, absoluteName(joinedName(value.name(), *library->asText())));
            if (!changed) return changed;
            value = std::move(*changed);
        }
    }
    return value;
}

/// Whether the value goes on as the run would.
Expected<void> checkGoesOn(const std::string& name, const ScenarioValue& value, const Scenario& scenario,
                           const WorldState& state) {
    auto loaded = loadScenario(value);
    if (!loaded) return tl::unexpected(loaded.error());
    // The run's own controllers: plug-ins among them were not loaded.
    loaded->parts.controllers = scenario.parts().controllers;
    const Scene &ours = scenario.scene(), &theirs = loaded->parts.scene;
    bool same = ours.environment.floor.slidingFriction == theirs.environment.floor.slidingFriction &&
                ours.environment.floor.rollingDeceleration == theirs.environment.floor.rollingDeceleration;
    for (std::size_t i = 0; i < ours.objects.size(); ++i)
        same = same && ours.typeOfObject(i).mass == theirs.typeOfObject(i).mass &&
               scenario.kickOffPose(i) == loaded->parts.kickOffPoses[i];
    const Scenario again(std::move(loaded->parts));
    if (!same || hashOf(again.initialState()) != hashOf(state))
        return fail(name, "would not go on as the run does, which is not as its scenario says");
    return {};
}

}  // namespace

Expected<ScenarioValue> withState(const ScenarioValue& value, const Scenario& scenario, const WorldState& state) {
    if (state.seed > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
        return fail(value.name(), "a seed of " + std::to_string(state.seed) + " is beyond what a file can hold", 0,
                    "seed");
    auto changed = value.with("seed", static_cast<std::int64_t>(state.seed));
    for (std::size_t i = 0; changed && i < state.robots.size(); ++i) {
        const std::string body = changed->bodyPath(scenario.scene().robots[i].name);
        const Pose& pose = state.robots[i].pose;
        const double heading = wrapAngle(pose.heading) * 180 / std::numbers::pi;
        // One that starts where its log does has none.
        if (changed->at(body + ".start"))
            changed = changed->with(body + ".start",
                                    Value::Table{{"x_m", pose.x}, {"y_m", pose.y}, {"heading_deg", heading}});
    }
    if (!changed) return changed;
    const std::string name = "state";
    return changed->with("initial_state", std::make_shared<const DescriptionFile>(DescriptionFile{
                                              name, name, savedStateText(savedState(scenario, state))}));
}

Expected<void> saveStateAsScenario(const std::filesystem::path& path, const ScenarioValue& value,
                                   const Scenario& scenario, const WorldState& state, DescriptionSource& disk) {
    const std::filesystem::path statePath = std::filesystem::path(path).replace_extension(".state");
    if (statePath == path) return fail(path.string(), "is a name for the state beside; expected one such as NAME.toml");
    auto begun = withState(value, scenario, state);
    if (!begun) return tl::unexpected(begun.error());
    if (auto same = checkGoesOn(path.generic_string(), *begun, scenario, state); !same) return same;
    begun = withPluginPaths(std::move(*begun));
    if (!begun) return tl::unexpected(begun.error());
    const ScenarioValue alone = begun->without("initial_state");
    const std::string stateText = savedStateText(savedState(scenario, state), &alone);
    begun = begun->with("initial_state", statePath.filename().string());
    Relocation relocation(path, disk);
    const Value written = relocation.moved(begun->content());
    std::vector<NamedFile> files = relocation.files();
    files.push_back({statePath, stateText});
    files.push_back({path, tomlText(written, comment)});
    return writeFilesAtomically(files);
}

}  // namespace mrose
