#include "overlay_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "comparison/other_models.h"
#include "evaluation/format.h"

namespace mrose::gui {
namespace {

OverlayRow overlayRow(const LogWorld& world, const ComparedCourse& course, const std::vector<CourseRequest>& requests,
                      const DivergenceOptions& options) {
    OverlayRow row;
    row.request = course.request;
    row.robot = course.robot;
    row.start = requests[course.request].start;
    row.use = course.use;
    row.position = knownMean(course);
    row.share = course.real.path > 0 && course.use != CourseUse::still ? 100 * row.position / course.real.path
                                                                       : std::numeric_limits<double>::quiet_NaN();
    row.heading = course.errors.headingMean;
    if (course.use == CourseUse::counted || course.use == CourseUse::still) row.manoeuvre = course.real.manoeuvre;
    row.divergence = firstDivergence(course, WindowOptions{}.step, courseBound(world, course, options));
    row.touched = course.touched.has_value();
    return row;
}

}  // namespace

Expected<std::vector<CourseRequest>> plannedCourses(const OverlayWorld& overlay, const OverlayPlan& plan) {
    const Nanoseconds step = WindowOptions{}.step;
    const Nanoseconds length = std::max<Nanoseconds>(1, std::llround(plan.length / toSeconds(step))) * step;
    if (plan.cut == OverlayPlan::Cut::windows) {
        WindowOptions options;
        options.horizon = length;
        std::vector<std::string> robots;
        for (const ComparedRobot& robot : overlay.world().robots()) robots.push_back(robot.realName);
        const auto windows = findWindows(*overlay.log, robots, options);
        if (!windows) return tl::unexpected(windows.error());
        auto courses = coursesOfWindows(overlay.world(), *windows);
        if (courses.empty()) return fail(overlay.place, "has no window of the scenario's robots");
        return courses;
    }
    StretchOptions options;
    options.start = fromSeconds(plan.start);
    if (plan.cut == OverlayPlan::Cut::every)
        options.every = length;
    else
        options.duration = length;
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

DivergenceBound courseBound(const LogWorld& world, const ComparedCourse& course, const DivergenceOptions& options) {
    return boundFor(world, course, options, WindowOptions{}.step).value_or(options.bound);
}

bool knowsHeldOut(const LogWorld& world) {
    for (std::size_t robot = 0; robot < world.robots().size(); ++robot)
        if (const MotionNetwork* network = networkOf(world, robot); network != nullptr && network->heldOut.position > 0)
            return true;
    return false;
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
