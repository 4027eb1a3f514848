#include "diagnosis/divergence.h"

#include <algorithm>
#include <cmath>

namespace mrose {
namespace {

constexpr double timesTypical = 3;
/// Between the instants over which path and rotation are summed: a wobble inflates shorter ones.
constexpr Nanoseconds travelStep = 500'000'000;

bool isKnown(const WindowErrors& errors, std::size_t k) {
    return std::isfinite(errors.position[k]) && std::isfinite(errors.heading[k]);
}

bool isBeyond(const WindowErrors& errors, std::size_t k, const DivergenceBound::At& bound) {
    return errors.position[k] > bound.position || errors.heading[k] > bound.heading;
}

}  // namespace

std::optional<Divergence> firstDivergence(const ComparedRollout& rollout, Nanoseconds step,
                                          const DivergenceBound& bound) {
    const WindowErrors& errors = rollout.errors;
    const auto timeOf = [&](std::size_t k) { return static_cast<Nanoseconds>(k + 1) * step; };
    std::optional<std::size_t> first;
    Nanoseconds within = 0;
    for (std::size_t k = 0; k < errors.position.size(); ++k) {
        if (!isKnown(errors, k)) continue;
        if (!isBeyond(errors, k, bound.at(k))) {
            first.reset();
            within = timeOf(k);
            continue;
        }
        if (!first) first = k;
        if (timeOf(k) - timeOf(*first) < bound.held) continue;
        const double position = errors.position[*first], heading = errors.heading[*first];
        const DivergenceBound::At& at = bound.at(*first);
        return Divergence{timeOf(*first),
                          within,
                          position,
                          heading,
                          at,
                          position > at.position,
                          heading > at.heading,
                          timeOf(*first) - within > step};
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
        const double distance = std::hypot(b.x - a.x, b.y - a.y);
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
