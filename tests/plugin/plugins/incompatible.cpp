// A plug-in whose descriptor is of another program: INCOMPATIBILITY changes it.
#include "control/controller.h"
#include "plugin/plugin.h"

namespace {

struct Standing : mrose::Controller {
    void decide(const mrose::Observation&, std::span<std::byte>, mrose::Decision&) const override {}
};

constexpr mrose::PluginDescriptor changed() {
    mrose::PluginDescriptor descriptor = mrose::describePlugin<Standing>();
    INCOMPATIBILITY;
    return descriptor;
}

}  // namespace

extern "C" {
extern const mrose::PluginDescriptor mrosePlugin;
const mrose::PluginDescriptor mrosePlugin = changed();
}
