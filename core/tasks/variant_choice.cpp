#include "tasks/variant_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace mrose {
namespace {

std::size_t bestOf(std::span<const double> values, bool greatest) {
    const auto at = greatest ? std::ranges::max_element(values) : std::ranges::min_element(values);
    return static_cast<std::size_t>(at - values.begin());
}

/// Means over some seeds of a trial, by variant.
std::vector<double> meansOver(const TaskData& data, std::size_t row, std::size_t firstSeed, std::size_t everySeed) {
    const std::size_t variants = data.variants.size();
    std::vector<double> sums(variants);
    std::size_t count = 0;
    for (std::size_t seed = firstSeed; seed < data.seeds; seed += everySeed, ++count)
        for (std::size_t k = 0; k < variants; ++k) sums[k] += data.bySeed[(row * data.seeds + seed) * variants + k];
    for (double& sum : sums) sum /= static_cast<double>(count);
    return sums;
}

double meanOf(const std::vector<double>& values, std::span<const std::size_t> drawn) {
    double sum = 0;
    for (const std::size_t i : drawn) sum += values[i];
    return sum / static_cast<double>(drawn.size());
}
double meanOf(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(std::max<std::size_t>(values.size(), 1));
}

}  // namespace

bool VariantChoice::beatsAll() const {
    return std::ranges::all_of(variants, [](const Variant& variant) { return variant.gainInterval.low > 0; });
}

VariantChoice judgeChoice(const TaskData& learnedFrom, const TaskData& judged, const std::vector<double>& predicted,
                          bool greatest) {
    const std::size_t variants = judged.variants.size(), rows = judged.rows();
    VariantChoice choice;
    choice.trials = rows;
    if (rows == 0) return choice;
    std::vector<double> before(variants);
    for (std::size_t i = 0; i < learnedFrom.y.size(); ++i) before[i % variants] += learnedFrom.y[i];
    choice.best = bestOf(before, greatest);

    std::vector<std::vector<double>> of(variants, std::vector<double>(rows));
    std::vector<double> chosen(rows), oracle(rows), agrees(rows), errors(variants), values(variants);
    choice.variants.resize(variants);
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t k = 0; k < variants; ++k) {
            of[k][row] = judged.y[row * variants + k];
            errors[k] += std::abs(predicted[row * variants + k] - of[k][row]);
            values[k] += std::abs(of[k][row]);
        }
        const std::size_t learned = bestOf(std::span(predicted).subspan(row * variants, variants), greatest);
        chosen[row] = of[learned][row];
        ++choice.variants[learned].chosen;
        for (std::size_t half = 0; half < 2 && judged.seeds > 1; ++half) {
            const std::size_t best = bestOf(meansOver(judged, row, half, 2), greatest);
            oracle[row] += meansOver(judged, row, 1 - half, 2)[best] / 2;
            agrees[row] += (best == learned ? 0.5 : 0);
        }
    }
    const double sign = greatest ? -1 : 1;
    choice.mean = meanOf(chosen);
    for (std::size_t k = 0; k < variants; ++k) {
        VariantChoice::Variant& variant = choice.variants[k];
        variant.name = judged.variants[k];
        variant.mean = meanOf(of[k]);
        variant.share = values[k] > 0 ? errors[k] / values[k] : std::numeric_limits<double>::quiet_NaN();
        variant.gain = sign * (variant.mean - choice.mean);
        variant.gainInterval = bootstrapInterval(rows, [&](std::span<const std::size_t> drawn) {
            return sign * (meanOf(of[k], drawn) - meanOf(chosen, drawn));
        });
    }
    if (judged.seeds < 2) return choice;
    const std::vector<double>& single = of[choice.best];
    ChoiceOracle& best = choice.oracle.emplace();
    best.mean = meanOf(oracle);
    best.agrees = meanOf(agrees);
    best.closed = (meanOf(single) - choice.mean) / (meanOf(single) - best.mean);
    best.closedInterval = bootstrapInterval(rows, [&](std::span<const std::size_t> drawn) {
        return (meanOf(single, drawn) - meanOf(chosen, drawn)) / (meanOf(single, drawn) - meanOf(oracle, drawn));
    });
    return choice;
}

}  // namespace mrose
