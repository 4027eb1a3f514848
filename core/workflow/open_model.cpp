#include "workflow/open_model.h"

#include <algorithm>
#include <filesystem>

#include "workflow/motion_models.h"
#include "workflow/notices.h"

namespace mrose {
namespace {

/// The same log and scenario with robots that are moved by another model.
Expected<std::shared_ptr<const LogWorld>> worldMovedBy(const PlayedLog& log, const OtherModel& moves) {
    const LogWorld& own = log.world();
    ScenarioParts parts = own.parts();
    Scene& scene = parts.scene;
    for (std::size_t robot = 0; robot < moves.byRobot.size(); ++robot) {
        const auto& model = moves.byRobot[robot];
        if (!model) continue;
        if (model->period() % scene.tickLength != 0)
            return fail(moves.name, "has a control period that is no whole number of the scenario's ticks");
        const std::size_t body = own.robots()[robot].body;
        auto noisy = withNoise(model, noiseOf(scene.modelOf(body)));
        scene.robots[body].model = static_cast<std::uint32_t>(scene.models.size());
        scene.models.push_back(std::move(noisy));
    }
    auto world = LogWorld::create(std::move(parts), own.sharedLog());
    if (!world) return tl::unexpected(world.error());
    return std::make_shared<const LogWorld>(std::move(*world));
}

std::string noteOn(const OtherModel& moves, const LogWorld& world) {
    for (const auto& model : moves.byRobot)
        if (const LearnedModel* const learned = model ? learnedModel(*model) : nullptr)
            return otherKindNotice(learned->network(), world);
    return {};
}

}  // namespace

Expected<JudgedModel> openModel(const PlayedLog& log, const std::string& named) {
    const std::string file = std::filesystem::path(named).filename().string();
    const bool network = std::filesystem::path(named).extension() == ".net";
    const auto models = modelsToTry(log.world(), network ? std::vector{named} : std::vector<std::string>{});
    if (!models) return tl::unexpected(models.error());
    const auto found = std::find_if(models->begin(), models->end(),
                                    [&](const OtherModel& model) { return model.name == (network ? file : named); });
    if (found == models->end()) {
        std::string names;
        for (const OtherModel& model : *models) names += ", \"" + model.name + '"';
        return fail(named, network ? "is what the robots move by already; expected another network"
                                   : "is no motion model; expected a network's file" + names);
    }
    auto world = worldMovedBy(log, *found);
    if (!world) return tl::unexpected(world.error());
    return JudgedModel{found->name, named, *found, std::move(*world), noteOn(*found, log.world())};
}

std::vector<std::string> modelNames(const PlayedLog& log) {
    std::vector<std::string> names;
    if (const auto models = modelsToTry(log.world(), {}))
        for (const OtherModel& model : *models) names.push_back(model.name);
    return names;
}

std::vector<OtherModel> causeModels(const PlayedLog& log, const std::vector<JudgedModel>& laidOver) {
    auto models = modelsToTry(log.world(), {}).value_or(std::vector<OtherModel>{});
    for (const JudgedModel& laid : laidOver)
        if (!laid.moves.byRobot.empty() && std::none_of(models.begin(), models.end(), [&](const OtherModel& model) {
                return model.name == laid.name;
            }))
            models.push_back(laid.moves);
    return models;
}

}  // namespace mrose
