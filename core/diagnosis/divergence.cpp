#include "diagnosis/divergence.h"

#include <algorithm>
#include <cmath>

#include "geometry/point.h"

namespace mrose {
namespace {

constexpr double timesTypical = 3;
/// Between the instants over which path and rotation are summed: a wobble inflates shorter ones.
constexpr Nanoseconds travelStep = 500'000'000;

}  // namespace

DivergenceRule::State DivergenceRule::add(Nanoseconds time, const PoseError& error, const DivergenceBound::At& bound) {
    if (error.position <= bound.position && error.heading <= bound.heading) {
        beyond_ = false;
        return State::within;
    }
    if (!beyond_) since_ = time;
    beyond_ = true;
    return std::abs(time - since_) >= held_ ? State::left : State::beyond;
}

std::optional<Divergence> firstDivergence(const ComparedRollout& rollout, Nanoseconds step,
                                          const DivergenceBound& bound) {
    const WindowErrors& errors = rollout.errors;
    DivergenceRule rule(bound.held);
    Nanoseconds within = 0;
    for (std::size_t k = 0; k < errors.position.size(); ++k) {
        const Nanoseconds time = static_cast<Nanoseconds>(k + 1) * step;
        if (!std::isfinite(errors.position[k]) || !std::isfinite(errors.heading[k])) continue;
        const auto state = rule.add(time, {errors.position[k], errors.heading[k]}, bound.at(k));
        if (state == DivergenceRule::State::within) within = time;
        if (state != DivergenceRule::State::left) continue;
        const std::size_t first = static_cast<std::size_t>(rule.since() / step) - 1;
        const double position = errors.position[first], heading = errors.heading[first];
        const DivergenceBound::At& at = bound.at(first);
        return Divergence{rule.since(),
                          within,
                          position,
                          heading,
                          at,
                          position > at.position,
                          heading > at.heading,
                          rule.since() - within > step};
    }
    return std::nullopt;
}

DivergenceBound heldOutBound(const MotionNetwork::HeldOut& heldOut, const ComparedRollout& rollout, Nanoseconds step,
                             const DivergenceBound::At& least) {
    const double p = heldOut.position / 100, hd = heldOut.heading / 100;
    const std::size_t stride = static_cast<std::size_t>(std::max<Nanoseconds>(1, travelStep / step));
    const std::vector<Pose>& truth = rollout.real.truth;
    DivergenceBound bound;
    double path = 0, rotation = 0;
    const auto travel = [](const Pose& a, const Pose& b) {
        const double distance = length({b.x - a.x, b.y - a.y});
        return std::isfinite(distance) ? std::pair{distance, std::abs(b.heading - a.heading)} : std::pair{0.0, 0.0};
    };
    auto jump = rollout.jumps.begin();
    for (std::size_t k = 1, from = 0; k < truth.size(); ++k) {
        if (jump != rollout.jumps.end() && *jump == k) {  // the robot did not drive that
            const auto [distance, turn] = travel(truth[from], truth[k - 1]);
            path += distance;
            rotation += turn;
            from = k;
            ++jump;
        }
        const auto [distance, turn] = travel(truth[from], truth[k]);
        bound.bySteps.push_back(
            {std::max(least.position, timesTypical * 2 * p * (path + distance)),
             std::max({least.heading, timesTypical * 2 * p * 2, timesTypical * 2 * hd * (rotation + turn)})});
        if (!std::isfinite(truth[k].x) || (std::isfinite(truth[from].x) && k - from < stride)) continue;
        path += distance;
        rotation += turn;
        from = k;
    }
    return bound;
}

}  // namespace mrose
