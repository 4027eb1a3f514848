#include "assessment/detection_map.h"

#include <algorithm>
#include <cmath>

namespace mrose {

DetectionMap detectionMap(std::span<const LoggedCase> cases, std::span<const CaseScore> scores, const CaseRule& rule) {
    constexpr double degree = std::numbers::pi / 180;
    constexpr int mostParts = 40;
    DetectionMap map;
    map.rangeStep = std::max(0.5, rule.range / mostParts);
    map.bearingStep = std::max(5 * degree, 2 * rule.bearing / mostParts);
    map.ranges = static_cast<int>(std::ceil(rule.range / map.rangeStep - 1e-9));
    map.bearings = 2 * static_cast<int>(std::ceil(rule.bearing / map.bearingStep - 1e-9));
    map.firstBearing = -0.5 * map.bearings * map.bearingStep;
    map.cells.resize(static_cast<std::size_t>(map.ranges * map.bearings));
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const auto part = [](double value, double step, int parts) {
            return std::clamp(static_cast<int>(std::floor(value / step)), 0, parts - 1);
        };
        const int bearing = part(cases[i].bearing - map.firstBearing, map.bearingStep, map.bearings);
        const int range = part(cases[i].range, map.rangeStep, map.ranges);
        DetectionMap::Cell& cell = map.cells[static_cast<std::size_t>(bearing * map.ranges + range)];
        ++cell.cases;
        cell.real += cases[i].reported;
        cell.predicted += scores[i].probability;
    }
    for (DetectionMap::Cell& cell : map.cells) {
        const double count = static_cast<double>(std::max<std::size_t>(cell.cases, 1));
        cell.real /= count;
        cell.predicted /= count;
    }
    return map;
}

}  // namespace mrose
