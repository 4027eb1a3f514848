#pragma once

#include <span>
#include <vector>

#include "assessment/sensor_scores.h"

namespace mrose {

/// Which share of the subjects in each part of the field of view was reported, and would be by a model.
struct DetectionMap {
    struct Cell {
        std::size_t cases = 0;
        double real = 0, predicted = 0;  ///< shares; 0 where there are no cases
    };
    double rangeStep = 0.5, bearingStep = 0;  ///< m, rad
    int ranges = 0, bearings = 0;             ///< from 0 on, and from firstBearing on
    double firstBearing = 0;                  ///< rad: the least, on the right
    std::vector<Cell> cells;                  ///< by bearing, then by range

    const Cell& at(int bearing, int range) const { return cells[static_cast<std::size_t>(bearing * ranges + range)]; }
};

/// Over all that the rule asks for, by 0.5 m and 5 degrees, or wider where it is a very wide field of view.
DetectionMap detectionMap(std::span<const LoggedCase> cases, std::span<const CaseScore> scores, const CaseRule& rule);

}  // namespace mrose
