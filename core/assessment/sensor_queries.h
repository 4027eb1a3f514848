#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/error.h"
#include "perception/learned_sensor.h"
#include "perception/logged_view.h"

namespace mrose {

using SensorMeasures = SensorNetwork::Measures;

/// What a sensor is asked to predict: would it report this subject, or its robot's own pose, at this look, and how?
struct SensorQuery {
    int dataset = 0;             ///< 0 of an own pose
    std::string robot, subject;  ///< subject: empty of an own pose
    Nanoseconds time = 0;        ///< the look's stamp
    int line = 0;                ///< where it stands in its file
};

/// Reads CSV with the columns dataset, robot, t, subject in any order, of own poses robot and t; others are not needed.
/// Error with line and column: a missing column, a wrong number of cells, something that is not a number.
Expected<std::vector<SensorQuery>> readQueries(const std::filesystem::path& file, SensorMeasures measures);
Expected<std::vector<SensorQuery>> parseQueries(std::string_view content, const std::string& fileName,
                                                SensorMeasures measures = SensorMeasures::subjects);

/// The distribution of each query's reading, with what is true. A prediction uses the ground truth of all robots of the
/// log up to the query's stamp and 0.2 s beyond it, and none of its readings. Error with the query's line in
/// `fileName`: another data set, an unknown robot or subject, no ground truth at its stamp or, of a pose,
/// at the instant that it is of.
struct SensorPrediction {
    SensedState state;  ///< range 0: nothing is known of the subject's place
    ReadingDistribution distribution;
    bool inView = false;  ///< false: it is not reported. Own poses always are
};
Expected<std::vector<SensorPrediction>> predictQueries(const LearnedSensor& sensor, const LoggedView& view,
                                                       std::span<const SensorQuery> queries,
                                                       const std::string& fileName);

/// dataset,robot,t,subject,p_detect,sample,range_m,bearing_rad, of own poses robot,t,p_report,sample,x,y,heading:
/// `samples` independent draws for each query of the reading that it would be, by counters of the seed.
std::string sensorSamplesCsv(SensorMeasures measures, std::span<const SensorQuery> queries,
                             std::span<const SensorPrediction> predictions, int samples, std::uint64_t seed);

}  // namespace mrose
