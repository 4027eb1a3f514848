#include "identification/nearest_seen.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "geometry/elementary.h"

namespace mrose {
namespace {

constexpr std::size_t fewest = 20;  // nearer cases
constexpr double farAway = 0.9;     // share of the cases that are too far to tell
constexpr double clearer = 4;       // times as often reported
// Of the logarithm of the likelihood: cases follow one another in time, and say less than independent ones.
constexpr double leastGain = 10;

/// The logarithm of the likelihood of so many reports, at the share that they are.
double likelihood(double reports, double cases) {
    const auto part = [&](double count) { return count > 0 ? count * logarithm(count / cases) : 0; };
    return part(reports) + part(cases - reports);
}

}  // namespace

double nearestSeen(const SensorSamples& samples, const View& view) {
    std::vector<std::pair<double, bool>> cases;  // range, and whether it was reported
    for (const SampledLook& look : samples.looks)
        for (std::size_t i = look.first; i < look.first + look.count && !look.unknown; ++i) {
            const SensorCase& one = samples.cases[i];
            if (view.holds(one.state.range, one.state.bearing) && one.state.clearance > 0)
                cases.emplace_back(one.state.range, one.reported);
        }
    std::ranges::sort(cases);
    cases.resize(static_cast<std::size_t>((1 - farAway) * static_cast<double>(cases.size())));
    const double all = static_cast<double>(cases.size());
    const double reports = static_cast<double>(std::ranges::count(cases, true, &std::pair<double, bool>::second));
    double nearest = 0, best = likelihood(reports, all) + leastGain, near = 0;
    for (std::size_t i = 0; i + fewest < cases.size(); ++i) {
        near += cases[i].second ? 1 : 0;
        const double count = static_cast<double>(i) + 1;
        if (i + 1 < fewest || clearer * near * (all - count) > (reports - near) * count) continue;
        const double split = likelihood(near, count) + likelihood(reports - near, all - count);
        if (split > best) best = split, nearest = 0.5 * (cases[i].first + cases[i + 1].first);
    }
    return nearest;
}

}  // namespace mrose
