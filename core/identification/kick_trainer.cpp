#include "identification/kick_trainer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "geometry/normal_distribution.h"
#include "geometry/pose.h"
#include "identification/likelihood_objective.h"
#include "io/format.h"
#include "learning/initial_weights.h"
#include "perception/reading_distribution.h"

namespace mrose {
namespace {

constexpr std::size_t fewestHits = 40, fewestOfEither = 10;

struct KickMoments {
    double mean = 0, spread = 0;
};
KickMoments kickMomentsOf(const std::vector<double>& values) {
    KickMoments moments;
    const auto n = static_cast<double>(values.size());
    for (const double value : values) moments.mean += value / n;
    for (const double value : values) moments.spread += (value - moments.mean) * (value - moments.mean) / n;
    moments.spread = std::sqrt(moments.spread);
    return moments;
}

/// What one of the three mappings is of.
enum class KickPart { delay, hit, departure };

class KickLearner {
public:
    KickLearner(const KickSamples& samples, const KickTrainerOptions& options, const Progress& progress)
        : samples_(samples.kicks), options_(options), progress_(progress) {
        network.components = options.components;
        network.members = options.folds;
        network.learned.kind = KickNetwork::kind;
        setDirection();
        setConstant();
        setVariables();
    }

    /// False: progress ended it.
    bool learn() {
        auto delays = membersOf(KickPart::delay, network.heldOut.delay);
        if (!delays) return false;
        const auto hit = hitMapping();
        if (!hit) return false;
        auto departures = membersOf(KickPart::departure, network.heldOut.departure);
        if (!departures) return false;
        Regressor joined = delays->front();
        const auto add = [&](const Regressor& next) { joined = sideBySide(joined, next); };
        std::for_each(delays->begin() + 1, delays->end(), add);
        add(*hit);
        std::for_each(departures->begin(), departures->end(), add);
        network.learned.regressor = std::move(joined);
        network.heldOut.kicks = static_cast<std::int64_t>(samples_.size());
        network.heldOut.hits = static_cast<std::int64_t>(hits());
        network.learned.training.method = "irprop+";
        network.learned.training.loss = "likelihood";
        network.learned.training.seed = options_.seed;
        network.learned.training.patterns = static_cast<std::int64_t>(samples_.size());
        network.learned.training.epochs = epochs_;
        return true;
    }

    KickNetwork network;

private:
    std::size_t hits() const {
        return static_cast<std::size_t>(std::ranges::count_if(samples_, [](const auto& kick) { return kick.hit; }));
    }
    double turned(const KickSample& kick) const { return wrapAngle(kick.direction - network.direction); }

    template <class Value>
    std::vector<double> ofHits(const Value& value) const {
        std::vector<double> values;
        for (const KickSample& kick : samples_)
            if (kick.hit) values.push_back(value(kick));
        return values;
    }

    void setDirection() {
        Point sum;
        for (const KickSample& kick : samples_)
            if (kick.hit) sum = sum + towards(kick.direction);
        network.direction = direction(sum);
    }

    void setConstant() {
        double powers = 0, products = 0;
        const Point along = towards(network.direction);
        const auto own = [&](const KickSample& kick) { return kick.state.robot.v * along.x; };
        for (const KickSample& kick : samples_)
            if (kick.hit) {
                powers += kick.state.power * kick.state.power;
                products += kick.state.power * (kick.speed - own(kick));
            }
        KickNetwork::Constant& c = network.constant;
        c.speedAtFull = powers > 0 ? products / powers : 0;
        const KickMoments delay = kickMomentsOf(ofHits([](const auto& kick) { return kick.delay; }));
        c.deadTime = delay.mean;
        c.delaySpread = std::max(1e-6, delay.spread);
        const auto root = [](const std::vector<double>& errors) {
            double squares = 0;
            for (const double error : errors) squares += error * error;
            return std::max(1e-6, std::sqrt(squares / static_cast<double>(errors.size())));
        };
        c.speedSpread =
            root(ofHits([&](const auto& kick) { return kick.speed - own(kick) - kick.state.power * c.speedAtFull; }));
        c.directionSpread = root(ofHits([&](const auto& kick) { return turned(kick); }));
        c.hits = static_cast<double>(hits()) / static_cast<double>(samples_.size());
    }

    void setVariables() {
        network.learned.inputs = kickInputs();
        for (std::size_t i = 0; i < KickState::inputs; ++i) {
            std::vector<double> values;
            for (const KickSample& kick : samples_) values.push_back(kick.state.values()[i]);
            const KickMoments moments = kickMomentsOf(values);
            const auto [least, most] = std::ranges::minmax(values);
            network.seen[i] = {least, most};
            // Of an input that does not vary nothing can be known: it is always its mean.
            network.learned.inputs[i].mean = moments.mean;
            network.learned.inputs[i].scale = moments.spread > 1e-9 ? moments.spread : 1;
        }
        network.learned.outputs = kickOutputs(network);
        const KickMoments delay = kickMomentsOf(ofHits([](const auto& kick) { return kick.delay; }));
        const KickMoments speed = kickMomentsOf(ofHits([](const auto& kick) { return kick.speed; }));
        const KickMoments turn = kickMomentsOf(ofHits([&](const auto& kick) { return turned(kick); }));
        auto output = network.learned.outputs.begin();
        standardise(output, network.delayForm(), {delay});
        ++output;  // the quantile of a hit
        standardise(output, network.departureForm(), {speed, turn});
    }

    static void standardise(std::vector<NetworkVariable>::iterator& output, const ReadingForm& form,
                            const std::vector<KickMoments>& moments) {
        for (int m = 0; m < form.members; ++m)
            for (int k = 0; k < form.components; ++k) {
                if (k > 0) ++output;  // its share
                for (const KickMoments& of : moments)
                    output->mean = of.mean, (output++)->scale = std::max(1e-5, of.spread);
                for (const KickMoments& of : moments) (output++)->mean = logarithm(std::max(1e-5, of.spread)) - 0.7;
            }
    }

    std::size_t inputsOf(KickPart part) const {
        return part == KickPart::delay ? KickState::knownAtCommand : KickState::inputs;
    }
    std::vector<NetworkVariable> outputsOf(KickPart part) const {
        const auto begin = network.learned.outputs.begin();
        if (part == KickPart::delay) return {begin, begin + network.delayForm().memberOutputs()};
        const auto hit = begin + network.delayOutputs();
        if (part == KickPart::hit) return {hit, hit + 1};
        return {hit + 1, hit + 1 + network.departureForm().memberOutputs()};
    }

    /// Those of the kicks that `takes` takes.
    template <class Takes>
    std::vector<const KickSample*> kicksOf(KickPart part, const Takes& takes) const {
        std::vector<const KickSample*> kicks;
        for (std::size_t i = 0; i < samples_.size(); ++i)
            if (takes(i) && (part == KickPart::hit || samples_[i].hit)) kicks.push_back(&samples_[i]);
        return kicks;
    }

    LikelihoodData dataOf(KickPart part, const std::vector<const KickSample*>& kicks) const {
        LikelihoodData data;
        data.outputs = outputsOf(part);
        const std::size_t width = inputsOf(part);
        data.inputs.resize(kicks.size(), static_cast<int>(width));
        for (std::size_t p = 0; p < kicks.size(); ++p) {
            const KickState state = part == KickPart::delay ? kicks[p]->commanded() : kicks[p]->state;
            const std::array<double, KickState::inputs> values = state.values();
            for (std::size_t i = 0; i < width; ++i) {
                const NetworkVariable& input = network.learned.inputs[i];
                data.inputs(p, static_cast<int>(i)) = static_cast<float>((values[i] - input.mean) / input.scale);
            }
        }
        data.loss = [this, part, kicks](std::size_t p, std::span<const double> values, double* gradient) {
            const KickSample& kick = *kicks[p];
            if (part == KickPart::hit) return reportLoss(values[0], kick.hit, gradient);
            const ReadingForm form = part == KickPart::delay ? network.delayForm() : network.departureForm();
            const ReadingError happened =
                part == KickPart::delay ? ReadingError{kick.delay} : ReadingError{kick.speed, turned(kick)};
            return errorLoss(form, values.data(), {}, happened, gradient);
        };
        return data;
    }

    struct LearnedPart {
        Regressor regressor;
        double loss = 0;
        int epochs = 0;
    };
    std::optional<LearnedPart> learned(KickPart part, int fold, const LikelihoodData& from,
                                       const LikelihoodData& heldOut, std::optional<int> epochs) {
        TrainingOptions training;
        training.rprop.firstStep = 0.01;
        training.rprop.largestStep = 1;
        training.epochs = epochs.value_or(options_.epochs);
        training.patience = options_.patience;
        training.validateEvery = epochs.value_or(10);
        training.weightDecay = options_.weightDecay;
        NetworkLikelihood objective(from, heldOut, options_.hidden);
        const std::uint64_t seed =
            64 * options_.seed + 3 * static_cast<std::uint64_t>(fold) + static_cast<std::uint64_t>(part);
        const Mlp first = randomMlp(objective.engine()->shape(), {.seed = seed, .hiddenScale = 1, .outputScale = 0.2});
        const TrainingResult result = train(objective, first.parameters, training, [&](const TrainingProgress& at) {
            return mayGoOn(progress_, (done_ + static_cast<double>(at.epoch) / training.epochs) / steps());
        });
        if (result.end == TrainingEnd::stopped) return std::nullopt;
        ++done_;
        epochs_ += result.epochs;
        Mlp mlp{first.shape, result.parameters.empty() ? first.parameters : result.parameters};
        std::vector<int> places(inputsOf(part));
        for (std::size_t i = 0; i < places.size(); ++i) places[i] = static_cast<int>(i);
        return LearnedPart{amongInputs(std::move(mlp), static_cast<int>(KickState::inputs), places),
                           result.validationError, std::max(1, result.bestEpoch)};
    }
    double steps() const { return 3.0 * options_.folds + 1; }

    bool isOf(std::size_t kick, int fold) const { return static_cast<int>(kick) % options_.folds == fold; }

    /// One learned without each fold, and the mean logarithm of the likelihood of what that held out.
    std::optional<std::vector<Regressor>> membersOf(KickPart part, double& score, std::vector<int>* best = nullptr) {
        std::vector<Regressor> members;
        double loss = 0, count = 0;
        for (int fold = 0; fold < options_.folds; ++fold) {
            const auto from = kicksOf(part, [&](std::size_t i) { return !isOf(i, fold); });
            const auto heldOut = kicksOf(part, [&](std::size_t i) { return isOf(i, fold); });
            auto member = learned(part, fold, dataOf(part, from), dataOf(part, heldOut), {});
            if (!member) return std::nullopt;
            loss += member->loss * static_cast<double>(heldOut.size());
            count += static_cast<double>(heldOut.size());
            if (best != nullptr) best->push_back(member->epochs);
            members.push_back(std::move(member->regressor));
        }
        score = -loss / count;
        return members;
    }

    std::optional<Regressor> hitMapping() {
        const std::size_t hit = hits(), missed = samples_.size() - hit;
        if (std::min(hit, missed) < fewestOfEither) return constantHit(hit, missed);
        std::vector<int> best;
        if (!membersOf(KickPart::hit, network.heldOut.hit, &best)) return std::nullopt;
        std::ranges::sort(best);
        const LikelihoodData all = dataOf(KickPart::hit, kicksOf(KickPart::hit, [](std::size_t) { return true; }));
        auto mapping = learned(KickPart::hit, options_.folds, all, all, best[best.size() / 2]);
        if (!mapping) return std::nullopt;
        return std::move(mapping->regressor);
    }

    Regressor constantHit(std::size_t hit, std::size_t missed) {
        const double share = (static_cast<double>(hit) + 0.5) / (static_cast<double>(hit + missed) + 1);
        Mlp mlp{{static_cast<int>(KickState::inputs), 1, 1}, {}};
        mlp.parameters.assign(mlp.shape.parameterCount(), 0.0F);
        mlp.parameters.back() = static_cast<float>(normalQuantile(share));
        const auto n = static_cast<double>(hit + missed);
        network.heldOut.hit =
            (static_cast<double>(hit) * logarithm(share) + static_cast<double>(missed) * logarithm(1 - share)) / n;
        return mlp;
    }

    const std::vector<KickSample>& samples_;
    const KickTrainerOptions& options_;
    const Progress& progress_;
    double done_ = 0;
    std::int64_t epochs_ = 0;
};

}  // namespace

Expected<KickNetwork> trainKicker(const KickSamples& samples, const KickTrainerOptions& options,
                                  const Progress& progress) {
    if (const std::size_t hits = samples.hits(); hits < fewestHits)
        return fail("", "holds " + counted(hits, "tracked kick") + " that met a ball; learning needs " +
                            std::to_string(fewestHits));
    KickLearner learner(samples, options, progress);
    if (!learner.learn()) return fail("", "was not learned from: cancelled");
    const KickNetwork::HeldOut& heldOut = learner.network.heldOut;
    if (!std::isfinite(heldOut.delay + heldOut.departure + heldOut.hit))
        return fail("", "cannot be learned from: its likelihood is no number");
    mayGoOn(progress, 1);
    return std::move(learner.network);
}

}  // namespace mrose
