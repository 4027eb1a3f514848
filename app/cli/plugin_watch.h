#pragma once

#include <functional>
#include <string>

#include "experiment/results_file.h"
#include "scenario/scenario.h"

namespace mrose::cli {

/// Watches over plug-ins that run in this program: one that crashes, ends the program or does not return within `limit`
/// seconds ends it with one line that names it, and with ExitStatus::failure. Call it before any is loaded; further
/// calls do nothing.
void startPluginWatch(double limit);

/// What is done before the program ends because of a plug-in: to save what is safe. It runs in a thread of its own
/// while the one that the plug-in holds up, or crashed in, stays where it is.
void beforePluginEndsProgram(std::function<void()> action);

/// What this thread does with plug-ins from now on belongs to that run of a batch, which messages name.
void sayPluginsRun(const RunKey& key);

/// Watches what is done with the plug-in called `who` while it lives.
class PluginGuard {
public:
    explicit PluginGuard(const std::string& who);
    PluginGuard(const PluginGuard&) = delete;
    PluginGuard& operator=(const PluginGuard&) = delete;
    ~PluginGuard();

private:
    std::string who_;
};

/// Puts a watch round every controller of a scenario that is a plug-in in this program.
void watchPlugins(ScenarioParts& parts);

}  // namespace mrose::cli
