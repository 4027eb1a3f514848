#include "workflow/opening.h"

#include <algorithm>
#include <cmath>

#include "io/format.h"
#include "scenario/start_check.h"

namespace mrose {
namespace {

std::vector<std::filesystem::path> placesOf(const std::filesystem::path& named,
                                            const std::filesystem::path& recording) {
    const std::filesystem::path folder = recording.parent_path();
    std::vector<std::filesystem::path> places{named};
    for (const std::filesystem::path& place : {folder / named, folder / named.filename()})
        if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
    return places;
}

/// Metres, to the millimetre.
std::string millimetresText(double metres) { return numberText(std::round(1000 * metres) / 1000); }

}  // namespace

std::vector<std::string> startsOutsideText(const Scene& scene) {
    constexpr std::size_t most = 10;
    const std::vector<std::size_t> outside = startsOutside(scene);
    std::vector<std::string> sentences;
    for (std::size_t i = 0; i < std::min(outside.size(), most); ++i) {
        const std::size_t body = outside[i];
        const bool robot = body < scene.robots.size();
        const std::size_t object = body - scene.robots.size();
        const Pose& start = robot ? scene.robots[body].start : scene.objects[object].start;
        const std::string name = robot ? scene.robots[body].name : scene.objects[object].name;
        sentences.push_back('"' + name + "\" starts at (" + millimetresText(start.x) + ", " + millimetresText(start.y) +
                            "), outside of what the environment's walls and floor area span");
    }
    if (outside.size() > most) sentences.push_back("so do " + std::to_string(outside.size() - most) + " more");
    return sentences;
}

std::vector<std::string> startsApartText(const LoadedScenario& loaded) {
    constexpr double apart = 0.0005, turned = 0.001;  // m, rad
    const ScenarioParts& parts = loaded.parts;
    if (parts.saved == nullptr || !parts.players.empty()) return {};
    const auto asWritten = loadScenario(loaded.value, {.playLogs = false});
    if (!asWritten) return {};
    std::string names;
    for (std::size_t i = 0; i < parts.scene.robots.size(); ++i) {
        const SceneRobot &robot = parts.scene.robots[i], &written = asWritten->parts.scene.robots[i];
        const bool same = distance(position(robot.start), position(written.start)) < apart &&
                          std::abs(wrapAngle(robot.start.heading - written.start.heading)) < turned;
        if (!same) names += (names.empty() ? "" : ", ") + robot.name;
    }
    if (names.empty()) return {};
    return {loaded.value.name() + ": the start lines of " + names +
            " are not where initial_state has them, which holds; without initial_state the run begins at the start "
            "lines"};
}

PluginLoader findingLoader(const std::filesystem::path& recording, PluginLoader load) {
    return [recording, load = std::move(load)](
               const std::string& path, const std::string& options) -> Expected<std::shared_ptr<const Controller>> {
        std::error_code ignored;
        std::string looked;
        for (const std::filesystem::path& place : placesOf(path, recording)) {
            if (std::filesystem::exists(place, ignored)) return load(place.string(), options);
            looked += (looked.empty() ? "" : ", nor ") +
                      std::filesystem::absolute(place, ignored).lexically_normal().string();
        }
        return fail("", "the plug-in is neither " + looked);
    };
}

}  // namespace mrose
