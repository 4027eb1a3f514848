#include "learning/sample_scores.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <vector>

namespace mrose {
namespace {

/// Of each pair of samples in half their mean distance; none where there are no pairs.
double shareOfPair(std::size_t samples, bool antithetic) {
    const auto count = static_cast<double>(samples), partners = count - (antithetic ? 2 : 1);
    return partners > 0 ? 1 / (count * partners) : 0;
}

}  // namespace

double energyScore(std::span<const Point> samples, const Point& truth, double weight, std::span<Point> gradient,
                   bool antithetic) {
    constexpr double nothing = 1e-12;  // of coinciding points, which have no direction
    const auto count = static_cast<double>(samples.size());
    const bool differentiates = !gradient.empty();
    assert(!differentiates || gradient.size() == samples.size());
    const auto pull = [&](std::size_t i, double x, double y) {
        gradient[i].x += x;
        gradient[i].y += y;
    };
    double errors = 0, spread = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double x = samples[i].x - truth.x, y = samples[i].y - truth.y;
        const double distance = std::sqrt(x * x + y * y) + nothing, by = weight / (count * distance);
        errors += distance;
        if (differentiates) pull(i, by * x, by * y);
    }
    const double pair = shareOfPair(samples.size(), antithetic);
    const std::size_t opposite = antithetic ? samples.size() / 2 : samples.size();
    for (std::size_t i = 1; i < samples.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            if (i - j == opposite) continue;
            const double x = samples[i].x - samples[j].x, y = samples[i].y - samples[j].y;
            const double distance = std::sqrt(x * x + y * y) + nothing, by = weight * pair / distance;
            spread += distance;
            if (!differentiates) continue;
            pull(i, -by * x, -by * y);
            pull(j, by * x, by * y);
        }
    return errors / count - spread * pair;
}

double rankedScore(std::span<const double> samples, double truth, double weight, std::span<double> gradient,
                   bool antithetic) {
    const auto count = static_cast<double>(samples.size());
    assert(gradient.empty() || gradient.size() == samples.size());
    std::vector<std::size_t> order(samples.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return samples[a] < samples[b]; });
    const double pair = shareOfPair(samples.size(), antithetic);
    double score = 0;
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        const double sample = samples[order[rank]], ahead = 2 * static_cast<double>(rank) + 1 - count;
        score += std::abs(sample - truth) / count - pair * ahead * sample;
        if (!gradient.empty()) gradient[order[rank]] += weight * ((sample > truth ? 1 : -1) / count - pair * ahead);
    }
    const std::size_t half = antithetic ? samples.size() / 2 : 0;
    for (std::size_t i = 0; i < half; ++i) {
        const double apart = samples[i] - samples[i + half], by = weight * pair * (apart > 0 ? 1 : -1);
        score += pair * std::abs(apart);
        if (gradient.empty()) continue;
        gradient[i] += by;
        gradient[i + half] -= by;
    }
    return score;
}

}  // namespace mrose
