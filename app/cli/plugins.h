#pragma once

#include "common.h"
#include "plugin_watch.h"
#include "scenario/scenario_file.h"

namespace mrose::cli {

/// How controllers in shared libraries are run.
struct PluginFlags {
    bool isolate = false;
    double limit = 10;  ///< s
};
void addPluginFlags(CLI::App& sub, PluginFlags& flags);

/// Loads plug-ins into this program and watches them, or into processes of their own.
PluginLoader pluginLoader(const PluginFlags& flags);

/// The subcommand that serves an isolated plug-in; not for people.
Subcommand addPluginHost(CLI::App& app);

}  // namespace mrose::cli
