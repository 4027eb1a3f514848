#include "identification/familiar_driving.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "motion/driving_reader.h"

namespace mrose {
namespace {

using Driving = FamiliarDriving::Driving;
using Quantity = NetworkInput::Quantity;

/// Nothing nearer than this is called far, in units of the scales: of logs that repeat one command.
constexpr double leastUnfamiliar = 0.05;

/// The newest four periods of what the network reads of a channel.
FamiliarDriving::Channel describedPart(const MotionNetwork& network, Quantity quantity) {
    FamiliarDriving::Channel channel;
    channel.newest = std::numeric_limits<double>::infinity();
    for (const NetworkInput& input : network.inputs) {
        if (input.quantity != quantity) continue;
        channel.newest = std::min(channel.newest, input.newest);
        channel.oldest = std::max(channel.oldest, input.oldest);
    }
    const double longest = 4 * toSeconds(network.period);
    channel.oldest = std::min(channel.oldest, channel.newest + longest);
    return channel;
}

/// The standard deviation of what is commanded now. What hardly changes is measured by its size.
double scaleOf(const std::vector<Driving>& all, std::size_t number) {
    double sum = 0, squares = 0, most = 0;
    for (const Driving& driving : all) {
        sum += driving[number];
        squares += driving[number] * driving[number];
        most = std::max(most, std::abs(driving[number]));
    }
    const double mean = sum / double(all.size());
    const double deviation = std::sqrt(std::max(0.0, squares / double(all.size()) - mean * mean));
    return std::max({deviation, most / 10, 0.001});
}

double squared(const Driving& a, const Driving& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

/// To thousandths of a scale: files stay short.
Driving rounded(Driving driving) {
    for (double& number : driving) number = std::nearbyint(1000 * number) / 1000;
    return driving;
}

/// Farthest-first traversal (Gonzalez 1985): within twice the least radius with which so many balls cover all patterns.
std::vector<Driving> prototypesOf(const std::vector<Driving>& patterns) {
    Driving middle{};
    for (const Driving& pattern : patterns)
        for (std::size_t i = 0; i < middle.size(); ++i) middle[i] += pattern[i] / double(patterns.size());
    const auto nearer = [&](const Driving& a, const Driving& b) { return squared(a, middle) < squared(b, middle); };
    std::size_t next = std::size_t(std::min_element(patterns.begin(), patterns.end(), nearer) - patterns.begin());
    std::vector<double> distances(patterns.size(), std::numeric_limits<double>::infinity());
    std::vector<Driving> prototypes;
    while (prototypes.size() < FamiliarDriving::mostPrototypes) {
        prototypes.push_back(rounded(patterns[next]));
        for (std::size_t p = 0; p < patterns.size(); ++p)
            distances[p] = std::min(distances[p], squared(patterns[p], prototypes.back()));
        next = std::size_t(std::max_element(distances.begin(), distances.end()) - distances.begin());
        if (distances[next] <= leastUnfamiliar * leastUnfamiliar) break;
    }
    return prototypes;
}

/// Of the patterns of each fold in turn, from prototypes that were made without it; ascending.
std::vector<double> heldOutDistances(const MotionSamples& samples, const std::vector<Driving>& all,
                                     const FamiliarDriving& channels, MotionNetwork::Form form) {
    std::vector<double> distances;
    for (int fold = 0; fold < samples.folds; ++fold) {
        std::vector<Driving> learned, heldOut;
        for (const SampleRun& run : samples.runs) {
            const auto of = std::span(all).subspan(run.first, run.count);
            const auto known = of.subspan(run.firstLearned(fold));
            learned.insert(learned.end(), known.begin(), known.end());
            if (run.fold == fold) heldOut.insert(heldOut.end(), of.begin(), of.end());
        }
        if (learned.empty() || heldOut.empty()) continue;
        FamiliarDriving others = channels;
        others.prototypes = prototypesOf(learned);
        const DrivingReader reader(form, std::move(others));
        for (const Driving& driving : heldOut) distances.push_back(reader.distance(driving));
    }
    std::sort(distances.begin(), distances.end());
    return distances;
}

}  // namespace

FamiliarDriving describedChannels(const MotionNetwork& network) {
    FamiliarDriving channels;
    channels.v = describedPart(network, Quantity::commandV);
    channels.w = describedPart(network, Quantity::commandW);
    return channels;
}

std::optional<FamiliarDriving> familiarDriving(std::span<const Log> logs, const MotionNetwork& blueprint,
                                               const SampleOptions& sampling) {
    FamiliarDriving familiar = describedChannels(blueprint);
    if (familiar.v.oldest <= familiar.v.newest || familiar.w.oldest <= familiar.w.newest) return std::nullopt;
    const DrivingReader reader(blueprint.form, familiar);
    MotionNetwork raw = reader.raw();
    raw.robots = blueprint.robots;
    const auto samples = motionSamples(logs, raw, sampling);
    if (!samples) return std::nullopt;
    std::vector<Driving> all;
    for (std::size_t s = 0; s < samples->samples.size(); ++s) all.push_back(reader.driving(samples->inputsOf(s)));
    familiar.v.scale = scaleOf(all, 2);
    familiar.w.scale = scaleOf(all, 3);
    for (Driving& driving : all)
        for (std::size_t i = 0; i < driving.size(); ++i) driving[i] /= i % 2 == 0 ? familiar.v.scale : familiar.w.scale;
    const std::vector<double> distances = heldOutDistances(*samples, all, familiar, blueprint.form);
    if (distances.empty()) return std::nullopt;
    familiar.periods = static_cast<std::int64_t>(distances.size());
    std::size_t share = 10;
    for (double& distance : familiar.distances) {
        distance = std::max(leastUnfamiliar, distances[distances.size() - 1 - distances.size() / share]);
        share *= 10;
    }
    familiar.prototypes = prototypesOf(all);
    return familiar;
}

}  // namespace mrose
