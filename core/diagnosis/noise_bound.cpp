#include "diagnosis/noise_bound.h"

#include <algorithm>
#include <cmath>

#include "geometry/angle.h"
#include "geometry/normal_distribution.h"

namespace mrose {
namespace {

using At = DivergenceBound::At;

/// How far runs are from their mean, [run][step].
std::vector<std::vector<At>> deviationsOf(const LearnedModel& model, const RolloutStart& start, int runs,
                                          Nanoseconds step) {
    std::vector<RolloutStart> starts(static_cast<std::size_t>(runs), start);
    // Of all rollouts the same, so that bounds differ by what is driven alone.
    for (std::size_t run = 0; run < starts.size(); ++run) {
        starts[run].body = static_cast<std::uint32_t>(run);
        starts[run].seed = 0;
    }
    const auto mean = rollOut(*model.drawn(MotionDraw::mean), {&start, 1}, {.step = step});
    const auto drawn = rollOut(*model.drawn(MotionDraw::noisy), starts, {.step = step});
    std::vector<std::vector<At>> deviations;
    if (!mean || !drawn) return deviations;  // a period that does not divide the step: nothing was compared either
    for (const std::vector<Pose>& run : *drawn) {
        std::vector<At>& of = deviations.emplace_back();
        for (std::size_t k = 0; k < run.size(); ++k) {
            const Pose& middle = mean->front()[k];
            of.push_back(
                {length(position(run[k]) - position(middle)), std::abs(wrapAngle(run[k].heading - middle.heading))});
        }
    }
    return deviations;
}

/// Root mean square of all runs and the floor, by step.
std::vector<At> usual(const std::vector<std::vector<At>>& deviations, const At& floor) {
    std::vector<At> sums(deviations.front().size());
    for (const std::vector<At>& run : deviations)
        for (std::size_t k = 0; k < run.size(); ++k) {
            sums[k].position += run[k].position * run[k].position;
            sums[k].heading += run[k].heading * run[k].heading;
        }
    const auto count = static_cast<double>(deviations.size());
    for (At& sum : sums)
        sum = {std::sqrt(sum.position / count + floor.position * floor.position),
               std::sqrt(sum.heading / count + floor.heading * floor.heading)};
    return sums;
}

/// The most times the usual that a run is beyond at `instants` successive steps.
double timesHeld(const std::vector<At>& run, const std::vector<At>& usual, std::size_t instants) {
    std::vector<double> times;
    for (std::size_t k = 0; k < run.size(); ++k) {
        const auto ratio = [](double off, double by) { return by > 0 ? off / by : 0; };
        times.push_back(std::max(ratio(run[k].position, usual[k].position), ratio(run[k].heading, usual[k].heading)));
    }
    double most = 0;
    for (std::size_t k = 0; k + instants <= times.size(); ++k)
        most = std::max(most, *std::min_element(times.begin() + static_cast<std::ptrdiff_t>(k),
                                                times.begin() + static_cast<std::ptrdiff_t>(k + instants)));
    return most;
}

/// What so large a share of these is above, were their logarithms normal.
double exceededBy(double share, const std::vector<double>& values) {
    double sum = 0, squares = 0, count = 0;
    for (const double value : values) {
        if (!(value > 0)) continue;
        const double l = logarithm(value);
        sum += l, squares += l * l, ++count;
    }
    if (count < 2) return 0;
    const double mean = sum / count, variance = std::max(0.0, (squares - sum * mean) / (count - 1));
    return exponential(mean + std::sqrt(variance) * normalQuantile(1 - share));
}

}  // namespace

DivergenceBound noiseBound(const LearnedModel& model, const Trajectory& trajectory, const ComparedRollout& rollout,
                           Nanoseconds step, Nanoseconds held, const NoiseBoundOptions& options) {
    const RolloutStart start{&trajectory,
                             rollout.real.start,
                             rollout.real.measuredPose,
                             rollout.real.measuredVelocity,
                             static_cast<int>(rollout.simulated.size()),
                             rollout.tracked};
    DivergenceBound bound;
    bound.held = held;
    bound.source = BoundSource::noise;
    const std::vector<std::vector<At>> deviations = deviationsOf(model, start, options.runs, step);
    if (start.steps == 0 || deviations.empty()) return bound;
    const std::vector<At> normally = usual(deviations, options.floor);
    std::vector<double> times;
    for (const std::vector<At>& run : deviations)
        times.push_back(timesHeld(run, normally, static_cast<std::size_t>((held + step - 1) / step) + 1));
    const double factor = exceededBy(options.leaving, times);
    for (const At& at : normally)
        bound.bySteps.push_back({std::max(options.least.position, factor * at.position),
                                 std::max(options.least.heading, factor * at.heading)});
    return bound;
}

}  // namespace mrose
