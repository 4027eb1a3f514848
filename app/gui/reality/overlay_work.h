#pragma once

#include <functional>
#include <span>
#include <vector>

#include "reality/overlay_models.h"
#include "reality/overlay_rows.h"

namespace mrose::gui {

// What an overlay has done in other threads: of values, and told now and then whether it is still wanted.

using Progress = std::function<bool(double share)>;  ///< false: it is to end

/// The courses of a plan driven as `mrose compare` does; rows of those that are done. Error: as of compare().
Expected<Comparison> compareCourses(const OverlayWorld& overlay, const std::vector<CourseRequest>& requests,
                                    const DivergenceOptions& bounds,
                                    const std::function<bool(std::vector<OverlayRow> rows, double share)>& tell);

/// How true a model is. What is known of it already is left out: `compared` of the scenario's own.
OverlayModel::Figures judge(const OverlayWorld& overlay, const OverlayModel& model,
                            const std::vector<CourseRequest>& requests, Nanoseconds horizon, const Progress& progress);

/// Of which robot it is asked why it leaves the real course, and what else it might have moved by.
struct CauseQuestion {
    CourseRequest request;
    OverlayRow row;
    DivergenceOptions bounds;
    std::vector<OverlayModel> models;
};
/// Error: as of compare() and diagnose().
Expected<Diagnosis> whyItLeaves(const OverlayWorld& overlay, const CauseQuestion& question, const Progress& progress);

/// A log with its courses, and one of them as a run.
struct OpenedLog {
    OverlayWorldPointer world;
    OverlayPlan plan;
    std::vector<CourseRequest> requests;
    std::size_t course = 0;
    OpenRun run;
};
/// Its first course; `asked`: none, then the plan that suits it. Error, and `untold`: as of openOverlayWorld(); no
/// course of the plan fits in; the first one cannot be opened.
Expected<OpenedLog> openLogAsRun(const OverlayRequest& request, const std::optional<OverlayPlan>& asked, bool restarts,
                                 const OpenProgress& progress, bool& untold);

/// What a robot is told does not end with a course after which no other begins.
bool isToldOn(const OverlayPlan& plan, bool restarts);

/// A log and its scenario once more from their files, with the course that was shown.
/// The course of `shown`'s start, of trajectory and robot by their names. Error: a file; there is no such course now.
Expected<OpenedLog> reopen(const OverlayWorld& before, const OverlayPlan& plan, const CourseRequest& shown,
                           bool restarts, const std::function<bool()>& goesOn);

}  // namespace mrose::gui
