#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "assessment/detection_map.h"
#include "assessment/error_bands.h"
#include "assessment/error_links.h"
#include "assessment/logged_cases.h"
#include "assessment/sensor_model.h"
#include "assessment/sensor_scores.h"
#include "io/progress.h"

namespace mrose {

/// What one model made of the cases, and how good that is.
struct SensorAssessment {
    static constexpr std::size_t belowParts = 20;

    std::string name;
    std::vector<CasePrediction> predictions;  ///< by case, as the next one
    std::vector<CaseScore> scores;
    SensorScores all;
    std::vector<SensorScores> byRobot;                              ///< by LoggedCases::robots
    std::array<std::vector<std::size_t>, readingDimensions> below;  ///< belowHistogram()
};

/// A look that a page shows, seen from its robot: x ahead, y to the left.
struct ShownLook {
    std::size_t look = 0;        ///< in LoggedCases::looks
    Nanoseconds sinceStart = 0;  ///< of its drive
    std::vector<Point> robots;   ///< the other ones, m, as far as the log says where they were
};

/// Several models against the same cases. Bands, links, means, map and look are of the first.
struct SensorEvaluation {
    LoggedCases log;
    std::vector<SensorAssessment> models;
    View view;                                                                   ///< of the first
    std::array<std::array<std::vector<ErrorBand>, 2>, readingDimensions> bands;  ///< by dimension, then by BandAxis
    std::array<ErrorLinks, readingDimensions> links;
    std::vector<std::array<ErrorLinks, readingDimensions>> linksByRobot;  ///< by LoggedCases::robots, as the next one
    std::vector<MeanErrors> means;
    DetectionMap map;
    ShownLook shown;  ///< the one with the most readings
};

struct NamedSensor {
    std::string name;
    const SensorModel* model = nullptr;
};

/// Predictions use the ground truth of all robots of the log up to 0.2 s beyond a look's stamp, and none of its
/// readings. Runs in the caller's oneTBB arena. Error: ended by `progress`.
Expected<SensorEvaluation> evaluateSensors(const Log& log, LoggedCases cases, std::span<const NamedSensor> models,
                                           const Progress& progress = {});

}  // namespace mrose
