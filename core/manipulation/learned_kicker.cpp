#include "manipulation/learned_kicker.h"

#include <algorithm>
#include <numbers>

namespace mrose {
namespace {

/// Draws of a kick: parts of its channel beside the manipulator's number.
enum KickDraw : std::uint32_t { whichDelay = 1, delayNormal, whichDeparture, departureNormal, whetherHit };

NoiseKey partOf(NoiseKey key, KickDraw draw) {
    key.channel += static_cast<std::uint32_t>(draw) << 20;
    return key;
}

constexpr double longestKickDelay = 2, fastestKick = 100;  // s, m/s: whatever weights a file has

/// NaN is `least`.
double within(double least, double value, double most) { return value > least ? std::min(value, most) : least; }

}  // namespace

LearnedKicker::LearnedKicker(KickNetwork network)
    : network_(std::move(network)),
      delay_(withOutputs(network_.learned.regressor, 0, network_.delayOutputs())),
      departure_(withOutputs(network_.learned.regressor, network_.delayOutputs(), network_.departureForm().outputs())) {
}

bool LearnedKicker::inReach(const Point& ball_B) const {
    const KickNetwork::Range &x = network_.seen[3], &y = network_.seen[4];
    return ball_B.x >= x.least && ball_B.x <= x.most && ball_B.y >= y.least && ball_B.y <= y.most;
}

std::vector<double> LearnedKicker::evaluate(const RegressorInference& part, int first, const KickState& state) const {
    std::array<float, KickState::inputs> row;
    const std::array<double, KickState::inputs> values = state.values();
    for (std::size_t i = 0; i < row.size(); ++i) {
        const NetworkVariable& input = network_.learned.inputs[i];
        const double value = std::clamp(values[i], network_.seen[i].least, network_.seen[i].most);
        row[i] = static_cast<float>((value - input.mean) / input.scale);
    }
    std::array<float, LearnedNetwork::maxOutputs> outputs;
    part.one(row.data(), outputs.data());
    std::vector<double> described(static_cast<std::size_t>(part.outputs()));
    for (std::size_t i = 0; i < described.size(); ++i) {
        const NetworkVariable& output = network_.learned.outputs[static_cast<std::size_t>(first) + i];
        described[i] = output.mean + output.scale * static_cast<double>(outputs[i]);
    }
    return described;
}

ReadingDistribution LearnedKicker::delay(const KickState& state) const {
    std::vector<double> values = evaluate(delay_, 0, state);
    values.insert(values.begin(), 0);  // it is asked of kicks alone
    return ReadingDistribution::of(network_.delayForm(), values, {});
}

ReadingDistribution LearnedKicker::departure(const KickState& state) const {
    return ReadingDistribution::of(network_.departureForm(), evaluate(departure_, network_.delayOutputs(), state), {});
}

Nanoseconds LearnedKicker::drawDelay(const KickState& state, const NoiseKey& key) const {
    ReadingDraw draw;
    draw.which = uniformNoise(partOf(key, whichDelay));
    draw.error[0] = normalNoise(partOf(key, delayNormal));
    return fromSeconds(within(0, delay(state).error(draw)[0], longestKickDelay));
}

KickDeparture LearnedKicker::drawDeparture(const KickState& state, const NoiseKey& key) const {
    const ReadingDistribution predicted = departure(state);
    const NoisePair normal = normalPair(partOf(key, departureNormal));
    ReadingDraw draw;
    draw.reported = normalNoise(partOf(key, whetherHit));
    draw.which = uniformNoise(partOf(key, whichDeparture));
    draw.error = {normal.first, normal.second, 0};
    const ReadingError drawn = predicted.error(draw);
    return {predicted.reports(draw), within(0, drawn[0], fastestKick),
            network_.direction + within(-std::numbers::pi, drawn[1], std::numbers::pi)};
}

}  // namespace mrose
