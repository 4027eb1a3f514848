// Speed of learning and inference, as ratios to FANN run beside them in the same minutes: absolute times do not hold
// from machine to machine.

#include <algorithm>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <tbb/task_arena.h>

#include "bench/mlp_patterns.h"
#include "bench/rprop_fann.h"
#include "bench/timing.h"
#include "learning/initial_weights.h"
#include "learning/mlp_gradient.h"
#include "learning/mlp_inference.h"
#include "learning/squared_error.h"

namespace mrose::bench {
namespace {

constexpr int kHidden = 24;

/// One thing that is timed: `work` does it `times` times.
struct Contender {
    std::string name;
    double times;
    std::function<void()> work;
    std::vector<double> each = {};
};

/// Round by round all contenders, so that a busy machine hits them alike; medians, and ratios to the first, if it is
/// the peer. `scale` converts seconds.
void compare(const char* title, std::vector<Contender> contenders, bool hasPeer, int rounds, double scale,
             const char* unit) {
    for (int round = 0; round < rounds; ++round)
        for (Contender& contender : contenders)
            contender.each.push_back(scale * secondsOf(contender.work) / contender.times);
    std::printf("\n%s: median (least)\n", title);
    for (const Contender& contender : contenders) {
        std::printf("  %-34s %9.2f (%.2f) %s", contender.name.c_str(), median(contender.each),
                    *std::min_element(contender.each.begin(), contender.each.end()), unit);
        std::vector<double> ratios;
        for (int round = 0; round < rounds; ++round)
            ratios.push_back(contenders[0].each[round] / contender.each[round]);
        if (hasPeer && &contender != contenders.data()) std::printf("   %6.1f times FANN", median(ratios));
        std::printf("\n");
    }
    std::fflush(stdout);
}

class Bench {
public:
    explicit Bench(PatternRows rows)
        : rows_(std::move(rows)),
          training_(rows_.trainingSet()),
          validation_(rows_.validationSet()),
          fann_(FannPeer::make(rows_, kHidden)),
          shape_{rows_.inputs, kHidden, rows_.outputs} {
        if (!fann_) std::printf("FANN (libfann-dev) is absent: no ratios\n");
    }

    void epochs(int rounds) {
        std::vector<Contender> contenders;
        if (fann_) contenders.push_back({"FANN RPROP, 1 thread", 1, [this] { fann_->epoch(); }});
        for (const InstructionSet set : availableInstructionSets()) addEpochs(contenders, set, 1);
        addEpochs(contenders, bestInstructionSet(), 2);
        const std::string title =
            "Epoch of iRprop+, " + std::to_string(rows_.training) + " patterns, " + network(shape_);
        compare(title.c_str(), std::move(contenders), fann_ != nullptr, rounds, 1e3, "ms");
    }

    void inference(int rounds) {
        compareInference(shape_, rounds, fann_.get());
        compareInference({40, 100, 7}, rounds, nullptr);
    }

    void convergence(double target, int seeds) {
        std::printf("\nSeconds to validation MSE %.4f, median of %d seeds (epochs)\n", target, seeds);
        TrainingOptions options;
        options.targetError = target;
        options.patience = 1 << 30;
        options.epochs = 10000;
        for (const int threads : {1, 2}) reach("iRprop+", options, threads, seeds);
        options.method = TrainingMethod::levenbergMarquardt;
        options.validateEvery = 1;
        options.epochs = 300;
        for (const int threads : {1, 2}) reach("Levenberg-Marquardt", options, threads, seeds);
    }

private:
    static constexpr std::size_t kRobots = 1024;

    static std::string network(const MlpShape& shape) {
        return std::to_string(shape.inputs) + "-" + std::to_string(shape.hidden) + "-" + std::to_string(shape.outputs);
    }

    void addEpochs(std::vector<Contender>& contenders, InstructionSet set, int threads) {
        struct State {
            Mlp net;
            MlpGradient engine;
            Rprop rprop;
            std::vector<double> gradient;
            tbb::task_arena arena;
        };
        auto state = std::make_shared<State>(State{randomMlp(shape_),
                                                   MlpGradient(shape_, set),
                                                   Rprop(shape_.parameterCount()),
                                                   std::vector<double>(shape_.parameterCount()),
                                                   {}});
        state->arena.initialize(threads);
        constexpr int kTimes = 2;
        const auto work = [this, state] {
            state->arena.execute([&] {
                for (int i = 0; i < kTimes; ++i) {
                    const double loss = state->engine.meanSquaredError(state->net.parameters, training_.inputs,
                                                                       training_.targets, state->gradient);
                    state->rprop.step(state->net.parameters, state->gradient, loss);
                }
            });
        };
        contenders.push_back({std::string(name(set)) + ", " + std::to_string(threads) + " thread(s)", kTimes, work});
    }

    void compareInference(const MlpShape& shape, int rounds, FannPeer* fann) {
        constexpr int kTimes = 5;  // short enough to fit between interruptions
        std::vector<float> x(kRobots * shape.inputs), y(kRobots * shape.outputs);
        for (std::size_t i = 0; i < x.size(); ++i) x[i] = rows_.values[i % rows_.values.size()];
        std::vector<Contender> contenders;
        const auto repeat = [](const auto& work) {
            return [work] {
                for (int i = 0; i < kTimes; ++i) work();
            };
        };
        const double times = static_cast<double>(kTimes) * kRobots;
        if (fann) {
            contenders.push_back({"FANN, alone", times, repeat([&x, &y, fann, shape] {
                                      for (std::size_t i = 0; i < kRobots; ++i)
                                          std::copy_n(fann->run(&x[i * shape.inputs]), shape.outputs,
                                                      &y[i * shape.outputs]);
                                  })});
        }
        for (const InstructionSet set : availableInstructionSets()) {
            auto net = std::make_shared<MlpInference>(randomMlp(shape), set);
            contenders.push_back({std::string(name(set)) + ", alone", times, repeat([&x, &y, net, shape] {
                                      for (std::size_t i = 0; i < kRobots; ++i)
                                          net->one(&x[i * shape.inputs], &y[i * shape.outputs]);
                                  })});
            contenders.push_back({std::string(name(set)) + ", in a batch of 1024", times,
                                  repeat([&x, &y, net] { net->batch(x.data(), y.data(), kRobots); })});
        }
        const std::string title = "Inference of " + network(shape) + ", each robot";
        compare(title.c_str(), std::move(contenders), fann != nullptr, rounds, 1e9, "ns");
    }

    void reach(const char* method, const TrainingOptions& options, int threads, int seeds) {
        std::vector<double> times, epochs;
        int reached = 0;
        tbb::task_arena arena(threads);
        for (int seed = 1; seed <= seeds; ++seed) {
            SquaredError objective(shape_, training_, validation_);
            TrainingResult result;
            const std::vector<float> start = randomMlp(shape_, {.seed = static_cast<std::uint64_t>(seed)}).parameters;
            times.push_back(secondsOf([&] { arena.execute([&] { result = train(objective, start, options); }); }));
            epochs.push_back(result.epochs);
            reached += result.end == TrainingEnd::target;
        }
        std::printf("  %-22s %d thread(s) %9.3f s  (%.0f)  reached %d of %d\n", method, threads, median(times),
                    median(epochs), reached, seeds);
        std::fflush(stdout);
    }

    PatternRows rows_;
    PatternSet training_, validation_;
    std::unique_ptr<FannPeer> fann_;
    MlpShape shape_;
};

}  // namespace
}  // namespace mrose::bench

int main(int argc, char** argv) {
    using namespace mrose::bench;
    CLI::App app{"Speed of learning and inference beside FANN"};
    std::string file;
    int rounds = 15, seeds = 5;
    double target = 0.0125;
    app.add_option("--patterns", file,
                   "file of patterns (int32 training, validation, inputs, outputs; float32 rows); "
                   "without it synthetic ones are made");
    app.add_option("--rounds", rounds, "of timing")->check(CLI::PositiveNumber);
    app.add_option("--seeds", seeds, "of fits to the target; 0 leaves them out")->check(CLI::NonNegativeNumber);
    app.add_option("--target", target, "validation MSE to reach");
    CLI11_PARSE(app, argc, argv);
    auto rows = file.empty() ? mrose::Expected<PatternRows>(syntheticPatterns()) : readPatterns(file);
    if (!rows) {
        std::fprintf(stderr, "%s\n", rows.error().message().c_str());
        return 1;
    }
    Bench bench(std::move(*rows));
    bench.epochs(rounds);
    bench.inference(10 * rounds);
    if (seeds > 0) bench.convergence(target, seeds);
}
