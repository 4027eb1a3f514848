#include "identification/actuator_limits_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include <Eigen/Dense>

#include "identification/motion_samples.h"
#include "learning/parallel_for.h"

namespace mrose {
namespace {

using Quantity = NetworkInput::Quantity;

constexpr double worthIt = 0.9;              // of the squares that are left without a limit
constexpr std::size_t mostPeriods = 60'000;  // that limits are told by

/// v, w.
using Pair = std::array<double, 2>;

std::vector<std::size_t> inputsOf(const MotionNetwork& network, Quantity quantity) {
    std::vector<std::size_t> inputs;
    for (std::size_t i = 0; i < network.inputs.size(); ++i)
        if (network.inputs[i].quantity == quantity) inputs.push_back(i);
    return inputs;
}

bool readSameParts(const MotionNetwork& network) {
    return std::ranges::equal(inputsOf(network, Quantity::commandV), inputsOf(network, Quantity::commandW),
                              [&](std::size_t v, std::size_t w) {
                                  return network.inputs[v].newest == network.inputs[w].newest &&
                                         network.inputs[v].oldest == network.inputs[w].oldest;
                              });
}

/// Commands as they are read, and what became of them, by channel.
struct Responses {
    std::array<Eigen::MatrixXd, 2> commands;  ///< [period][part of the history, velocity if it is read, 1]
    std::array<Eigen::VectorXd, 2> moved;     ///< m, rad

    /// Mean squares that linear maps leave.
    Pair unexplained() const {
        Pair squares{};
        for (std::size_t c = 0; c < squares.size(); ++c) {
            const Eigen::MatrixXd& x = commands[c];
            Eigen::MatrixXd products = x.transpose() * x;
            products.diagonal().array() += 1e-9 * products.diagonal().maxCoeff();  // parts may be all alike
            const Eigen::VectorXd map = products.llt().solve(x.transpose() * moved[c]);
            squares[c] = (moved[c] - x * map).squaredNorm() / static_cast<double>(x.rows());
        }
        return squares;
    }
};

/// `velocities`: how fast the robot was counts, too, so that a lag is none of what is left.
std::optional<Responses> readResponses(std::span<const Log> logs, MotionNetwork network, const ActuatorLimits& limits,
                                       bool velocities) {
    network.limits = limits;
    SampleOptions once;
    once.period = network.period;
    once.phases = once.folds = 1;
    const auto samples = motionSamples(logs, network, once);
    if (!samples) return std::nullopt;
    const std::size_t stride = 1 + samples->samples.size() / mostPeriods;
    const auto count = static_cast<Eigen::Index>((samples->samples.size() + stride - 1) / stride);
    Responses read;
    for (std::size_t c = 0; c < read.commands.size(); ++c) {
        std::vector<std::size_t> inputs = inputsOf(network, c == 0 ? Quantity::commandV : Quantity::commandW);
        if (velocities)
            for (const std::size_t i : inputsOf(network, c == 0 ? Quantity::velocityV : Quantity::velocityW))
                inputs.push_back(i);
        read.commands[c].setOnes(count, static_cast<Eigen::Index>(inputs.size()) + 1);
        read.moved[c].resize(count);
        for (Eigen::Index p = 0; p < count; ++p) {
            const std::size_t sample = stride * static_cast<std::size_t>(p);
            const auto row = samples->inputsOf(sample);
            for (std::size_t i = 0; i < inputs.size(); ++i)
                read.commands[c](p, static_cast<Eigen::Index>(i)) = row[inputs[i]];
            const Pose& increment = samples->samples[sample].increment;
            read.moved[c](p) = c == 0 ? increment.x : increment.heading;
        }
    }
    return read;
}

Pair largestCommands(std::span<const Log> logs) {
    Pair largest{};
    for (const Log& log : logs)
        for (const RobotLog& robot : log.robots)
            for (const Trajectory& trajectory : robot.trajectories)
                for (const StampedCommand& issued : trajectory.commands) {
                    largest[0] = std::max(largest[0], std::abs(issued.command.v));
                    largest[1] = std::max(largest[1], std::abs(issued.command.w));
                }
    return largest;
}

/// s: from the largest command to its opposite, as far as it is told.
double longestRamp(const ActuatorLimits& limits, const Pair& largest) {
    double longest = 0;
    if (limits.accelerationV > 0) longest = std::max(longest, 2 * largest[0] / limits.accelerationV);
    if (limits.accelerationW > 0) longest = std::max(longest, 2 * largest[1] / limits.accelerationW);
    return longest == 0 ? ActuatorLimits::mostRamp : std::min(longest, ActuatorLimits::mostRamp);
}

/// Each channel by itself, by how long the drive takes from standstill to the largest command.
void findAccelerations(std::span<const Log> logs, const MotionNetwork& blueprint, const Pair& largest,
                       ActuatorLimits& limits) {
    constexpr double instant = 1e-6, quickest = 0.05, longest = ActuatorLimits::mostRamp;  // s
    struct Trial {
        Pair duration{};  ///< s
        Pair unexplained{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    };
    Trial best;
    const auto tryAll = [&](std::vector<Trial> trials) {
        parallelFor(trials.size(), [&](std::size_t i) {
            ActuatorLimits tried;
            tried.accelerationV = largest[0] / trials[i].duration[0];
            tried.accelerationW = largest[1] / trials[i].duration[1];
            if (const auto read = readResponses(logs, blueprint, tried, true))
                trials[i].unexplained = read->unexplained();
        });
        for (const Trial& trial : trials)
            for (std::size_t c = 0; c < largest.size(); ++c)
                if (trial.unexplained[c] < best.unexplained[c]) {
                    best.unexplained[c] = trial.unexplained[c];
                    best.duration[c] = trial.duration[c];
                }
    };
    tryAll({Trial{{instant, instant}}});  // as good as no limit, of the same periods
    const Pair without = best.unexplained;
    const auto worth = [&](std::size_t c) { return best.unexplained[c] < worthIt * without[c]; };
    std::vector<Trial> coarse;
    for (double duration = quickest; duration < longest; duration *= std::numbers::sqrt2)
        coarse.push_back({{duration, duration}});
    tryAll(coarse);
    for (double factor = std::sqrt(std::numbers::sqrt2); factor > 1.01 && (worth(0) || worth(1));
         factor = std::sqrt(factor)) {
        const auto [v, w] = best.duration;
        tryAll({{{std::min(v * factor, longest), std::min(w * factor, longest)}}, {{v / factor, w / factor}}});
    }
    if (worth(0)) limits.accelerationV = largest[0] / best.duration[0];
    if (worth(1)) limits.accelerationW = largest[1] / best.duration[1];
}

/// Tyres scrub in bends, the more the faster the robot drives: a further column for each part of the history, of the
/// products of v and w. Without them a wheel's limit would have to explain that, too.
void addBends(Responses& read, Eigen::Index parts) {
    const Eigen::MatrixXd v = read.commands[0].leftCols(parts), w = read.commands[1].leftCols(parts);
    for (std::size_t c = 0; c < read.commands.size(); ++c) {
        Eigen::MatrixXd& x = read.commands[c];
        x.conservativeResize(Eigen::NoChange, x.cols() + parts);
        x.rightCols(parts) = c == 0 ? v.cwiseProduct(w.cwiseAbs()) : w.cwiseProduct(v.cwiseAbs());
    }
}

/// By what both channels leave together, each as a share of what it leaves without a limit.
void findWheelSpeed(std::span<const Log> logs, const MotionNetwork& blueprint, ActuatorLimits& limits) {
    const auto asked = readResponses(logs, blueprint, limits, false);
    if (!asked) return;
    const Eigen::Index parts = asked->commands[0].cols() - 1;  // the last column is of ones
    const auto unexplainedBy = [&](Responses read) {
        addBends(read, parts);
        return read.unexplained();
    };
    const Pair without = unexplainedBy(*asked);
    if (!(without[0] > 0 && without[1] > 0)) return;
    struct Trial {
        double halfTrack = 0, share = 1;  ///< m; of the fastest wheel that is asked for
        double unexplained = 2;
    };
    const auto limitsOf = [&](const Trial& trial) {
        const auto& [v, w] = asked->commands;
        ActuatorLimits tried;
        tried.halfTrack = trial.halfTrack;
        tried.wheelSpeed =
            trial.share *
            (v.leftCols(parts).array().abs() + trial.halfTrack * w.leftCols(parts).array().abs()).maxCoeff();
        return tried;
    };
    const auto unexplainedWith = [&](const ActuatorLimits& tried) {
        Responses cut = *asked;
        auto& [v, w] = cut.commands;
        for (Eigen::Index part = 0; part < parts; ++part)
            for (Eigen::Index period = 0; period < v.rows(); ++period) {
                const Command within = tried.withinWheelSpeed({v(period, part), w(period, part)});
                v(period, part) = within.v;
                w(period, part) = within.w;
            }
        const Pair squares = unexplainedBy(std::move(cut));
        return squares[0] / without[0] + squares[1] / without[1];
    };
    Trial best;
    const auto tryAll = [&](std::vector<Trial> trials) {
        parallelFor(trials.size(),
                    [&](std::size_t i) { trials[i].unexplained = unexplainedWith(limitsOf(trials[i])); });
        for (const Trial& trial : trials)
            if (trial.unexplained < best.unexplained) best = trial;
    };
    std::vector<Trial> coarse;
    for (double halfTrack = 0.04; halfTrack < 0.6; halfTrack *= 1.25)
        for (int percent = 50; percent < 100; percent += 5) coarse.push_back({halfTrack, 0.01 * percent});
    tryAll(coarse);
    if (best.unexplained >= 2 * worthIt) return;
    for (double step = 0.1; step > 0.01; step /= 2) {
        std::vector<Trial> around;
        for (const double track : {1 - step, 1.0, 1 + step})
            for (const double share : {1 - step / 4, 1.0, 1 + step / 4})
                around.push_back({best.halfTrack * track, std::min(1.0, best.share * share)});
        tryAll(around);
    }
    const ActuatorLimits found = limitsOf(best);
    limits.wheelSpeed = found.wheelSpeed;
    limits.halfTrack = found.halfTrack;
}

}  // namespace

ActuatorLimits identifyActuatorLimits(std::span<const Log> logs, const MotionNetwork& blueprint) {
    ActuatorLimits limits;
    const Pair largest = largestCommands(logs);
    if (largest[0] == 0 || largest[1] == 0) return limits;
    findAccelerations(logs, blueprint, largest, limits);
    if (readSameParts(blueprint)) findWheelSpeed(logs, blueprint, limits);
    limits.longestRamp = longestRamp(limits, largest);
    return limits;
}

}  // namespace mrose
