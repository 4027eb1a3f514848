#include "open_run.h"

#include "scenario/scenario_file.h"
#include "shared/plugin_process.h"
#include "shared/resources.h"

namespace mrose::gui {
namespace {

/// Plug-ins run in processes of their own, so that one which hangs or crashes stops its robot and not the window.
Expected<std::shared_ptr<const Controller>> isolate(const std::string& path, const std::string& options) {
    constexpr double limit = 10;  // s
    return startPluginProcess(path, options, limit);
}

}  // namespace

Expected<OpenRun> openRun(const std::string& name, std::optional<std::uint64_t> seed) {
    DiskDescriptions source = openDescriptions();
    auto loaded = loadScenario(name, source, {isolate});
    if (!loaded) return tl::unexpected(loaded.error());
    auto scenario = std::make_shared<const Scenario>(std::move(loaded->parts));
    const WorldState start = seed ? scenario->initialState(*seed) : scenario->initialState();
    auto course = std::make_shared<const Course>(Course{{loaded->name, std::move(loaded->texts)}, scenario});
    return OpenRun{scenario->parts().name, name, std::move(course), start};
}

}  // namespace mrose::gui
