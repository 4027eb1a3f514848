#pragma once

#include <deque>
#include <string>
#include <string_view>

#include "logs/csv_cells.h"
#include "logs/csv_stream.h"
#include "logs/csv_subjects.h"
#include "logs/log_reader.h"
#include "logs/looks.h"

namespace mrose {

/// What the rows of one trajectory say of its robot's sensors.
class CsvSensors {
public:
    /// A row with a sensor. Error: a cell that is wrong or lacks its partners.
    Expected<void> add(const CsvRows& rows, const CsvCells& cells, CsvSubjects& subjects, const std::string& file);

    /// To be called at the end of each file. Error: a sensor's rows run backwards in time for good.
    Expected<void> endFile(std::string_view content, const std::string& name);

    /// Adds the sensors to their trajectory, in the order of their first rows. Error: one of another time.
    Expected<void> finish(Trajectory& trajectory, const LogOptions& options);

private:
    struct Sensor {
        SensorLog log;
        CsvStream<StampedReading> readings;
        CsvStream<StampedPose> poses;
        CsvStream<LogScan> scans;
        std::string file = {};  // and line, of its first row
        int line = 0;
    };
    Sensor& select(std::string_view name, const CsvRows& rows, const std::string& file);

    std::deque<Sensor> sensors_;
    Sensor* sensor_ = nullptr;  // of the row before
};

/// Whether a row has a cell that only a sensor fills.
bool hasReport(const CsvCells& cells);

}  // namespace mrose
