// What it costs to ask something learned of a task for one state, beside the same network written as a plain loop.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "bench/timing.h"
#include "io/file.h"
#include "learning/task_network.h"

namespace mrose::bench {
namespace {

/// As somebody would write it who has no library at hand.
class PlainLoop {
public:
    explicit PlainLoop(const TaskNetwork& network)
        : inputs_(network.learned.inputs),
          outputs_(network.learned.outputs),
          logarithmic_(network.logarithmic),
          mlp_(std::get<Mlp>(network.learned.regressor)),
          x_(inputs_.size()),
          units_(static_cast<std::size_t>(mlp_.shape.hidden)) {}

    void evaluate(const double* from, double* to) {
        const int inputs = mlp_.shape.inputs, hidden = mlp_.shape.hidden, outputs = mlp_.shape.outputs;
        const float* const w = mlp_.parameters.data();
        const float* const b = w + hidden * inputs;
        const float* const v = b + hidden;
        const float* const c = v + outputs * hidden;
        for (int i = 0; i < inputs; ++i) x_[i] = (from[i] - inputs_[i].mean) / inputs_[i].scale;
        for (int h = 0; h < hidden; ++h) {
            double sum = b[h];
            for (int i = 0; i < inputs; ++i) sum += w[h * inputs + i] * x_[i];
            units_[h] = std::tanh(sum);
        }
        for (int o = 0; o < outputs; ++o) {
            double sum = c[o];
            for (int h = 0; h < hidden; ++h) sum += v[o * hidden + h] * units_[h];
            to[o] = outputs_[o].mean + outputs_[o].scale * sum;
            if (logarithmic_[static_cast<std::size_t>(o)]) to[o] = std::exp(to[o]);
        }
    }

private:
    std::vector<NetworkVariable> inputs_, outputs_;
    std::vector<bool> logarithmic_;
    Mlp mlp_;
    std::vector<double> x_, units_;
};

/// Inputs within what was seen, [state][input].
std::vector<double> someStates(const TaskNetwork& network, std::size_t count) {
    std::mt19937 random(1);
    std::vector<double> states;
    for (std::size_t i = 0; i < count; ++i)
        for (const TaskNetwork::Range& seen : network.seen)
            states.push_back(std::uniform_real_distribution(seen.least, seen.most)(random));
    return states;
}

/// The quickest of many rounds, one state after the other: others may be at work.
template <class Network>
double nanosecondsEach(Network network, const std::vector<double>& states, std::size_t inputs, double& sum) {
    std::vector<double> out(LearnedNetwork::maxOutputs);
    double least = 1e300;
    for (int round = 0; round < 200; ++round)
        least = std::min(least, secondsOf([&] {
                             for (std::size_t at = 0; at < states.size(); at += inputs) {
                                 network.evaluate(states.data() + at, out.data());
                                 sum += out[0];
                             }
                         }));
    return 1e9 * least / static_cast<double>(states.size() / inputs);
}

int measure(const std::string& name) {
    const std::string path = MROSE_SOURCE_DIR "/nets/" + name;
    const auto text = readFile(path);
    const auto network = text ? parseTask(*text, path) : tl::unexpected(text.error());
    if (!network) {
        std::fprintf(stderr, "%s\n", network.error().message().c_str());
        return 1;
    }
    if (network->seen.empty()) return std::fprintf(stderr, "%s: does not say what was seen\n", path.c_str()), 1;
    const std::vector<double> states = someStates(*network, 4096);
    const std::size_t inputs = network->seen.size();
    double ours = 0, theirs = 0;
    const double asked = nanosecondsEach(TaskInference(*network), states, inputs, ours);
    const double plain = nanosecondsEach(PlainLoop(*network), states, inputs, theirs);
    const MlpShape& shape = std::get<Mlp>(network->learned.regressor).shape;
    std::printf("  %-30s %4d %6d %9.0f %9.0f %8.1f %10.1e\n", name.c_str(), shape.inputs, shape.hidden, asked, plain,
                plain / asked, std::abs(ours - theirs) / std::abs(theirs));
    return 0;
}

}  // namespace
}  // namespace mrose::bench

int main() {
    std::printf("one state                      inputs  units        ns  plain ns    ratio difference\n");
    int failed = 0;
    for (const char* name : {"time_to_target.net", "time_to_ball_pioneer.net", "planner_choice.net"})
        failed |= mrose::bench::measure(name);
    return failed;
}
