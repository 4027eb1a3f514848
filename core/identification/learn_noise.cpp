#include "identification/learn_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "identification/held_out_part.h"
#include "identification/residual_noise_fit.h"

namespace mrose {
namespace {

/// So that they can be divided evenly, whatever was held out of them.
void numberGroups(std::vector<Log>& logs) {
    for (Log& log : logs) {
        std::set<int> groups;
        for (const RobotLog& robot : log.robots)
            for (const Trajectory& trajectory : robot.trajectories) groups.insert(trajectory.group);
        for (RobotLog& robot : log.robots)
            for (Trajectory& trajectory : robot.trajectories)
                trajectory.group = static_cast<int>(std::distance(groups.begin(), groups.find(trajectory.group)));
    }
}

Expected<std::vector<Log>> partsOf(const std::vector<Log>& logs, const HoldOut& holdOut, LogPart part) {
    std::vector<Log> parts;
    for (const Log& log : logs) {
        auto kept = partOf(log, holdOut, part);
        if (!kept) return tl::unexpected(kept.error());
        parts.push_back(std::move(*kept));
    }
    return parts;
}

/// How long each robot was tracked, s.
std::map<std::string, double> trackedTimes(const std::vector<Log>& logs) {
    std::map<std::string, double> times;
    for (const Log& log : logs)
        for (const RobotLog& robot : log.robots)
            for (const Trajectory& trajectory : robot.trajectories)
                if (!trajectory.poses.empty())
                    times[robot.robot] += toSeconds(trajectory.poses.back().time - trajectory.poses.front().time);
    return times;
}

/// The robots in noiseParts groups that were tracked about equally long; empty where there are fewer robots.
std::vector<std::set<std::string>> groupsOfRobots(const std::vector<Log>& logs) {
    const std::map<std::string, double> times = trackedTimes(logs);
    if (times.size() < noiseParts) return {};
    std::vector<std::pair<std::string, double>> longest(times.begin(), times.end());
    std::stable_sort(longest.begin(), longest.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    std::vector<std::set<std::string>> groups(noiseParts);
    std::array<double, noiseParts> sums{};
    for (const auto& [robot, time] : longest) {
        const auto least = static_cast<std::size_t>(std::min_element(sums.begin(), sums.end()) - sums.begin());
        groups[least].insert(robot);
        sums[least] += time;
    }
    return groups;
}

/// What is learned from while a part is not known, and that part.
struct Division {
    std::vector<Log> learned, rest;
    HoldOut holdOut;
};

Division dividedByRobots(const std::vector<Log>& logs, const std::set<std::string>& rest) {
    Division division{logs, logs, {}};
    const auto keep = [&](std::vector<Log>& part, bool those) {
        for (Log& log : part)
            std::erase_if(log.robots, [&](const RobotLog& robot) { return rest.contains(robot.robot) != those; });
    };
    keep(division.learned, false);
    keep(division.rest, true);
    return division;
}

Expected<Division> divided(const std::vector<Log>& logs, int part, const MotionNetwork& blueprint,
                           const NetworkTrainerOptions& options) {
    if (const auto robots = groupsOfRobots(logs); !robots.empty())
        return dividedByRobots(logs, robots[static_cast<std::size_t>(part)]);
    auto holdOut = holdOutOf(logs, 1.0 / noiseParts, part, HoldOutBy::whatSuits);
    if (!holdOut) return tl::unexpected(holdOut.error());
    if (holdOut->byTime()) {
        const int chain = options.loss == LearningLoss::rollout ? options.rolloutLength : 1;
        holdOut->guard = std::ceil(10 * toSeconds(InputReader(blueprint).lookBack() + chain * blueprint.period)) / 10;
    }
    auto learned = partsOf(logs, *holdOut, LogPart::learned), rest = partsOf(logs, *holdOut, LogPart::heldOut);
    if (!learned) return tl::unexpected(learned.error());
    if (!rest) return tl::unexpected(rest.error());
    return Division{std::move(*learned), std::move(*rest), *holdOut};
}

/// A network that does not know a part of the logs, and that part.
struct Judged {
    MotionNetwork network;
    MotionSamples unseen;
    bool cancelled = false;
};

Expected<Judged> learnWithout(int part, const std::vector<Log>& logs, const MotionNetwork& blueprint,
                              const SampleOptions& sampling, const NetworkTrainerOptions& options,
                              const NetworkProgressCallback& learns) {
    const auto division = divided(logs, part, blueprint, options);
    if (!division) return tl::unexpected(division.error());
    SampleOptions own = sampling;
    own.heldOut = division->holdOut;
    // What is left of short logs may not be enough for as many parts as the network itself is learned from.
    const auto learned = [&]() -> Expected<TrainedNetwork> {
        auto samples = motionSamples(division->learned, blueprint, own);
        if (!samples) return tl::unexpected(samples.error());
        removeTrackerOffsets(*samples);
        return trainNetwork(blueprint, *samples, options, learns);
    };
    auto trained = learned();
    for (; !trained && own.folds > leastFolds; trained = learned()) own.folds = std::max(leastFolds, own.folds / 2);
    if (!trained) return fail("", "in learning without a third of the logs, " + trained.error().cause);
    own.phases = std::min(sampling.phases, 2);
    own.folds = 1;
    own.measuredStarts = true;
    auto unseen = motionSamples(division->rest, trained->network, own);
    if (!unseen) return tl::unexpected(unseen.error());
    removeTrackerOffsets(*unseen);
    return Judged{std::move(trained->network), std::move(*unseen), trained->cancelled};
}

}  // namespace

LearnedNoise learnNoise(std::vector<Log> logs, const MotionNetwork& blueprint, const SampleOptions& sampling,
                        const NetworkTrainerOptions& options, const NetworkProgressCallback& learns,
                        const Progress& fits) {
    numberGroups(logs);
    const bool ofKnownRobots = groupsOfRobots(logs).empty();
    std::vector<Judged> all;
    for (int part = 0; part < noiseParts; ++part) {
        const auto shifted = [&](NetworkProgress p) {
            p.member += part * options.members;
            p.ofNoise = true;
            return !learns || learns(p);
        };
        auto judged = learnWithout(part, logs, blueprint, sampling, options, shifted);
        if (!judged) return {std::nullopt, judged.error().cause, false};
        if (judged->cancelled) return {std::nullopt, "cancelled", true};
        all.push_back(std::move(*judged));
    }
    std::size_t length = residualLength(all.front().unseen);
    for (const Judged& judged : all) length = std::min(length, residualLength(judged.unseen));
    if (length == 0) return {std::nullopt, "its uninterrupted pieces are too short or too few", false};
    ResidualRollouts rollouts;
    for (const Judged& judged : all) addResidualRollouts(judged.network, judged.unseen, length, rollouts);
    ResidualNoiseOptions fitting;
    fitting.seed = options.seed;
    fitting.epochs = std::min(fitting.epochs, options.epochs);
    bool cancelled = false;
    const auto watched = [&](double from, double to) {
        return [&, from, to](double share) { return !(cancelled = !mayGoOn(fits, from + (to - from) * share)); };
    };
    ResidualNoise noise = fitResidualNoise(rollouts, blueprint.period, fitting, watched(0, 0.9));
    if (!cancelled) noise.constant = fitConstantNoise(rollouts, blueprint.period, fitting, watched(0.9, 1));
    if (cancelled) return {std::nullopt, "cancelled", true};
    return {std::move(noise), {}, false, ofKnownRobots};
}

}  // namespace mrose
