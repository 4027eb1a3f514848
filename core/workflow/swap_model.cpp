#include "workflow/swap_model.h"

#include <filesystem>

#include "io/file.h"
#include "scenario/scenario_file.h"

namespace mrose {
namespace {

/// Holds the place of a plug-in's controller while a scenario is loaded.
class PlaceOfPlugin final : public Controller {
public:
    void decide(const Observation&, std::span<std::byte>, Decision&) const override {}
};

}  // namespace

std::string modelName(const std::string& file) { return std::filesystem::path(file).filename().string(); }

Expected<BranchSetupPointer> withSwappedModel(const BranchSetup& setup, std::size_t robot, const std::string& file) {
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored) && !std::filesystem::is_regular_file(file, ignored))
        return fail(file, "is no regular file; expected a network");
    const Expected<std::string> content = readFile(file);
    if (!content) return tl::unexpected(content.error());
    const ScenarioParts& before = setup.scenario->parts();
    const std::string path = std::filesystem::absolute(file, ignored).lexically_normal().string();
    if (!setup.value) return fail(file, "cannot be taken over: the run has no description");
    const std::string body = setup.value->bodyPath(before.scene.robots[robot].name);
    auto value = setup.value->with(body + ".network",
                                   std::make_shared<const DescriptionFile>(DescriptionFile{path, path, *content}));
    if (!value) return tl::unexpected(value.error());
    const PluginLoader keepPlace = [](const std::string&, const std::string&) {
        return Expected<std::shared_ptr<const Controller>>(std::make_shared<const PlaceOfPlugin>());
    };
    auto loaded = loadScenario(*value, {keepPlace});
    if (!loaded) return tl::unexpected(loaded.error());
    ScenarioParts& parts = loaded->parts;
    for (std::size_t i = 0; i < parts.controllers.size(); ++i)
        if (dynamic_cast<const PlaceOfPlugin*>(parts.controllers[i].get()) != nullptr)
            parts.controllers[i] = before.controllers[i];
    parts.drawn = before.drawn;
    auto scenario = std::make_shared<const Scenario>(std::move(parts));
    return std::make_shared<const BranchSetup>(
        BranchSetup{std::make_shared<const ScenarioValue>(std::move(loaded->value)), std::move(scenario)});
}

}  // namespace mrose
