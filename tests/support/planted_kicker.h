#pragma once

#include "learning/initial_weights.h"
#include "manipulation/kick_network.h"

namespace mrose {

/// A kicker that nobody learned: two members of two components each, all of whose outputs depend on all that they may,
/// around 90 ms, 3 m/s and `direction`; four kicks in five meet the ball.
inline KickNetwork plantedKicker(double direction = 0) {
    KickNetwork network;
    network.robotType = "planted";
    network.components = network.members = 2;
    network.direction = direction;
    network.seen = {{{0, 1}, {-0.5, 0.5}, {-1, 1}, {0.2, 0.5}, {-0.2, 0.2}}};
    network.constant = {0.09, 3, 0.8, 0.01, 0.2, 0.05};
    network.heldOut = {100, 80, -0.5, 3, 1};
    network.learned.kind = KickNetwork::kind;
    network.learned.synthetic = true;
    network.learned.inputs = kickInputs();
    const double means[] = {0.5, 0, 0, 0.36, 0}, scales[] = {0.3, 0.2, 0.5, 0.03, 0.06};
    for (std::size_t i = 0; i < KickState::inputs; ++i)
        network.learned.inputs[i].mean = means[i], network.learned.inputs[i].scale = scales[i];
    network.learned.outputs = kickOutputs(network);
    for (NetworkVariable& output : network.learned.outputs) {
        const auto is = [&](const char* name) { return output.name.starts_with(name); };
        if (is("delay")) output.mean = 0.09, output.scale = 0.02;
        if (is("log_delay_spread")) output.mean = -4.8, output.scale = 0.5;
        if (is("speed")) output.mean = 3, output.scale = 0.6;
        if (is("log_speed_spread")) output.mean = -1.8, output.scale = 0.5;
        if (is("direction")) output.scale = 0.15;
        if (is("log_direction_spread")) output.mean = -3, output.scale = 0.5;
        if (is("hit_quantile")) output.mean = 0.84, output.scale = 0.5;
    }
    const auto part = [](int inputs, int outputs, std::uint64_t seed) {
        Mlp mlp = randomMlp({inputs, 4, outputs}, {.seed = seed, .hiddenScale = 2, .outputScale = 1});
        std::vector<int> own;
        for (int i = 0; i < inputs; ++i) own.push_back(i);
        return amongInputs(std::move(mlp), static_cast<int>(KickState::inputs), own);
    };
    Regressor all = part(static_cast<int>(KickState::knownAtCommand), network.delayOutputs(), 5);
    network.learned.regressor =
        sideBySide(all, part(static_cast<int>(KickState::inputs), network.departureForm().outputs(), 6));
    return network;
}

}  // namespace mrose
