#include "diagnosis/compared_divergences.h"

#include <algorithm>
#include <mutex>

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

/// Null: it moves by no network with held-out errors.
const MotionNetwork::HeldOut* heldOutOf(const LogWorld& world, std::size_t robot) {
    const MotionNetwork* const network = networkOf(world, robot);
    return network != nullptr && network->heldOut.windows > 0 ? &network->heldOut : nullptr;
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

bool knowsHeldOut(const LogWorld& world) {
    for (std::size_t robot = 0; robot < world.robots().size(); ++robot)
        if (heldOutOf(world, robot) != nullptr) return true;
    return false;
}

DivergenceBound boundFor(const LogWorld& world, const ComparedRollout& rollout, const DivergenceOptions& options,
                         Nanoseconds step) {
    const MotionNetwork::HeldOut* const heldOut = options.fromHeldOut ? heldOutOf(world, rollout.robot) : nullptr;
    if (heldOut == nullptr) return options.bound;
    DivergenceBound bound = heldOutBound(*heldOut, rollout, step);
    bound.held = options.bound.held;
    return bound;
}

Expected<ComparedDivergences> divergencesOf(const LogWorld& world, const Comparison& comparison,
                                            const DivergenceOptions& options) {
    const Nanoseconds step = comparison.log.options.step;
    ComparedDivergences found;
    found.bound = options.bound;
    found.fromHeldOut = options.fromHeldOut && knowsHeldOut(world);
    std::vector<DivergenceBound> bounds;
    for (std::size_t i = 0; i < comparison.rollouts.size(); ++i) {
        const ComparedRollout& rollout = comparison.rollouts[i];
        if (rollout.simulated.empty()) continue;
        DivergenceBound bound = boundFor(world, rollout, options, step);
        const auto divergence = firstDivergence(rollout, step, bound);
        if (!divergence) continue;
        found.rollouts.push_back({i, *divergence, std::nullopt});
        bounds.push_back(std::move(bound));
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
