#include "shared/opening.h"

#include <algorithm>
#include <charconv>

#include "experiment/variation.h"
#include "io/number_text.h"
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

/// No description has this name.
constexpr const char* trialName = "mrose:trial";

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
        sentences.push_back('"' + name + "\" starts at (" + numberText(start.x) + ", " + numberText(start.y) +
                            "), outside of what the environment's walls and floor area span");
    }
    if (outside.size() > most) sentences.push_back("so do " + std::to_string(outside.size() - most) + " more");
    return sentences;
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

void keepTrial(std::map<std::string, std::string>& texts, std::uint32_t trial) {
    if (trial > 0) texts[trialName] = std::to_string(trial);
}

Expected<ScenarioParts> asKeptTrial(ScenarioParts parts, const std::map<std::string, std::string>& texts) {
    const auto kept = texts.find(trialName);
    if (kept == texts.end()) return parts;
    std::uint32_t trial = 0;
    const char* const end = kept->second.data() + kept->second.size();
    if (std::from_chars(kept->second.data(), end, trial).ptr != end)
        return fail("", "has no number of a trial: " + kept->second);
    return varied(parts, trial);
}

}  // namespace mrose
