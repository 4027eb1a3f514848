#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assessment/evaluate.h"

namespace mrose {

/// CSS class of the n-th model: s0 is the model of the report, the others are what it is compared with.
std::string seriesClass(std::size_t model);

/// The model's name behind a sample of its line.
std::string modelName(const Evaluation& evaluation, std::size_t model);

std::string modelLegend(const Evaluation& evaluation);
std::string pathLegend(const Evaluation& evaluation);
std::string manoeuvreLegend();

enum class Channel { position, heading };

/// Error against time: the first model's 10-90 % and 25-75 % bands and every model's median. cm or degrees.
std::string errorOverTimeFigure(const Evaluation& evaluation, Channel channel);

/// Part of the windows with an error up to x: position, time-mean over path in %; heading at the end in degrees.
std::string cumulativeFigure(const Evaluation& evaluation, Channel channel);

/// One bar per window of one robot in the log's order: the first model's time-mean position error in cm.
std::string barsFigure(const Evaluation& evaluation, std::size_t robot, double highest);
double highestBar(const Evaluation& evaluation);  ///< cm, the same scale for all robots

/// Entries of a legend: a sample of a line, of a class, and what it is.
std::string lineEntry(std::string_view cssClass, std::string_view label);
/// A legend's entries of what pathFigure draws beside lines; `interval` as "second", "0.2 s".
std::string pathMarkEntries(std::string_view interval);

/// Real and predicted paths on equal axes, with heading arrows every so many poses and the first prediction's error at
/// the end; paths are interrupted where a pose is not finite.
struct PathFigure {
    std::span<const Pose> real;
    Pose start;                                         ///< of the predictions
    std::vector<std::span<const Pose>> predicted = {};  ///< the first is the one that matters
    std::vector<std::size_t> models = {0};              ///< whose they are: the series of each
    std::size_t arrowEvery = 10;
    std::optional<std::size_t> leaves = {};  ///< where the first prediction leaves the real path, in it: a ring
};
std::string leavesEntry();  ///< of a legend
std::string pathFigure(const PathFigure& figure);

/// Real and predicted path of one window on equal axes, heading arrows every second.
std::string pathFigure(const Evaluation& evaluation, std::size_t window);

/// Models whose paths are drawn: the first, and of the others the best by P.
std::vector<std::size_t> drawnModels(const Evaluation& evaluation);

/// "12.5": seconds from the start of the window's drive, to a tenth.
std::string sinceDriveStart(const Evaluation& evaluation, std::size_t window);

}  // namespace mrose
