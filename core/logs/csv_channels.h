#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "io/error.h"
#include "logs/csv_cells.h"
#include "logs/csv_stream.h"
#include "logs/log_reader.h"
#include "logs/robot_log.h"

namespace mrose {

/// One number of one channel.
struct StampedValue {
    Nanoseconds time = 0;
    double value = 0;
};

/// What the rows of one trajectory say: whole commands, whole poses, and values that stand alone in their row.
struct CsvChannels {
    CsvStream<StampedCommand> commands;
    CsvStream<StampedPose> poses;
    std::array<CsvStream<StampedValue>, csvChannels> alone;
    CsvStream<StampedKick> kicks;
    CsvStream<StampedBall> ball;

    /// A row with a time. Whether it has a value of any channel. Error: half of a ball's position, no power of a kick.
    Expected<bool> add(const CsvRows& rows, const CsvCells& cells);
};

/// To be called at the end of each file: brings its samples in order among those of earlier files. Error: they run
/// backwards in time for good.
Expected<void> endFile(CsvChannels& channels, std::string_view content, const std::string& name, LogDefects& defects);

/// The trajectory's commands, poses, kicks and ball, conditioned. Values that stand alone are paired: v and w hold
/// until their next one; y and heading are interpolated at the instants of x, not across more than LogOptions::poseGap.
void merge(CsvChannels& channels, const LogOptions& options, Trajectory& trajectory, LogDefects& defects);

}  // namespace mrose
