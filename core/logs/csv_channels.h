#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "io/error.h"
#include "logs/csv_format.h"
#include "logs/csv_rows.h"
#include "logs/log_reader.h"
#include "logs/robot_log.h"

namespace mrose {

/// One number of one channel.
struct StampedValue {
    Nanoseconds time = 0;
    double value = 0;
};

/// Samples as they stand in the files. Those of the file that is being read come last, each with its place in the text.
template <class Sample>
struct CsvStream {
    std::vector<Sample> samples;
    std::vector<const char*> places;

    void add(const Sample& sample, const char* place) {
        samples.push_back(sample);
        places.push_back(place);
    }
};

/// What the rows of one trajectory say: whole commands, whole poses, and values that stand alone in their row.
struct CsvChannels {
    CsvStream<StampedCommand> commands;
    CsvStream<StampedPose> poses;
    std::array<CsvStream<StampedValue>, csvChannels> alone;

    /// A row's cells by channel; nullptr where the file has no such column.
    void add(Nanoseconds time, const std::array<const CsvCell*, csvChannels>& cells, const char* place);
};

/// To be called at the end of each file: brings its samples in order among those of earlier files. Error: they run
/// backwards in time for good.
Expected<void> endFile(CsvChannels& channels, std::string_view content, const std::string& name, LogDefects& defects);

/// The trajectory's commands and poses, conditioned. Values that stand alone are paired: v and w hold until their next
/// one; y and heading are interpolated at the instants of x, not across more than LogOptions::poseGap.
void merge(CsvChannels& channels, const LogOptions& options, Trajectory& trajectory, LogDefects& defects);

}  // namespace mrose
