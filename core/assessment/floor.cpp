#include "assessment/floor.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <tuple>

#include "assessment/metrics.h"

namespace mrose {
namespace {

constexpr Nanoseconds integralStep = 100'000'000;  // between samples of the command integrals

/// Integrals of v (m) and w (rad), sampled from the lead's begin to the stretch's end.
struct Integral {
    double path = 0, rotation = 0;
};
using Integrals = std::vector<Integral>;

Integrals commandIntegrals(const Trajectory& trajectory, Nanoseconds from, Nanoseconds to) {
    const auto& commands = trajectory.commands;
    const auto later = std::upper_bound(commands.begin(), commands.end(), from,
                                        [](Nanoseconds t, const StampedCommand& c) { return t < c.time; });
    auto next = static_cast<std::size_t>(later - commands.begin());
    Command inForce;
    if (next > 0 || (trajectory.steady && !commands.empty())) inForce = commands[next > 0 ? next - 1 : 0].command;
    Integrals integrals;
    Integral sum;
    const auto advance = [&](Nanoseconds since, Nanoseconds until) {
        sum.path += toSeconds(until - since) * inForce.v;
        sum.rotation += toSeconds(until - since) * inForce.w;
    };
    Nanoseconds now = from;
    for (Nanoseconds sample = from + integralStep; sample <= to; sample += integralStep) {
        for (; next < commands.size() && commands[next].time <= sample; ++next) {
            advance(now, commands[next].time);
            now = commands[next].time;
            inForce = commands[next].command;
        }
        advance(now, sample);
        now = sample;
        integrals.push_back(sum);
    }
    return integrals;
}

/// The largest difference in parts of the bounds; above 1 it may be any that is.
double difference(const Integrals& a, const Integrals& b, const FloorOptions& options) {
    double largest = 0;
    // The ends differ most as a rule, so that most pairs are settled by the first comparison.
    for (std::size_t i = a.size(); i-- > 0 && largest <= 1;)
        largest = std::max({largest, std::abs(a[i].path - b[i].path) / options.pathBound,
                            std::abs(a[i].rotation - b[i].rotation) / options.rotationBound});
    return largest;
}

struct Candidate {
    double difference;
    std::uint32_t first, second;
};

bool overlap(const Window& a, const Window& b, Nanoseconds length) {
    return a.trajectory == b.trajectory && std::abs(a.start - b.start) < length;
}

/// Stretches by their total commanded rotation, so that those that can match lie close together.
std::vector<std::uint32_t> byRotation(const std::vector<Integrals>& integrals) {
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < integrals.size(); ++i)
        if (!integrals[i].empty()) order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return integrals[a].back().rotation < integrals[b].back().rotation;
    });
    return order;
}

std::vector<Candidate> matches(const std::vector<Window>& stretches, const std::vector<Integrals>& integrals,
                               Nanoseconds length, const FloorOptions& options) {
    const std::vector<std::uint32_t> order = byRotation(integrals);
    std::vector<Candidate> candidates;
    for (std::size_t a = 0; a < order.size(); ++a)
        for (std::size_t b = a + 1; b < order.size(); ++b) {
            const auto [i, k] = std::minmax(order[a], order[b]);
            if (integrals[order[b]].back().rotation - integrals[order[a]].back().rotation > options.rotationBound)
                break;
            if (integrals[i].size() != integrals[k].size() || overlap(stretches[i], stretches[k], length)) continue;
            const double apart = difference(integrals[i], integrals[k], options);
            if (apart <= 1) candidates.push_back({apart, i, k});
        }
    return candidates;
}

/// Best match first, leaving out what shares an instant with a pair already taken.
std::vector<Candidate> withoutSharing(std::vector<Candidate> candidates, const std::vector<Window>& stretches,
                                      Nanoseconds length) {
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
        return std::tie(a.difference, a.first, a.second) < std::tie(b.difference, b.first, b.second);
    });
    std::vector<char> taken(stretches.size(), 0);
    std::vector<Candidate> chosen;
    for (const Candidate& candidate : candidates) {
        if (taken[candidate.first] || taken[candidate.second]) continue;
        chosen.push_back(candidate);
        for (std::size_t i = 0; i < stretches.size(); ++i)
            if (overlap(stretches[i], stretches[candidate.first], length) ||
                overlap(stretches[i], stretches[candidate.second], length))
                taken[i] = 1;
    }
    return chosen;
}

std::vector<Pose> seenFromStart(const std::vector<Pose>& truth) {
    std::vector<Pose> poses;
    for (const Pose& pose : truth) poses.push_back(relative(truth.front(), pose));
    return poses;
}

FloorPair compare(const Window& a, const Window& b, double commandDifference) {
    const std::vector<Pose> other = seenFromStart(b.truth);
    const WindowErrors errors = windowErrors(seenFromStart(a.truth), std::span(other).subspan(1));
    FloorPair pair;
    pair.first = a;
    pair.second = b;
    pair.commandDifference = commandDifference;
    pair.positionMean = errors.positionMean;
    pair.positionFinal = errors.positionFinal;
    pair.headingMean = errors.headingMean;
    pair.headingFinal = errors.headingFinal;
    pair.path = (a.path + b.path) / 2;
    pair.rotation = (a.rotation + b.rotation) / 2;
    return pair;
}

void addRobot(const Log& log, std::size_t robot, const WindowOptions& windows, Floor& floor) {
    std::vector<Window> stretches = denseStretches(log, robot, windows, floor.options.spacing);
    std::erase_if(stretches, [&](const Window& w) {
        return w.rotation < floor.options.leastTurnRate * toSeconds(w.steps() * windows.step);
    });
    std::vector<Integrals> integrals;
    for (const Window& w : stretches) {
        floor.horizon = std::max(floor.horizon, w.steps() * windows.step);
        integrals.push_back(commandIntegrals(log.robots[robot].trajectories[w.trajectory], w.start - floor.options.lead,
                                             w.start + w.steps() * windows.step));
    }
    const auto candidates = matches(stretches, integrals, windows.horizon, floor.options);
    floor.tried += stretches.size();
    floor.candidates += candidates.size();
    for (const Candidate& c : withoutSharing(candidates, stretches, windows.horizon))
        floor.pairs.push_back(compare(stretches[c.first], stretches[c.second], c.difference));
}

}  // namespace

Floor findFloor(const Log& log, const std::vector<std::string>& robots, const WindowOptions& windowOptions,
                const FloorOptions& options) {
    WindowOptions windows = windowOptions;
    if (options.horizon > 0) windows.horizon = options.horizon;
    Floor floor;
    floor.options = options;
    for (std::size_t i = 0; i < log.robots.size(); ++i)
        if (robots.empty() || std::find(robots.begin(), robots.end(), log.robots[i].robot) != robots.end())
            addRobot(log, i, windows, floor);
    ErrorSums sums;
    for (const FloorPair& pair : floor.pairs) sums.add(pair.positionMean, pair.headingMean, pair.path, pair.rotation);
    floor.spread = sums.percentErrors();
    floor.best = {floor.spread.p / std::numbers::sqrt2, floor.spread.hd / std::numbers::sqrt2};
    return floor;
}

}  // namespace mrose
