#include "plugin/plugin_host.h"

#include "common.h"

namespace mrose::cli {

Subcommand addPluginHost(CLI::App& app) {
    // Not for people: the program starts itself so, for each plug-in under --isolate.
    auto socket = std::make_shared<int>(-1);
    CLI::App* sub = app.add_subcommand(pluginHostName, "")->group("");
    sub->add_option("SOCKET", *socket)->required();
    return {sub, [socket] {
                servePlugin(*socket);
                return static_cast<int>(success);
            }};
}

}  // namespace mrose::cli
