#include "debug/judged_model.h"

#include <algorithm>
#include <filesystem>

#include "assessment/evaluate.h"
#include "simulation/step.h"

namespace mrose {
namespace {

/// The only network that the scenario reads; otherwise what kind of robot it is.
std::string ownName(const PlayedLog& log) {
    std::string only;
    int networks = 0;
    for (const Value::File& file : log.value->files())
        if (const std::filesystem::path path(file->name); path.extension() == ".net") {
            only = path.filename().string();
            ++networks;
        }
    const LogWorld& world = log.world();
    return networks == 1 ? only : world.parts().scene.typeOf(world.robots().front().body).name;
}

/// Half of the work, the first or the second.
Progress halfOf(const Progress& progress, double from) {
    return [&progress, from](double share) { return !progress || progress(from + share / 2); };
}

}  // namespace

JudgedModel ownModel(const PlayedLog& log) { return {ownName(log), "", {{}, {}}, log.played}; }

Expected<Summary> evaluatedModel(const PlayedLog& log, const JudgedModel& model, Nanoseconds horizon,
                                 const Progress& progress) {
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
    auto evaluation = evaluate(log.world().log(), {&named, 1}, options, progress);
    if (!evaluation) return tl::unexpected(evaluation.error());
    return evaluation->models.front().all;
}

Reality::ModelRollout modelRollout(const PlayedLog& log, const JudgedModel& model, const RolloutRequest& rollout,
                                   const GoesOn& goesOn) {
    const Nanoseconds length = rollout.steps * WindowOptions{}.step;
    LogWorld::Opened opened = model.world->openAt(rollout.session, rollout.start, length, log.seed);
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

JudgedModel::Figures judge(const PlayedLog& log, const JudgedModel& model, const std::vector<RolloutRequest>& requests,
                           Nanoseconds horizon, const Progress& progress) {
    JudgedModel::Figures figures;
    const bool own = model.world == log.played;
    if (!own) {
        ComparisonOptions options;
        options.seed = log.seed;
        options.progress = [&](std::span<const ComparedRollout>, double share) {
            return !progress || progress(share / 2);
        };
        figures.compared =
            compare(*model.world, requests, options).map([](const Comparison& comparison) { return comparison.all; });
    }
    figures.evaluated = evaluatedModel(log, model, horizon, own ? progress : halfOf(progress, 0.5));
    return figures;
}

}  // namespace mrose
