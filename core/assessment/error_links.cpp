#include "assessment/error_links.h"

#include <algorithm>
#include <cmath>

#include "geometry/normal_distribution.h"

namespace mrose {
namespace {

constexpr Nanoseconds longestPause = nanosecondsPerSecond;
constexpr std::size_t fewestPairs = 30;

/// About zero: a bias that the prediction does not know goes together, too.
class LinkSum {
public:
    void add(double a, double b, double model) {
        ++pairs_;
        product_ += a * b;
        first_ += a * a;
        second_ += b * b;
        model_ += model;
    }
    ErrorLink link(bool modelled) const {
        if (pairs_ < fewestPairs) return {pairs_, NAN, NAN};
        const double size = std::sqrt(first_ * second_);
        return {pairs_, size > 0 ? product_ / size : NAN, modelled ? model_ / static_cast<double>(pairs_) : NAN};
    }

private:
    std::size_t pairs_ = 0;
    double product_ = 0, first_ = 0, second_ = 0, model_ = 0;
};

double normalScore(const CaseScore& score, std::size_t dimension) {
    return normalQuantile(std::clamp(score.below[dimension], 1e-4, 1 - 1e-4));
}

}  // namespace

ErrorLinks errorLinks(const LoggedCases& cases, std::span<const CaseScore> scores, std::size_t dimension,
                      const ReadingNoises* noises, std::optional<std::size_t> robot) {
    const ReadingNoise noise = noises == nullptr ? ReadingNoise{} : (*noises)[1 + dimension];
    LinkSum next, beside;
    const auto forEachSound = [&](const LoggedLook& look, std::size_t from, const auto& use) {
        for (std::size_t i = from; i < look.first + look.count; ++i)
            if (cases.cases[i].sound) use(i, normalScore(scores[i], dimension));
    };
    for (std::size_t l = 0; l < cases.looks.size(); ++l) {
        const LoggedLook& look = cases.looks[l];
        if (robot && look.robot != *robot) continue;
        const LoggedLook* const before = l == 0 ? nullptr : &cases.looks[l - 1];
        const bool follows = before != nullptr && before->robot == look.robot &&
                             before->trajectory == look.trajectory && look.time - before->time <= longestPause;
        const double pause = follows ? toSeconds(look.time - before->time) : 0;
        const double lasts =
            noise.slow * decay(pause / noise.slowTime) + noise.subject * decay(pause / noise.subjectTime);
        forEachSound(look, look.first, [&](std::size_t i, double score) {
            forEachSound(look, i + 1,
                         [&](std::size_t, double other) { beside.add(score, other, noise.look + noise.slow); });
            if (!follows) return;
            forEachSound(*before, before->first, [&](std::size_t k, double earlier) {
                if (cases.cases[k].subject == cases.cases[i].subject) next.add(earlier, score, lasts);
            });
        });
    }
    return {next.link(noises != nullptr), beside.link(noises != nullptr)};
}

MeanErrors meanErrors(const LoggedCases& cases, std::span<const CasePrediction> predictions,
                      std::span<const CaseScore> scores, std::size_t robot) {
    MeanErrors mean;
    double count = 0;
    for (const LoggedLook& look : cases.looks) {
        if (look.robot != robot) continue;
        for (std::size_t i = look.first; i < look.first + look.count; ++i) {
            if (!cases.cases[i].sound) continue;
            ++count;
            for (std::size_t d = 0; d < readingDimensions; ++d) {
                mean.real[d] += scores[i].error[d];
                mean.predicted[d] += predictions[i].distribution.mean(static_cast<int>(d));
            }
        }
    }
    for (std::size_t d = 0; d < readingDimensions; ++d) {
        mean.real[d] = count > 0 ? mean.real[d] / count : NAN;
        mean.predicted[d] = count > 0 ? mean.predicted[d] / count : NAN;
    }
    return mean;
}

}  // namespace mrose
