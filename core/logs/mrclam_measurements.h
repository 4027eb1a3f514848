#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/error.h"
#include "logs/robot_log.h"

namespace mrose {

/// The camera of an MRCLAM robot: its name in a log, and how far apart its looks are [s]. Stamps within `lookSpan` are
/// of one look.
inline constexpr const char* mrclamCamera = "camera";
inline constexpr double mrclamCameraPeriod = 0.236;
inline constexpr Nanoseconds lookSpan = 50'000'000;

/// A row of Robot<N>_Measurement.dat.
struct BarcodeReading {
    Nanoseconds time = 0;
    int barcode = 0;
    double range = 0, bearing = 0;  ///< m, rad
};

/// Which subject carries a barcode: a row of Barcodes.dat.
struct SubjectBarcode {
    int subject = 0, barcode = 0;
};

/// A row of Landmark_Groundtruth.dat, without its standard deviations.
struct LandmarkPosition {
    int subject = 0;
    Point position;  ///< m
};

/// The rows of such files, as they stand. Error: a wrong row, with file, line and column; also a barcode or subject
/// that is no whole number, or is there twice, a negative range, a bearing that is not in radians, time running
/// backwards for good.
Expected<std::vector<BarcodeReading>> parseMrclamMeasurements(std::string_view content, const std::string& name,
                                                              SensorDefects& defects);
Expected<std::vector<SubjectBarcode>> parseMrclamBarcodes(std::string_view content, const std::string& name,
                                                          SensorDefects& defects);
Expected<std::vector<LandmarkPosition>> parseMrclamLandmarks(std::string_view content, const std::string& name,
                                                             SensorDefects& defects);

/// Reads what the cameras reported into a log of the folder's robots, with its subjects: Robot<N>_Measurement.dat,
/// Barcodes.dat and Landmark_Groundtruth.dat. A log without such files stays as it is; Log::incomplete says what is
/// missing where some are there. Error: the first thing wrong with a file; readings of another time than the robot's
/// commands and poses.
Expected<void> readMrclamMeasurements(Log& log, const std::filesystem::path& folder);

}  // namespace mrose
