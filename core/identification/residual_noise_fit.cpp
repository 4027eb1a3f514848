#include "identification/residual_noise_fit.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <memory>

#include "identification/energy_loss.h"
#include "identification/rollout_batch.h"
#include "learning/ensemble.h"
#include "learning/parallel_for.h"
#include "learning/trainer.h"

namespace mrose {
namespace {

using Axis = ResidualNoise::Axis;

constexpr std::size_t leastRollouts = 20;

std::size_t rolloutsOf(const MotionSamples& samples, std::size_t length) {
    return chainStarts(samples, length, length, [](const SampleRun&) { return std::size_t{0}; }).size();
}

/// What may differ from run to run: slip and its drift; commands that act early or late, all of a change alike; each
/// as much as the traits say. Members fall behind and lead together with what they disagree on.
ResidualNoise blueprint(std::size_t members) {
    using enum NoiseTrait;
    constexpr double day = 30;  // s: much longer than what rollouts are judged by
    ResidualNoise noise;
    const auto add = [&](Axis axis, double time, std::initializer_list<NoiseTrait> traits) {
        ResidualNoise::Process& process = noise.processes.emplace_back();
        process.axis = axis;
        process.time = time;
        for (const NoiseTrait trait : traits) process.amplitude.push_back({trait, 0});
    };
    add(Axis::forward, 0.2, {moving, unevennessV, forwardChange});
    add(Axis::forward, 0.5, {moving, distance, rotation, unevennessV});
    add(Axis::forward, 1, {forwardChange});
    add(Axis::forward, day, {forward});
    add(Axis::left, 0.5, {moving, distance, rotation});
    add(Axis::left, day, {distance, rotation});
    add(Axis::heading, 0.2, {moving, rotation, unevennessW});
    add(Axis::heading, 1, {headingChange});
    add(Axis::heading, 3, {moving, rotation, unevennessW});
    noise.scale.time = 3;
    if (members > 1) noise.members.time = 1;
    return noise;
}

/// All weights that are learned, in a fixed order: the amplitudes', the members', the scale's.
std::vector<double*> weightsOf(ResidualNoise& noise) {
    std::vector<double*> weights;
    for (ResidualNoise::Process& process : noise.processes)
        for (ResidualNoise::Share& share : process.amplitude) weights.push_back(&share.weight);
    if (noise.members.time > 0) weights.push_back(&noise.members.weight);
    if (noise.scale.time > 0) weights.push_back(&noise.scale.weight);
    return weights;
}

double along(const Pose& pose, Axis axis) {
    return axis == Axis::forward ? pose.x : axis == Axis::left ? pose.y : pose.heading;
}

/// Of the error of a period, were periods independent: from what has become of whole rollouts. Never 0.
std::array<double, 3> errorsPerPeriod(const ResidualRollouts& rollouts) {
    std::array<double, 3> squares{};
    for (std::size_t r = 0; r < rollouts.count(); ++r) {
        std::array<double, 3> sums{};
        for (std::size_t k = r * rollouts.length; k < (r + 1) * rollouts.length; ++k)
            for (const Axis axis : {Axis::forward, Axis::left, Axis::heading})
                sums[static_cast<std::size_t>(axis)] += along(rollouts.truth[k], axis) - along(rollouts.mean[k], axis);
        for (std::size_t a = 0; a < 3; ++a) squares[a] += sums[a] * sums[a];
    }
    std::array<double, 3> errors;
    for (std::size_t a = 0; a < 3; ++a)
        errors[a] = std::max(1e-6, std::sqrt(squares[a] / static_cast<double>(rollouts.truth.size())));
    return errors;
}

/// Weights with which all processes of an axis together make about half of its errors: a unit for each, and where
/// learning begins.
ResidualNoise initialNoise(const ResidualRollouts& rollouts, ResidualNoise noise) {
    NoiseTraits squares{};
    for (const NoiseTraits& traits : rollouts.traits)
        for (std::size_t t = 0; t < traits.size(); ++t) squares[t] += traits[t] * traits[t];
    const std::array<double, 3> errors = errorsPerPeriod(rollouts);
    const double each = 0.5 / std::sqrt(static_cast<double>(noise.processes.size()));
    for (ResidualNoise::Process& process : noise.processes)
        for (ResidualNoise::Share& share : process.amplitude) {
            const double usual =
                std::sqrt(squares[static_cast<std::size_t>(share.trait)] / static_cast<double>(rollouts.traits.size()));
            share.weight = usual > 1e-9 ? each * errors[static_cast<std::size_t>(process.axis)] / usual : 0;
        }
    if (noise.members.time > 0) noise.members.weight = 0.5;
    if (noise.scale.time > 0) noise.scale.weight = 0.3;
    return noise;
}

/// The values of the processes of one set of samples, and of their antithesis: all but the scale with the other sign.
struct DrawnSamples {
    std::size_t samples = 0, length = 0, width = 0;
    std::vector<float> values;  ///< [sample][value][period]

    std::span<const float> of(std::size_t sample, std::size_t value) const {
        return {&values[(sample * width + value) * length], length};
    }
};

DrawnSamples drawSamples(const NoiseProcesses& processes, std::size_t samples, std::size_t length, std::uint64_t seed,
                         std::uint32_t set) {
    DrawnSamples drawn{samples, length, processes.values(), {}};
    drawn.values.resize(samples * drawn.width * length);
    std::vector<float> now(drawn.width), other(drawn.width);
    const std::size_t half = samples / 2;
    for (std::size_t s = 0; s < half; ++s)
        for (std::size_t k = 0; k < length; ++k) {
            NoiseKey key{seed, static_cast<std::int64_t>(k), static_cast<std::uint32_t>(2 * s), set << 8};
            processes.advance(key, k > 0, now);
            ++key.robot;
            processes.advance(key, k > 0, other);
            for (std::size_t v = 0; v < drawn.width; ++v) {
                const bool scale = v + 1 == drawn.width;
                drawn.values[(s * drawn.width + v) * length + k] = now[v];
                drawn.values[((s + half) * drawn.width + v) * length + k] = scale ? other[v] : -now[v];
            }
        }
    return drawn;
}

class NoiseObjective final : public TrainingObjective {
public:
    NoiseObjective(const ResidualRollouts& rollouts, const ResidualNoise& units, Nanoseconds period,
                   const ResidualNoiseOptions& options)
        : rollouts_(rollouts), units_(units), loss_(EnergyLoss::over(rollouts.length)) {
        const NoiseProcesses processes(units, rollouts.members, toSeconds(period));
        for (std::uint32_t set = 0; set < sets; ++set)
            drawn_.push_back(
                drawSamples(processes, static_cast<std::size_t>(options.samples), rollouts.length, options.seed, set));
        weigh();
        loss_.antithetic = true;
    }

    const MlpGradient* engine() const override { return nullptr; }
    std::size_t parameterCount() const override {
        ResidualNoise noise = units_;
        return weightsOf(noise).size();
    }

    /// The noise of these parameters, whose squares are the weights over their units: no weight is negative.
    ResidualNoise noise(std::span<const float> parameters) const {
        ResidualNoise noise = units_;
        const std::vector<double*> weights = weightsOf(noise);
        for (std::size_t i = 0; i < weights.size(); ++i)
            *weights[i] *= static_cast<double>(parameters[i]) * static_cast<double>(parameters[i]);
        return noise;
    }

    double lossAndGradient(std::span<const float> parameters, std::span<double> gradient) const override {
        ResidualNoise units = units_;
        const std::vector<double*> unit = weightsOf(units);
        std::vector<double> byWeight(rollouts_.count() * unit.size());
        const double loss = meanLoss(noise(parameters), byWeight);
        const double share = 1 / static_cast<double>(rollouts_.count());
        std::fill(gradient.begin(), gradient.end(), 0.0);
        for (std::size_t r = 0; r < rollouts_.count(); ++r)
            for (std::size_t i = 0; i < unit.size(); ++i)
                gradient[i] +=
                    share * 2 * static_cast<double>(parameters[i]) * *unit[i] * byWeight[r * unit.size() + i];
        return loss;
    }
    double validationError(std::span<const float> parameters) override { return lossOf(noise(parameters)); }

    double lossOf(const ResidualNoise& noise) const { return meanLoss(noise, {}); }

private:
    static constexpr std::uint32_t sets = 61;  ///< of samples, which rollouts take in turn

    /// Every score over that of the mean alone, times the mean of all instants' position: errors of position and of
    /// heading, soon and late, count alike.
    void weigh() {
        const std::vector<EnergyLoss::Weights> none(loss_.instants.size(), {0, 0, 0});
        EnergyLoss alone = loss_;
        alone.axisWeight = 0;
        alone.weights = none;
        std::vector<EnergyLoss::Weights> scores = none;
        double places = 0;
        for (std::size_t i = 0; i < scores.size(); ++i) {
            for (double EnergyLoss::Weights::*const score :
                 {&EnergyLoss::Weights::place, &EnergyLoss::Weights::heading, &EnergyLoss::Weights::move}) {
                alone.weights[i].*score = 1;
                scores[i].*score = meanAlone(alone);
                alone.weights = none;
            }
            places += scores[i].place / static_cast<double>(scores.size());
        }
        const auto over = [&](double score) { return score > 0 ? places / score : 0; };
        for (std::size_t i = 0; i < scores.size(); ++i)
            loss_.weights[i] = {over(scores[i].place), over(scores[i].heading), over(scores[i].move)};
    }
    double meanAlone(const EnergyLoss& loss) const {
        double sum = 0;
        for (std::size_t r = 0; r < rollouts_.count(); ++r) {
            const auto mean = std::span(rollouts_.mean).subspan(r * rollouts_.length, rollouts_.length);
            const auto truth = std::span(rollouts_.truth).subspan(r * rollouts_.length, rollouts_.length);
            sum += loss(mean, 1, mean, truth, {});
        }
        return sum / static_cast<double>(rollouts_.count());
    }

    /// Of one rollout's samples, for the noise at hand: the increments, and what makes them.
    struct Sampled {
        std::vector<double> amplitudes;  ///< [process][period]
        std::vector<double> scales;      ///< [sample][period]
        std::vector<Pose> increments, noise, gradient;
    };

    void sample(const ResidualNoise& noise, std::size_t rollout, const DrawnSamples& drawn, Sampled& out) const {
        const std::size_t length = rollouts_.length, processes = noise.processes.size();
        const std::span traits = std::span(rollouts_.traits).subspan(rollout * length, length);
        out.amplitudes.assign(processes * length, 0);
        for (std::size_t p = 0; p < processes; ++p)
            for (const ResidualNoise::Share& share : noise.processes[p].amplitude)
                for (std::size_t k = 0; k < length; ++k)
                    out.amplitudes[p * length + k] += share.weight * traits[k][static_cast<std::size_t>(share.trait)];
        out.scales.resize(drawn.samples * length);
        out.noise.assign(drawn.samples * length, {});
        out.increments.resize(drawn.samples * length);
        const double perMember = memberWeight(noise);
        for (std::size_t s = 0; s < drawn.samples; ++s) {
            Pose* const sum = &out.noise[s * length];
            for (std::size_t p = 0; p < processes; ++p) {
                const std::span<const float> n = drawn.of(s, p);
                const double* const amplitude = &out.amplitudes[p * length];
                const Axis axis = noise.processes[p].axis;
                double Pose::*const part = axis == Axis::forward ? &Pose::x
                                           : axis == Axis::left  ? &Pose::y
                                                                 : &Pose::heading;
                for (std::size_t k = 0; k < length; ++k) sum[k].*part += amplitude[k] * static_cast<double>(n[k]);
            }
            for (std::size_t m = 0; perMember != 0 && m < rollouts_.members; ++m) {
                const std::span<const float> n = drawn.of(s, processes + m);
                for (std::size_t k = 0; k < length; ++k) {
                    const Pose& d = deviation(rollout, k, m);
                    const double by = perMember * static_cast<double>(n[k]);
                    sum[k].x += by * d.x;
                    sum[k].y += by * d.y;
                    sum[k].heading += by * d.heading;
                }
            }
            const std::span<const float> z = drawn.of(s, drawn.width - 1);
            for (std::size_t k = 0; k < length; ++k) {
                const double scale = exponential(noise.scale.weight * static_cast<double>(z[k]));
                const Pose& mean = rollouts_.mean[rollout * length + k];
                out.scales[s * length + k] = scale;
                sum[k] = {scale * sum[k].x, scale * sum[k].y, scale * sum[k].heading};
                out.increments[s * length + k] = {mean.x + sum[k].x, mean.y + sum[k].y, mean.heading + sum[k].heading};
            }
        }
    }

    const Pose& deviation(std::size_t rollout, std::size_t period, std::size_t member) const {
        return rollouts_.deviations[(rollout * rollouts_.length + period) * rollouts_.members + member];
    }
    double memberWeight(const ResidualNoise& noise) const {
        return rollouts_.members < 2 ? 0 : noise.members.weight / std::sqrt(static_cast<double>(rollouts_.members - 1));
    }

    /// By the weights, in their order.
    void differentiate(const ResidualNoise& noise, std::size_t rollout, const DrawnSamples& drawn, const Sampled& from,
                       std::span<double> byWeight) const {
        const std::size_t length = rollouts_.length, processes = noise.processes.size();
        const std::span traits = std::span(rollouts_.traits).subspan(rollout * length, length);
        std::size_t at = 0;
        std::vector<double> byAmplitude(length);
        for (std::size_t p = 0; p < processes; ++p) {
            byAmplitude.assign(length, 0);
            for (std::size_t s = 0; s < drawn.samples; ++s) {
                const std::span<const float> n = drawn.of(s, p);
                for (std::size_t k = 0; k < length; ++k)
                    byAmplitude[k] += from.scales[s * length + k] * static_cast<double>(n[k]) *
                                      along(from.gradient[s * length + k], noise.processes[p].axis);
            }
            for (const ResidualNoise::Share& share : noise.processes[p].amplitude) {
                for (std::size_t k = 0; k < length; ++k)
                    byWeight[at] += byAmplitude[k] * traits[k][static_cast<std::size_t>(share.trait)];
                ++at;
            }
        }
        if (noise.members.time > 0) {
            const double each = 1 / std::sqrt(static_cast<double>(rollouts_.members - 1));
            for (std::size_t s = 0; s < drawn.samples; ++s)
                for (std::size_t m = 0; m < rollouts_.members; ++m) {
                    const std::span<const float> n = drawn.of(s, processes + m);
                    for (std::size_t k = 0; k < length; ++k) {
                        const Pose &d = deviation(rollout, k, m), &g = from.gradient[s * length + k];
                        byWeight[at] += each * from.scales[s * length + k] * static_cast<double>(n[k]) *
                                        (d.x * g.x + d.y * g.y + d.heading * g.heading);
                    }
                }
            ++at;
        }
        for (std::size_t s = 0; noise.scale.time > 0 && s < drawn.samples; ++s) {
            const std::span<const float> z = drawn.of(s, drawn.width - 1);
            for (std::size_t k = 0; k < length; ++k) {
                const Pose &e = from.noise[s * length + k], &g = from.gradient[s * length + k];
                byWeight[at] += static_cast<double>(z[k]) * (e.x * g.x + e.y * g.y + e.heading * g.heading);
            }
        }
    }

    /// `byWeight`: [rollout][weight], or empty.
    double meanLoss(const ResidualNoise& noise, std::span<double> byWeight) const {
        const std::size_t count = rollouts_.count(), length = rollouts_.length;
        std::vector<double> losses(count);
        parallelFor(count, [&](std::size_t r) {
            thread_local Sampled sampled;
            const DrawnSamples& drawn = drawn_[r % sets];
            sample(noise, r, drawn, sampled);
            sampled.gradient.assign(byWeight.empty() ? 0 : sampled.increments.size(), {});
            losses[r] = loss_(sampled.increments, drawn.samples, std::span(rollouts_.mean).subspan(r * length, length),
                              std::span(rollouts_.truth).subspan(r * length, length), sampled.gradient);
            const std::size_t weights = byWeight.size() / count;
            if (!byWeight.empty()) differentiate(noise, r, drawn, sampled, byWeight.subspan(r * weights, weights));
        });
        double sum = 0;
        for (const double loss : losses) sum += loss;
        return sum / static_cast<double>(count);
    }

    const ResidualRollouts& rollouts_;
    ResidualNoise units_;
    EnergyLoss loss_;
    std::vector<DrawnSamples> drawn_;
};

}  // namespace

std::size_t residualLength(const MotionSamples& samples) {
    const double period = toSeconds(samples.period);
    std::size_t length = 0;
    for (const SampleRun& run : samples.runs) length = std::max(length, run.count);
    length = std::min(length, static_cast<std::size_t>(std::llround(longestResidual / period)));
    const auto shortest = static_cast<std::size_t>(std::llround(shortestResidual / period));
    while (length >= shortest && rolloutsOf(samples, length) < leastRollouts) length = length * 3 / 4;
    return length >= shortest ? length : 0;
}

namespace {

/// Predictions begin with a velocity that was measured now or a period before, and that the network carries on then;
/// one that is older is left the true one.
void beginAsPredictionsDo(const MotionNetwork& network, const MotionSamples& samples, RolloutBatch& batch) {
    if (network.form != MotionNetwork::Form::state) return;
    PatternMatrix before(batch.chains(), static_cast<int>(samples.width)), after;
    std::vector<std::size_t> carried;
    for (std::size_t chain = 0; chain < batch.chains(); ++chain) {
        const std::size_t start = batch.starts()[chain];
        const MotionSample& sample = samples.samples[start];
        const Velocity& measured = sample.measuredVelocity.velocity;
        const Nanoseconds age = sample.start - sample.measuredVelocity.time;
        if (2 * age < samples.period) {
            batch.beginWith(chain, measured);
        } else if (2 * age < 3 * samples.period && start > 0 &&
                   samples.samples[start - 1].start == sample.start - samples.period) {
            carried.push_back(chain);
            const auto raw = samples.inputsOf(start - 1);
            for (std::size_t i = 0; i < raw.size(); ++i) {
                const NetworkInput& input = network.inputs[i];
                const double value = input.quantity == NetworkInput::Quantity::velocityV   ? measured.v
                                     : input.quantity == NetworkInput::Quantity::velocityW ? measured.w
                                                                                           : raw[i];
                before(chain, static_cast<int>(i)) = static_cast<float>((value - input.mean) / input.scale);
            }
        }
    }
    MlpGradient(network.mlp.shape).forward(network.mlp.parameters, before, after);
    for (const std::size_t chain : carried) {
        const auto output = [&](int k) {
            const NetworkOutput& of = network.outputs[static_cast<std::size_t>(k)];
            return of.mean + of.scale * static_cast<double>(after(chain, k));
        };
        batch.beginWith(chain, {output(3), output(4)});
    }
}

}  // namespace

void addResidualRollouts(const MotionNetwork& network, const MotionSamples& samples, std::size_t length,
                         ResidualRollouts& rollouts) {
    const auto threeSeconds = static_cast<std::size_t>(std::llround(3 / toSeconds(samples.period)));
    const std::size_t stride = std::clamp<std::size_t>(length / 3, 1, threeSeconds);
    const auto first = [&](const SampleRun& run) { return std::size_t{run.count > length}; };  // after another period
    RolloutBatch batch(samples, network, chainStarts(samples, length, stride, first), length);
    beginAsPredictionsDo(network, samples, batch);
    const bool ensemble = network.members.size() > 1;
    const Mlp mlp = ensemble ? withMemberOutputs(network.mlp, network.members) : network.mlp;
    const MlpGradient engine(mlp.shape);
    const RolloutBatch::Pass pass = batch.rollOut(engine, mlp.parameters);
    const NoiseTraitReader reader(network);
    const std::size_t outputs = network.outputs.size(), members = ensemble ? network.members.size() : 0;
    const std::size_t own = ensemble ? network.members.front().outputBiases.size() : 0;
    assert(rollouts.count() == 0 || (rollouts.length == length && rollouts.members == members));
    rollouts.length = length;
    rollouts.members = members;
    std::vector<float> row(samples.width);
    const std::vector<std::size_t>& starts = batch.starts();
    for (std::size_t chain = 0; chain < batch.chains(); ++chain) {
        const auto truth = batch.truth(chain);
        rollouts.truth.push_back(relative(samples.samples[starts[chain]].measured, truth.front()));
        rollouts.truth.insert(rollouts.truth.end(), truth.begin() + 1, truth.end());
        for (std::size_t k = 0; k < length; ++k) {
            const Pose& mean = pass.increments[chain * length + k];
            const Pose& previous = k > 0 ? pass.increments[chain * length + k - 1] : mean;
            for (std::size_t i = 0; i < row.size(); ++i) row[i] = batch.inputs(pass, k)(chain, static_cast<int>(i));
            rollouts.mean.push_back(mean);
            rollouts.traits.push_back(reader.read(row.data(), mean, previous));
            for (std::size_t m = 0; m < members; ++m) {
                const auto output = [&](std::size_t i) {
                    return network.outputs[i].mean +
                           network.outputs[i].scale *
                               static_cast<double>(pass.outputs[k](chain, static_cast<int>(outputs + m * own + i)));
                };
                rollouts.deviations.push_back({output(0) - mean.x, output(1) - mean.y, output(2) - mean.heading});
            }
        }
    }
}

double residualLoss(const ResidualNoise& noise, const ResidualRollouts& rollouts, Nanoseconds period,
                    const ResidualNoiseOptions& options) {
    return NoiseObjective(rollouts, noise, period, options).lossOf(noise);
}

namespace {

ResidualNoise fitted(const ResidualRollouts& rollouts, const ResidualNoise& blueprint, Nanoseconds period,
                     const ResidualNoiseOptions& options, const Progress& progress) {
    assert(rollouts.count() > 0 && options.samples >= 2 && options.samples % 2 == 0);
    NoiseObjective objective(rollouts, initialNoise(rollouts, blueprint), period, options);
    TrainingOptions training;
    training.epochs = training.patience = options.epochs;
    training.rprop.largestStep = 1;
    const auto report = [&](const TrainingProgress& p) {
        return mayGoOn(progress, static_cast<double>(p.epoch) / options.epochs);
    };
    const std::vector<float> units(objective.parameterCount(), 1.0F);
    const TrainingResult result = train(objective, units, training, report);
    ResidualNoise noise = objective.noise(result.parameters.empty() ? units : result.parameters);
    noise.horizon = toSeconds(period) * static_cast<double>(rollouts.length);
    noise.rollouts = static_cast<std::int64_t>(rollouts.count());
    noise.most.emplace();
    for (const NoiseTraits& traits : rollouts.traits)
        for (std::size_t t = 0; t < traits.size(); ++t)
            (*noise.most)[t] = std::max((*noise.most)[t], std::abs(traits[t]));
    return noise;
}

}  // namespace

ResidualNoise fitResidualNoise(const ResidualRollouts& rollouts, Nanoseconds period,
                               const ResidualNoiseOptions& options, const Progress& progress) {
    return fitted(rollouts, blueprint(rollouts.members), period, options, progress);
}

MotionNoise fitConstantNoise(const ResidualRollouts& rollouts, Nanoseconds period, const ResidualNoiseOptions& options,
                             const Progress& progress) {
    ResidualNoise independent;
    independent.processes = {{Axis::forward, 0, {{NoiseTrait::distance, 0}}},
                             {Axis::heading, 0, {{NoiseTrait::rotation, 0}}},
                             {Axis::heading, 0, {{NoiseTrait::distance, 0}}}};
    const ResidualNoise noise = fitted(rollouts, independent, period, options, progress);
    const auto weight = [&](std::size_t process) { return noise.processes[process].amplitude.front().weight; };
    return {weight(0), weight(1), weight(2)};
}

}  // namespace mrose
