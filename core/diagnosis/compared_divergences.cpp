#include "diagnosis/compared_divergences.h"

#include <algorithm>
#include <mutex>

#include "diagnosis/noise_bound.h"
#include "learning/parallel_for.h"

namespace mrose {
namespace {

/// One number from several works at once.
class SharedProgress {
public:
    SharedProgress(const Progress& progress, std::size_t works) : progress_(progress), shares_(works) {}

    bool set(std::size_t work, double share) {
        const std::scoped_lock lock(mutex_);
        shares_[work] = share;
        double sum = 0;
        for (const double s : shares_) sum += s;
        goesOn_ = goesOn_ && (!progress_ || progress_(sum / static_cast<double>(shares_.size())));
        return goesOn_;
    }

private:
    const Progress& progress_;
    std::mutex mutex_;
    std::vector<double> shares_;
    bool goesOn_ = true;
};

ComparedDivergences::Summary summaryOf(const Comparison& comparison, const ComparedDivergences& found,
                                       std::optional<std::size_t> robot) {
    ComparedDivergences::Summary summary;
    std::vector<double> times;
    for (const ComparedRollout& rollout : comparison.rollouts)
        summary.rollouts += !rollout.simulated.empty() && (!robot || rollout.robot == *robot) ? 1 : 0;
    for (const RolloutDivergence& diverging : found.rollouts)
        if (!robot || comparison.rollouts[diverging.rollout].robot == *robot)
            times.push_back(toSeconds(diverging.divergence.time));
    summary.diverging = times.size();
    summary.medianTime = quantile(times, 0.5);
    return summary;
}

BoundSource sourceOf(const MotionNetwork* network) {
    if (network == nullptr) return BoundSource::constant;
    if (network->noise) return BoundSource::noise;
    return network->heldOut.windows > 0 ? BoundSource::heldOut : BoundSource::constant;
}

/// By rollout; nullopt of those that were not simulated.
std::vector<std::optional<DivergenceBound>> boundsOf(const LogWorld& world, const Comparison& comparison,
                                                     const DivergenceOptions& options) {
    std::vector<std::optional<DivergenceBound>> bounds(comparison.rollouts.size());
    parallelFor(bounds.size(), [&](std::size_t i) {
        const ComparedRollout& rollout = comparison.rollouts[i];
        if (rollout.simulated.empty()) return;
        if (options.fromNetwork)
            bounds[i] = networkBound(world, comparison.requests[rollout.request], rollout, comparison.log.options.step,
                                     options.bound.held);
        if (!bounds[i]) bounds[i] = options.bound;
    });
    return bounds;
}

}  // namespace

const RolloutDivergence* ComparedDivergences::of(std::size_t rollout) const {
    const auto found = std::find_if(rollouts.begin(), rollouts.end(),
                                    [&](const RolloutDivergence& c) { return c.rollout == rollout; });
    return found == rollouts.end() ? nullptr : &*found;
}

std::vector<std::size_t> worstOf(const Comparison& comparison, const ComparedDivergences& found, std::size_t most) {
    std::vector<std::size_t> order;
    for (const std::size_t rollout : worstFirst(comparison))
        for (std::size_t i = 0; i < found.rollouts.size(); ++i)
            if (found.rollouts[i].rollout == rollout) order.push_back(i);
    const bool single = comparison.requests.size() == 1 && most > 0;
    if (!single && order.size() > most) order.resize(most);
    return order;
}

BoundSource boundSource(const LogWorld& world) {
    BoundSource most = BoundSource::constant;
    for (std::size_t robot = 0; robot < world.robots().size(); ++robot)
        most = std::max(most, sourceOf(networkOf(world, robot)));
    return most;
}

BoundSource leastBoundSource(const LogWorld& world) {
    BoundSource least = BoundSource::noise;
    for (std::size_t robot = 0; robot < world.robots().size(); ++robot)
        least = std::min(least, sourceOf(networkOf(world, robot)));
    return least;
}

std::optional<DivergenceBound> networkBound(const LogWorld& world, const RolloutRequest& request,
                                            const ComparedRollout& rollout, Nanoseconds step, Nanoseconds held) {
    const MotionNetwork* const network = networkOf(world, rollout.robot);
    const BoundSource source = sourceOf(network);
    if (source == BoundSource::constant) return std::nullopt;
    if (source == BoundSource::noise) {
        const MotionModel& model = world.parts().scene.modelOf(world.robots()[rollout.robot].body);
        return noiseBound(*learnedModel(model), world.trajectory(request.session, rollout.robot), rollout, step, held);
    }
    DivergenceBound bound = heldOutBound(network->heldOut, rollout, step);
    bound.held = held;
    bound.source = source;
    return bound;
}

Expected<ComparedDivergences> divergencesOf(const LogWorld& world, const Comparison& comparison,
                                            const DivergenceOptions& options) {
    const Nanoseconds step = comparison.log.options.step;
    ComparedDivergences found;
    found.bound = options.bound;
    if (options.fromNetwork) {
        found.source = boundSource(world);
        found.ofAll = found.source == leastBoundSource(world);
    }
    const std::vector<std::optional<DivergenceBound>> all = boundsOf(world, comparison, options);
    std::vector<DivergenceBound> bounds;
    for (std::size_t i = 0; i < comparison.rollouts.size(); ++i) {
        const ComparedRollout& rollout = comparison.rollouts[i];
        if (rollout.simulated.empty()) continue;
        const auto divergence = firstDivergence(rollout, step, *all[i]);
        if (!divergence) continue;
        found.rollouts.push_back({i, *divergence, std::nullopt});
        bounds.push_back(*all[i]);
    }
    for (std::size_t robot = 0; robot < comparison.robots.size(); ++robot)
        found.robots.push_back(summaryOf(comparison, found, robot));
    found.all = summaryOf(comparison, found, std::nullopt);

    const std::vector<std::size_t> works = worstOf(comparison, found, options.diagnosed);
    std::vector<std::optional<Expected<Diagnosis>>> diagnoses(works.size());
    SharedProgress progress(options.progress, works.size());
    parallelFor(works.size(), [&](std::size_t i) {
        const RolloutDivergence& diverging = found.rollouts[works[i]];
        const ComparedRollout& rollout = comparison.rollouts[diverging.rollout];
        DiagnosisOptions diagnosis{.bound = bounds[works[i]], .models = options.models};
        diagnosis.seed = comparison.seed;
        diagnosis.step = step;
        diagnosis.progress = [&, i](double share) { return progress.set(i, share); };
        diagnoses[i] = diagnose(world, comparison.requests[rollout.request], rollout, diverging.divergence, diagnosis);
    });
    for (std::size_t i = 0; i < works.size(); ++i) {
        if (!*diagnoses[i]) return tl::unexpected(diagnoses[i]->error());
        found.cancelled = found.cancelled || (*diagnoses[i])->cancelled;
        found.rollouts[works[i]].diagnosis = std::move(**diagnoses[i]);
    }
    return found;
}

}  // namespace mrose
