#pragma once

#include <filesystem>
#include <string>

#include "assessment/sensor_assessment.h"
#include "report/page.h"

namespace mrose {

/// As checkReportFolder() of motion models.
Expected<void> checkSensorReportFolder(const std::filesystem::path& folder, bool overwrite = true);

/// Writes report.html (one file that needs nothing else), results.csv (the scores of models and robots), results.json
/// (all figures) and cases.csv (what was and what was predicted) into `folder`, which is made where it is missing.
Expected<void> writeSensorReport(const SensorEvaluation& evaluation, const ReportContext& context,
                                 const std::filesystem::path& folder);

std::string sensorReportHtml(const SensorEvaluation& evaluation, const ReportContext& context);

}  // namespace mrose
