#include "reality/overlay_rows.h"

#include <algorithm>
#include <cmath>

#include "comparison/other_models.h"
#include "evaluation/format.h"

namespace mrose::gui {
namespace {

FieldArea areaOf(const ComparedCourse& course) {
    FieldArea area{{1, 1}, {-1, -1}};
    for (const std::vector<Pose>* poses : {&course.real.truth, &course.simulated})
        for (const Pose& pose : *poses)
            if (std::isfinite(pose.x) && std::isfinite(pose.y)) area.include(position(pose));
    return area;
}

OverlayRow overlayRow(const LogWorld& world, const ComparedCourse& course, const std::vector<CourseRequest>& requests,
                      const DivergenceOptions& options) {
    OverlayRow row;
    row.course = course.request;
    row.robot = course.robot;
    row.take = requests[course.request].take;
    row.start = requests[course.request].start;
    row.use = course.use;
    if (const double mean = knownMean(course); mean >= 0) row.position = mean;
    if (row.position && course.real.path > 0 && course.use != CourseUse::still)
        row.share = 100 * *row.position / course.real.path;
    if (std::isfinite(course.errors.headingMean)) row.heading = course.errors.headingMean;
    if (course.use == CourseUse::counted || course.use == CourseUse::still) row.manoeuvre = course.real.manoeuvre;
    row.bound = boundFor(world, course, options, WindowOptions{}.step);
    row.divergence = firstDivergence(course, WindowOptions{}.step, row.bound);
    row.touched = course.touched.has_value();
    row.area = areaOf(course);
    return row;
}

Nanoseconds wholeSteps(double seconds) {
    const Nanoseconds step = WindowOptions{}.step;
    return std::max<Nanoseconds>(1, std::llround(seconds / toSeconds(step))) * step;
}

}  // namespace

OverlayPlan suitedPlan(const OverlayWorld& overlay) {
    OverlayPlan plan;
    const auto length = windowsThatSuit(overlay.world(), wholeSteps(plan.length));
    if (!length) return plan;
    plan.length = std::round(10 * toSeconds(*length)) / 10;  // as one reads it
    for (const OverlayPlan::Cut cut : {OverlayPlan::Cut::windows, OverlayPlan::Cut::every, OverlayPlan::Cut::once}) {
        plan.cut = cut;
        if (plannedCourses(overlay, plan)) break;
    }
    return plan;
}

Expected<std::vector<CourseRequest>> plannedCourses(const OverlayWorld& overlay, const OverlayPlan& plan) {
    const Nanoseconds length = wholeSteps(plan.length);
    if (plan.cut == OverlayPlan::Cut::windows) return coursesOfAllWindows(overlay.world(), length);
    StretchOptions options;
    options.start = fromSeconds(plan.start);
    if (plan.cut == OverlayPlan::Cut::every) {
        options.every = length;
        if (plan.stretch) options.duration = wholeSteps(*plan.stretch);
    } else {
        options.duration = length;
    }
    auto courses = coursesOf(overlay.world(), options);
    // Said of what the window has, not of flags.
    if (!courses && plan.cut == OverlayPlan::Cut::every)
        courses.error().cause = "no course of " + secondsText(length) + " s fits in from " +
                                secondsText(options.start) + " s on; expected an earlier start or shorter courses";
    else if (!courses)
        courses.error().cause =
            "the ground truth ends before " + secondsText(options.start) + " s; expected an earlier start";
    return courses;
}

std::vector<OverlayRow> overlayRows(const LogWorld& world, std::span<const ComparedCourse> courses,
                                    const std::vector<CourseRequest>& requests, const DivergenceOptions& options) {
    std::vector<Window> windows;
    for (const ComparedCourse& course : courses) windows.push_back(course.real);
    classifyManoeuvres(world.log(), windows, WindowOptions{}.step);
    std::vector<OverlayRow> rows;
    for (std::size_t i = 0; i < courses.size(); ++i) {
        if (courses[i].use == CourseUse::absent) continue;
        rows.push_back(overlayRow(world, courses[i], requests, options));
        if (rows.back().manoeuvre) rows.back().manoeuvre = windows[i].manoeuvre;
    }
    return rows;
}

}  // namespace mrose::gui
