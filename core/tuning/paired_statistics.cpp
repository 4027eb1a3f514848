#include "tuning/paired_statistics.h"

#include <algorithm>
#include <cmath>

#include "geometry/normal_distribution.h"

namespace mrose {
namespace {

struct MeanAndError {
    double mean = 0, error = 0;  ///< the mean's standard error
};

MeanAndError meanAndError(std::span<const double> values) {
    const auto count = static_cast<double>(values.size());
    double mean = 0, squares = 0;
    for (const double value : values) mean += value / count;
    for (const double value : values) squares += (value - mean) * (value - mean);
    return {mean, std::sqrt(squares / (count - 1) / count)};
}

}  // namespace

double studentQuantile(double p, std::int64_t degrees) {
    const double z = normalQuantile(p), n = static_cast<double>(degrees), z2 = z * z;
    const double first = z * (z2 + 1) / 4;
    const double second = z * ((5 * z2 + 16) * z2 + 3) / 96;
    const double third = z * (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384;
    const double fourth = z * ((((79 * z2 + 776) * z2 + 1482) * z2 - 1920) * z2 - 945) / 92160;
    return z + (first + (second + (third + fourth / n) / n) / n) / n;
}

MeanInterval meanInterval(std::span<const double> values) {
    const auto [mean, error] = meanAndError(values);
    const double half = studentQuantile(0.975, std::ssize(values) - 1) * error;
    return {mean, mean - half, mean + half};
}

std::vector<double> differences(std::span<const double> a, std::span<const double> b) {
    std::vector<double> all(std::min(a.size(), b.size()));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = a[i] - b[i];
    return all;
}

Race::Race(std::uint32_t trials, bool drops) {
    for (std::uint32_t look = firstLook; drops && look < trials; look *= 2) looks_.push_back(look);
    looks_.push_back(trials);
}

bool Race::drops(std::span<const double> costs, std::span<const double> incumbent) const {
    const auto looks = static_cast<double>(looks_.size() - 1);
    if (looks == 0 || costs.size() < firstLook) return false;
    const auto [mean, error] = meanAndError(differences(costs, incumbent));
    return mean > studentQuantile(1 - falseDrops / looks, std::ssize(costs) - 1) * error;
}

}  // namespace mrose
