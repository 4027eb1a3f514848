#include "workflow/plugins.h"

#include <algorithm>
#include <vector>

#include "io/file.h"
#include "plugin/isolated_controller.h"
#include "plugin/load_plugin.h"

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

Expected<std::shared_ptr<const Controller>> loadHere(const std::string& path, const std::string& options) {
    auto controller = loadPlugin(path, options);
    if (!controller) return tl::unexpected(controller.error());
    return std::move(*controller);
}

}  // namespace

PluginLoader pluginLoader(const PluginUse& plugins) {
    return [plugins](const std::string& path, const std::string& options) {
        if (plugins.isolate) return startPluginProcess(path, options, plugins.limit);
        return plugins.load ? plugins.load(path, options, plugins.limit) : loadHere(path, options);
    };
}

PluginLoader HashingLoader::loader() {
    return [this](const std::string& path, const std::string& options) {
        const std::lock_guard lock(mutex_);
        if (!hashes_.contains(path))
            if (const auto content = readFile(path)) hashes_[path] = contentHash(*content);
        return load_(path, options);
    };
}

Expected<std::shared_ptr<const Controller>> startPluginProcess(const std::string& path, const std::string& options,
                                                               double limit) {
    const IsolationOptions isolation{{"/proc/self/exe", pluginHostWord}, limit, std::max(limit, 10.0)};
    auto controller = isolatePlugin(path, options, isolation);
    if (!controller) return tl::unexpected(controller.error());
    return std::move(*controller);
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
