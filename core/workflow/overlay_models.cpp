#include "workflow/overlay_models.h"

#include <algorithm>
#include <filesystem>

#include "assessment/evaluate.h"
#include "simulation/step.h"
#include "workflow/motion_models.h"
#include "workflow/notices.h"

namespace mrose {
namespace {

/// The same log and scenario with robots that are moved by another model.
Expected<std::shared_ptr<const LogWorld>> worldMovedBy(const OverlayWorld& overlay, const OtherModel& moves) {
    const LogWorld& own = overlay.world();
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

/// The only network that the scenario reads; otherwise what kind of robot it is.
std::string ownName(const OverlayWorld& overlay) {
    std::string only;
    int networks = 0;
    for (const Value::File& file : overlay.value->files())
        if (const std::filesystem::path path(file->name); path.extension() == ".net") {
            only = path.filename().string();
            ++networks;
        }
    const LogWorld& world = overlay.world();
    return networks == 1 ? only : world.parts().scene.typeOf(world.robots().front().body).name;
}

std::string noteOn(const OtherModel& moves, const LogWorld& world) {
    for (const auto& model : moves.byRobot)
        if (const LearnedModel* const learned = model ? learnedModel(*model) : nullptr)
            return otherKindNotice(learned->network(), world);
    return {};
}

}  // namespace

OverlayModel ownModel(const OverlayWorld& overlay) { return {ownName(overlay), "", {{}, {}}, overlay.played}; }

Expected<OverlayModel> overlayModel(const OverlayWorld& overlay, const std::string& named) {
    const std::string file = std::filesystem::path(named).filename().string();
    const bool network = std::filesystem::path(named).extension() == ".net";
    const auto models = modelsToTry(overlay.world(), network ? std::vector{named} : std::vector<std::string>{});
    if (!models) return tl::unexpected(models.error());
    const auto found = std::find_if(models->begin(), models->end(),
                                    [&](const OtherModel& model) { return model.name == (network ? file : named); });
    if (found == models->end()) {
        std::string names;
        for (const OtherModel& model : *models) names += ", \"" + model.name + '"';
        return fail(named, network ? "is what the robots move by already; expected another network"
                                   : "is no motion model; expected a network's file" + names);
    }
    auto world = worldMovedBy(overlay, *found);
    if (!world) return tl::unexpected(world.error());
    return OverlayModel{found->name, named, *found, std::move(*world), noteOn(*found, overlay.world())};
}

std::vector<std::string> modelNames(const OverlayWorld& overlay) {
    std::vector<std::string> names;
    if (const auto models = modelsToTry(overlay.world(), {}))
        for (const OtherModel& model : *models) names.push_back(model.name);
    return names;
}

Expected<Summary> evaluatedModel(const OverlayWorld& overlay, const OverlayModel& model, Nanoseconds horizon,
                                 const std::function<bool(double share)>& progress) {
    const LogWorld& world = *model.world;
    EvaluationOptions options;
    for (const ComparedRobot& robot : world.robots()) options.robots.push_back(robot.realName);
    options.windows.horizon = horizon;
    options.relativeHorizons.clear();
    options.withFloor = false;
    const NamedModel named{model.name, [&world](const std::string& robot) -> const MotionModel* {
                               for (const ComparedRobot& compared : world.robots())
                                   if (compared.realName == robot) return &world.parts().scene.modelOf(compared.body);
                               return nullptr;
                           }};
    auto evaluation = evaluate(overlay.world().log(), {&named, 1}, options, progress);
    if (!evaluation) return tl::unexpected(evaluation.error());
    return evaluation->models.front().all;
}

Reality::ModelRollout modelRollout(const OverlayWorld& overlay, const OverlayModel& model,
                                   const RolloutRequest& rollout, const std::function<bool()>& goesOn) {
    const Nanoseconds length = rollout.steps * WindowOptions{}.step;
    LogWorld::Opened opened = model.world->openAt(rollout.session, rollout.start, length, overlay.seed);
    const Scene& scene = opened.scenario->scene();
    Reality::ModelRollout driven{model.name, scene.tickLength, {}};
    driven.poses.resize(opened.starts.size());
    const auto keep = [&] {
        for (std::size_t robot = 0; robot < opened.starts.size(); ++robot)
            if (opened.starts[robot]) driven.poses[robot].push_back(opened.state.robots[opened.bodies[robot]].pose);
    };
    StepBuffers buffers;
    keep();
    for (Nanoseconds now = 0; now < length && goesOn(); now += scene.tickLength) {
        step(*opened.scenario, opened.state, buffers);
        keep();
    }
    return driven;
}

}  // namespace mrose
