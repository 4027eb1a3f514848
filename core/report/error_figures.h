#pragma once

#include <string>

#include "assessment/evaluate.h"
#include "diagnosis/compared_divergences.h"

namespace mrose {

// How large errors are, as plots. Positions are in cm, headings in degrees.

enum class ErrorChannel { position, heading };

/// Whether the first model has a noise of its own, from which it knows how large its errors are.
bool foreseesErrors(const Evaluation& evaluation);

/// Error against time: the first model's 10-90 % and 25-75 % bands and every model's median. The bands are what it
/// foresees, with the real shares as thin lines; without a noise they are the real ones.
std::string errorOverTimeFigure(const Evaluation& evaluation, ErrorChannel channel);
/// The same of a comparison, a line for each robot: the median of its rollouts at each instant at which some are known,
/// which is the error itself where it has but one. With `divergences` the bound, where it is a constant, and a ring
/// where a robot leaves a single rollout by that error.
std::string errorOverTimeFigure(const Comparison& comparison, ErrorChannel channel,
                                const ComparedDivergences* divergences = nullptr);

std::string modelLegend(const Evaluation& evaluation);
std::string errorOverTimeLegend(const Evaluation& evaluation);
std::string robotLegend(const Comparison& comparison, const ComparedDivergences* divergences = nullptr);

/// Part of the windows with an error up to x: position, time-mean over path in %; heading at the end in degrees.
std::string cumulativeFigure(const Evaluation& evaluation, ErrorChannel channel);

/// One bar per window of one robot in the log's order: the first model's time-mean position error.
std::string barsFigure(const Evaluation& evaluation, std::size_t robot, double highest);
double highestBar(const Evaluation& evaluation);  ///< the same scale for all robots
std::string manoeuvreLegend();

/// "12.5": seconds from the start of the window's drive, to a tenth.
std::string sinceDriveStart(const LogWindows& log, std::size_t window);

/// The step after which a rollout has left the real one: an index into its errors and its simulated poses.
std::optional<std::size_t> stepLeft(const Comparison& comparison, std::size_t rollout,
                                    const ComparedDivergences* divergences);

}  // namespace mrose
