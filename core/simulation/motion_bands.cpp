#include "simulation/motion_bands.h"

#include <algorithm>

#include "motion/learned_model.h"
#include "motion/noisy_model.h"
#include "scenario/carry_over.h"

namespace mrose {
namespace {

/// The same model with what its network knows of its noise; null: it is that already.
std::shared_ptr<const MotionModel> withLearnedNoise(const MotionModel& model) {
    const auto* const learned = dynamic_cast<const LearnedModel*>(&model);
    const bool meanAlone = learned != nullptr && learned->draw() == MotionDraw::mean && learned->network().noise;
    return meanAlone ? learned->drawn(MotionDraw::noisy) : nullptr;
}

bool drawsNoise(const MotionModel& model) {
    const LearnedModel* const learned = learnedModel(model);
    return !noiseOf(model).none() || (learned != nullptr && learned->draw() == MotionDraw::noisy);
}

}  // namespace

std::int64_t MotionBands::last() const {
    std::size_t most = 0;
    for (const std::vector<PoseRegion>& robot : regions) most = std::max(most, robot.size());
    return tick + (static_cast<std::int64_t>(most) - 1) * every;
}

const PoseRegion* MotionBands::at(std::size_t robot, std::int64_t at) const {
    if (robot >= regions.size() || at < tick) return nullptr;
    const auto instant = static_cast<std::size_t>((at - tick) / every);
    return instant < regions[robot].size() ? &regions[robot][instant] : nullptr;
}

std::span<const PoseRegion> MotionBands::between(std::size_t robot, std::int64_t from, std::int64_t to) const {
    if (robot >= regions.size() || to < tick || to < from) return {};
    const std::size_t size = regions[robot].size();
    const auto first = std::min(size, static_cast<std::size_t>(std::max<std::int64_t>(0, from - tick) / every));
    const auto end = std::min(size, static_cast<std::size_t>((to - tick) / every) + 1);
    return std::span(regions[robot]).subspan(first, end - first);
}

MotionSampler::MotionSampler(std::shared_ptr<const Scenario> scenario, std::vector<bool> deciding)
    : scenario_(std::move(scenario)), drawn_(scenario_) {
    const Scene& scene = scenario_->scene();
    std::vector<std::shared_ptr<const MotionModel>> models = scene.models;
    bool other = false;
    for (std::shared_ptr<const MotionModel>& model : models)
        if (auto noisy = withLearnedNoise(*model)) {
            model = std::move(noisy);
            other = true;
        }
    for (std::uint32_t robot = 0; robot < scene.robots.size(); ++robot) {
        noisy_.push_back(drawsNoise(*models[scene.robots[robot].model]));
        const bool decides = robot < deciding.size() && deciding[robot];
        allHold_ = allHold_ && !decides;
        if (!decides) holding_.push_back({robot, {}});
    }
    if (!other) return;
    ScenarioParts parts = scenario_->parts();
    parts.scene.models = std::move(models);
    drawn_ = std::make_shared<const Scenario>(std::move(parts));
}

bool MotionSampler::knowsAnyNoise() const { return std::find(noisy_.begin(), noisy_.end(), true) != noisy_.end(); }

WorldState MotionSampler::begin(const WorldState& state, std::uint64_t seed) const {
    WorldState sample = drawn_ == scenario_ ? state : carriedOver(*scenario_, state, *drawn_);
    sample.seed = seed;
    return sample;
}

void MotionSampler::step(const Scenario& in, WorldState& state, StepBuffers& buffers) const {
    mrose::step(in, state, buffers, allHold_ ? Overrides{{}, false} : Overrides{holding_, true});
}

std::optional<MotionBands> MotionSampler::bands(const WorldState& state, const Options& options,
                                                const GoesOn& goesOn) const {
    const std::int64_t every = std::max<std::int64_t>(1, scenario_->scene().ticksOf(options.step));
    const auto instants = static_cast<std::size_t>(scenario_->scene().ticksOf(options.ahead) / every) + 1;
    const std::size_t robots = state.robots.size();
    // Of each robot and instant all samples.
    std::vector<Pose> poses, around;
    const auto runs = static_cast<std::size_t>(options.samples);
    poses.resize(robots * instants * runs);
    around.resize(robots * instants);
    StepBuffers buffers;
    const auto go = [&](const Scenario& in, WorldState run, auto keep) {
        for (std::size_t instant = 0; instant < instants; ++instant) {
            for (std::size_t robot = 0; robot < robots; ++robot)
                keep(robot * instants + instant, run.robots[robot].pose);
            if (!goesOn()) return false;
            for (std::int64_t tick = 0; tick < every && instant + 1 < instants; ++tick) step(in, run, buffers);
        }
        return true;
    };
    if (!go(*scenario_, state, [&](std::size_t place, const Pose& pose) { around[place] = pose; })) return std::nullopt;
    for (std::size_t k = 0; k < runs; ++k)
        if (!go(*drawn_, begin(state, options.seed + k),
                [&](std::size_t place, const Pose& pose) { poses[place * runs + k] = pose; }))
            return std::nullopt;
    MotionBands bands{state.tick, every, {}};
    bands.regions.resize(robots);
    for (std::size_t robot = 0; robot < robots; ++robot)
        for (std::size_t instant = 0; noisy_[robot] && instant < instants; ++instant) {
            const std::size_t place = robot * instants + instant;
            bands.regions[robot].push_back(regionOf(std::span(poses).subspan(place * runs, runs), around[place]));
        }
    return bands;
}

}  // namespace mrose
