#include "scenario/state_scenario.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <vector>

#include "io/file.h"
#include "io/number_text.h"
#include "io/toml_edit.h"
#include "scenario/description_edit.h"
#include "scenario/description_source.h"
#include "scenario/saved_state.h"
#include "scenario/scenario_file.h"
#include "world/state_hash.h"

namespace mrose {
namespace {

/// Keys that name other description files, and where those ship.
struct ReferenceKey {
    const char* path;
    const char* folder;
};
constexpr ReferenceKey scenarioReferences[] = {
    {"environment", "resources/environments"},
    {"robot[].type", "resources/robots"},
    {"person[].type", "resources/robots"},
    {"robot[].network", "nets"},
    {"person[].network", "nets"},
    {"object[].shape", "shapes"},
};
constexpr ReferenceKey robotReferences[] = {{"shape", "shapes"}, {"motion.network", "nets"}};

std::string shippedName(const ReferenceKey& key, const std::string& reference) {
    return joinedName(std::string(shippedPrefix) + key.folder + '/', reference);
}

std::string absoluteName(const std::string& name) {
    std::error_code ignored;
    return std::filesystem::absolute(name, ignored).lexically_normal().generic_string();
}

/// Descriptions on their way to another folder.
class Relocation {
public:
    Relocation(const Descriptions& from, const std::filesystem::path& path)
        : from_(from), folder_(path.parent_path()), stem_(path.stem().string()) {}

    /// The scenario's text with its references as they are to be from there.
    Expected<std::string> scenarioText() {
        const std::string& text = from_.texts.at(from_.scenario);
        std::vector<TomlEdit> edits;
        if (auto done = relocate(text, from_.scenario, scenarioReferences, edits); !done)
            return tl::unexpected(done.error());
        for (const char* const kind : {"robot", "person"}) {
            if (auto done = relocateLogs(text, kind, edits); !done) return tl::unexpected(done.error());
            const auto libraries = tomlStrings(text, from_.scenario, kind + std::string("[].controller.library"));
            if (!libraries) return tl::unexpected(libraries.error());
            for (const TomlString& library : *libraries)
                edits.push_back({library.place, tomlString(absoluteName(joinedName(from_.scenario, library.value)))});
        }
        return withTomlValues(text, from_.scenario, edits);
    }

    /// By their names as the new text leads to them: all that it needs, and those of them to be written.
    const std::map<std::string, std::string>& texts() const { return texts_; }
    const std::vector<NamedFile>& files() const { return files_; }

private:
    /// The name by which a text is kept that a key of the file `from` refers to; "" where none is.
    std::string nameOf(const std::string& from, const ReferenceKey& key, const std::string& reference) const {
        for (const std::string& name : {joinedName(from, reference), shippedName(key, reference)})
            if (name != from && from_.texts.contains(name)) return name;
        return "";
    }

    Expected<void> relocate(const std::string& text, const std::string& from, std::span<const ReferenceKey> keys,
                            std::vector<TomlEdit>& edits) {
        for (const ReferenceKey& key : keys) {
            const auto references = tomlStrings(text, from, key.path);
            if (!references) return tl::unexpected(references.error());
            for (const TomlString& reference : *references) {
                const std::string name = nameOf(from, key, reference.value);
                if (name.empty()) continue;
                const auto moved = movedReference(name, key, reference.value);
                if (!moved) return tl::unexpected(moved.error());
                if (*moved != reference.value) edits.push_back({reference.place, tomlString(*moved)});
            }
        }
        return {};
    }

    /// How a file is referred to from the new folder.
    Expected<std::string> movedReference(const std::string& name, const ReferenceKey& key,
                                         const std::string& reference) {
        if (const auto found = moved_.find(name); found != moved_.end()) return found->second;
        if (name.starts_with(shippedPrefix)) {
            addTree(name);
            return moved_[name] = shippedName(key, reference) == name ? reference : name;
        }
        if (isOnDisk(name)) {
            addTree(name);
            return moved_[name] = absoluteName(name);
        }
        std::string text = from_.texts.at(name);
        std::vector<TomlEdit> edits;
        if (key.folder == std::string_view("resources/robots")) {
            if (auto done = relocate(text, name, robotReferences, edits); !done) return tl::unexpected(done.error());
            auto edited = withTomlValues(text, name, edits);
            if (!edited) return edited;
            text = std::move(*edited);
        }
        std::string beside = stem_ + '_' + std::filesystem::path(name).filename().string();
        while (!taken_.insert(beside).second) beside = '_' + beside;
        files_.push_back({folder_ / beside, text});
        texts_[(folder_ / beside).generic_string()] = std::move(text);
        return moved_[name] = beside;
    }

    /// Whether the file lies there as it was read, with all that it names.
    bool isOnDisk(const std::string& name) const {
        const auto there = readFile(name);
        if (!there || *there != from_.texts.at(name)) return false;
        for (const std::string& nested : namedBy(name))
            if (!nested.starts_with(shippedPrefix) && !isOnDisk(nested)) return false;
        return true;
    }

    /// Files that a robot file names.
    std::vector<std::string> namedBy(const std::string& robot) const {
        std::vector<std::string> names;
        for (const ReferenceKey& key : robotReferences) {
            const auto references = tomlStrings(from_.texts.at(robot), robot, key.path);
            if (!references) continue;  // a network is no TOML
            for (const TomlString& reference : *references)
                if (const std::string name = nameOf(robot, key, reference.value); !name.empty()) names.push_back(name);
        }
        return names;
    }

    void addTree(const std::string& name) {
        const std::string kept = name.starts_with(shippedPrefix) ? name : absoluteName(name);
        if (!texts_.emplace(kept, from_.texts.at(name)).second) return;
        for (const std::string& nested : namedBy(name)) addTree(nested);
    }

    Expected<void> relocateLogs(const std::string& text, const std::string& kind, std::vector<TomlEdit>& edits) {
        const auto logs = tomlStrings(text, from_.scenario, kind + "[].controller.log");
        if (!logs) return tl::unexpected(logs.error());
        for (const TomlString& log : *logs) {
            const std::string name = joinedName(from_.scenario, log.value);
            std::error_code ignored;
            const bool there = std::filesystem::exists(name, ignored);
            // One that is not beside the scenario is looked for where logs are kept.
            const std::string now =
                there ? absoluteName(name) : (folder_ / log.value).lexically_normal().generic_string();
            if (there) edits.push_back({log.place, tomlString(now)});
            for (const auto& [kept, excerpt] : from_.texts)
                if (kept.starts_with(name + '#')) texts_[now + kept.substr(name.size())] = excerpt;
        }
        return {};
    }

    const Descriptions& from_;
    std::filesystem::path folder_;
    std::string stem_;
    std::map<std::string, std::string> moved_;  ///< references by the names of what they lead to
    std::set<std::string> taken_;
    std::map<std::string, std::string> texts_;
    std::vector<NamedFile> files_;
};

/// The key that says where a scenario goes on from, with what its reader must know.
constexpr const char* stateKey = "initial_state = ";
constexpr const char* stateComment =
    "# The run goes on from this state, which holds. The start lines of robots say where they are in it, those of\n"
    "# objects where these go after a goal. Without the next line the run begins at the start lines.\n";

/// The text with the robots' start lines as they are in a state: of those that have one.
Expected<std::string> withStarts(const std::string& text, const std::string& name, const Scenario& scenario,
                                 const WorldState& state) {
    const std::size_t persons =
        static_cast<std::size_t>(std::ranges::count_if(scenario.scene().robots, [&](const SceneRobot& robot) {
            return scenario.scene().robotTypes[robot.type].person;
        }));
    const std::size_t robots = state.robots.size() - persons;
    std::vector<std::vector<TomlEdit>> all;
    for (std::size_t i = 0; i < state.robots.size(); ++i) {
        const std::string table =
            (i < robots ? "robot[" + std::to_string(i) : "person[" + std::to_string(i - robots)) + "].start";
        const Pose& pose = state.robots[i].pose;
        all.push_back({{{table, "x_m"}, numberText(pose.x)},
                       {{table, "y_m"}, numberText(pose.y)},
                       {{table, "heading_deg"}, numberText(wrapAngle(pose.heading) * 180 / std::numbers::pi)}});
    }
    std::vector<TomlEdit> together;
    for (const std::vector<TomlEdit>& edits : all) together.insert(together.end(), edits.begin(), edits.end());
    if (auto edited = withTomlValues(text, name, together)) return edited;
    // Some robot starts where its log does.
    std::string changed = text;
    for (const std::vector<TomlEdit>& edits : all)
        if (auto edited = withTomlValues(changed, name, edits)) changed = std::move(*edited);
    return changed;
}

std::string withStateComment(std::string text) {
    const std::size_t at = text.starts_with(stateKey) ? 0 : text.find(std::string("\n") + stateKey) + 1;
    const std::string comment = stateComment;
    if (at < comment.size() || text.compare(at - comment.size(), comment.size(), comment) != 0)
        text.insert(at, comment);
    return text;
}

/// Whether what was written goes on as the run would.
Expected<void> checkGoesOn(const std::string& name, std::map<std::string, std::string> texts, const Scenario& scenario,
                           const WorldState& state) {
    KeptDescriptions source(std::move(texts));
    auto loaded = loadScenario(name, source);
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
        return fail(name,
                    "would not go on as the run does, which is not as its scenario's files say; expected a run "
                    "that is no trial of a batch");
    return {};
}

}  // namespace

Expected<void> saveStateAsScenario(const std::filesystem::path& path, const Descriptions& descriptions,
                                   const Scenario& scenario, const WorldState& state) {
    if (!descriptions.texts.contains(descriptions.scenario))
        return fail(path.string(), "cannot be written: the run has no description of its scenario");
    const std::filesystem::path statePath = std::filesystem::path(path).replace_extension(".state");
    if (statePath == path) return fail(path.string(), "is a name for the state beside; expected one such as NAME.toml");
    Relocation relocation(descriptions, path);
    const auto text = relocation.scenarioText();
    if (!text) return tl::unexpected(text.error());
    const std::string name = path.generic_string();
    const auto seeded = withSeed({name, {{name, *text}}}, state.seed);
    if (!seeded) return tl::unexpected(seeded.error());
    auto started = withStarts(seeded->texts.at(name), name, scenario, state);
    if (!started) return tl::unexpected(started.error());
    auto complete =
        withTomlValue(*started, name, {"", "initial_state", "environment"}, tomlString(statePath.filename().string()));
    if (!complete) return tl::unexpected(complete.error());
    *complete = withStateComment(std::move(*complete));
    std::vector<NamedFile> files = relocation.files();
    files.push_back({statePath, savedStateText(savedState(scenario, state))});
    files.push_back({path, *complete});
    std::map<std::string, std::string> texts = relocation.texts();
    texts[joinedName(name, statePath.filename().string())] = files[files.size() - 2].content;
    texts[name] = *complete;
    if (auto same = checkGoesOn(name, std::move(texts), scenario, state); !same) return same;
    return writeFilesAtomically(files);
}

}  // namespace mrose
