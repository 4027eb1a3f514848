#pragma once

#include <array>
#include <string_view>

namespace mrose {

/// The columns of a CSV log. Channels first, in the order of the values that a row carries.
enum class CsvColumn {
    vCommand,
    wCommand,
    x,
    y,
    heading,
    time,
    robot,
    trajectory,
    group,
    sensor,
    subject,
    range,
    bearing,
    reportedX,
    reportedY,
    reportedHeading,
    scanStart,
    scanStep,
    scan,
    kick,
    ballX,
    ballY
};
constexpr std::size_t csvChannels = 5;
constexpr std::array<std::string_view, 22> csvColumnNames = {
    "v_cmd",      "w_cmd",     "x",       "y",     "heading", "t",          "robot",      "trajectory",
    "group",      "sensor",    "subject", "range", "bearing", "reported_x", "reported_y", "reported_heading",
    "scan_start", "scan_step", "scan",    "kick",  "ball_x",  "ball_y"};

/// How a comment line above the header of a log that no real robot made begins.
constexpr std::string_view syntheticMark = "# synthetic";

/// Names where a file has no such column.
constexpr std::string_view defaultRobot = "robot", defaultTrajectory = "whole";

}  // namespace mrose
