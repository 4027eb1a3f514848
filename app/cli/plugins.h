#pragma once

#include "common.h"
#include "plugin_watch.h"
#include "workflow/plugins.h"

namespace mrose::cli {

/// Flags of how plug-ins are run. Those that are loaded into this program are watched.
void addPluginFlags(CLI::App& sub, PluginUse& plugins);

/// The subcommand that serves an isolated plug-in; not for people.
Subcommand addPluginHost(CLI::App& app);

}  // namespace mrose::cli
