#pragma once

#include <memory>
#include <string>

#include "control/controller.h"
#include "io/error.h"

namespace mrose {

/// The argument with which a program serves a plug-in instead of doing its own work; the number of a socket follows.
inline constexpr const char* pluginHostWord = "plugin-host";

/// A plug-in in a process of this same program. `limit`: seconds for each decision; loading may take 10 s at the least.
/// Error: as of isolatePlugin().
Expected<std::shared_ptr<const Controller>> startPluginProcess(const std::string& path, const std::string& options,
                                                               double limit);

}  // namespace mrose
