#pragma once

#include <string>

#include "diagnosis/compared_divergences.h"

namespace mrose {

/// One row per robot, rollout and step, where the robot was simulated: dataset,robot,t_start,t,x,y,heading as
/// predictions of logs have them, then where the real robot was, the errors (m, rad) and the simulated robot's name.
/// Cells about the real robot are empty where there is no ground truth.
std::string errorsCsv(const Comparison& comparison);

/// One row per robot and rollout: where it starts (on the log's clock and on the session's), what becomes of it, what
/// is known of its errors, touches; with `divergences` when it diverges, and the cause where it was looked for.
std::string rolloutsCsv(const Comparison& comparison, const ComparedDivergences* divergences = nullptr);

/// One row per look and subject, where sensors were compared: rollout,dataset,robot,t_start,sensor,stream,t,subject,
/// in_view,true_range_m,true_bearing_rad,reported,range_m,bearing_rad,simulated. `stream`: "real" or "simulated", whose
/// looks are at instants of their own; `t`: when it measured, since the rollout's start. Subjects are in view or
/// reported; a look that has none before it is a row without one.
std::string readingsCsv(const Comparison& comparison);

/// All figures, by robot and together, with sentences that a reader must know; with `divergences` where they diverge,
/// and what was tried. What is not defined is null.
std::string comparisonJson(const Comparison& comparison, const std::vector<std::string>& notices,
                           const ComparedDivergences* divergences = nullptr);

}  // namespace mrose
