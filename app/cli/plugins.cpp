#include "plugins.h"

#include "plugin/load_plugin.h"
#include "plugin/plugin_host.h"

namespace mrose::cli {
namespace {

Expected<std::shared_ptr<const Controller>> load(const std::string& path, const std::string& options, double limit) {
    startPluginWatch(limit);
    const PluginGuard guard("plug-in " + path);
    auto controller = loadPlugin(path, options);
    if (!controller) return tl::unexpected(controller.error());
    return std::move(*controller);
}

}  // namespace

void addPluginFlags(CLI::App& sub, PluginUse& plugins) {
    plugins.isolate = false;
    plugins.load = load;
    plugins.loaded = watchPlugins;
    sub.add_flag("--isolate", plugins.isolate,
                 "Give each plug-in a process of its own: when it crashes or hangs, only its robot stops");
    sub.add_option("--plugin-limit", plugins.limit, "How long a plug-in may take for a decision, in s")
        ->check(numberRange(0.01, 1e6))
        ->capture_default_str();
}

Subcommand addPluginHost(CLI::App& app) {
    auto socket = std::make_shared<int>(-1);
    CLI::App* sub = app.add_subcommand(pluginHostWord, "Serves an isolated plug-in")->group("");
    sub->add_option("SOCKET", *socket, "Number of the socket to the program")->required();
    return {sub, [socket] {
                servePlugin(*socket);
                return static_cast<int>(success);
            }};
}

}  // namespace mrose::cli
