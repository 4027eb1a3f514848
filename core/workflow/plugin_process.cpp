#include "workflow/plugin_process.h"

#include <algorithm>

#include "plugin/isolated_controller.h"

namespace mrose {

Expected<std::shared_ptr<const Controller>> startPluginProcess(const std::string& path, const std::string& options,
                                                               double limit) {
    const IsolationOptions isolation{{"/proc/self/exe", pluginHostWord}, limit, std::max(limit, 10.0)};
    auto controller = isolatePlugin(path, options, isolation);
    if (!controller) return tl::unexpected(controller.error());
    return std::move(*controller);
}

}  // namespace mrose
