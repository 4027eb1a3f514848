#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "scenario/scenario_file.h"

namespace mrose {

/// The argument with which a program serves a plug-in instead of doing its own work; the number of a socket follows.
inline constexpr const char* pluginHostWord = "plugin-host";

/// How the controllers in shared libraries are run.
struct PluginUse {
    bool isolate = true;  ///< each in a process of its own: when it crashes or hangs, only its robot stops
    double limit = 10;    ///< s, for each decision
    /// Loads one that is not isolated into this program; `limit` is the one above.
    std::function<Expected<std::shared_ptr<const Controller>>(const std::string& path, const std::string& options,
                                                              double limit)>
        load = {};
    /// Called with a scenario that was loaded: who loads plug-ins into this program may watch over them. May be empty.
    std::function<void(ScenarioParts&)> loaded = {};
};

PluginLoader pluginLoader(const PluginUse& plugins);

/// Loads plug-ins, one at a time, and keeps what was in their files: part of what results depend on.
class HashingLoader {
public:
    explicit HashingLoader(const PluginUse& plugins) : load_(pluginLoader(plugins)) {}
    /// This object must outlive it.
    PluginLoader loader();
    /// Of those that were loaded until now, by their paths.
    const std::map<std::string, std::string>& hashes() const { return hashes_; }

private:
    PluginLoader load_;
    std::mutex mutex_;
    std::map<std::string, std::string> hashes_;
};

/// A plug-in in a process of this same program. `limit`: seconds for each decision; loading may take 10 s at the least.
/// Error: as of isolatePlugin().
Expected<std::shared_ptr<const Controller>> startPluginProcess(const std::string& path, const std::string& options,
                                                               double limit);

/// Loads plug-ins that a recording names from wherever they are found: as they were named, seen from the current
/// folder; the same seen from the recording's; beside the recording. Error: all places where there is none.
PluginLoader findingLoader(const std::filesystem::path& recording, PluginLoader load);

}  // namespace mrose
