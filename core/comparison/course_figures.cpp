#include "comparison/course_figures.h"

#include <algorithm>
#include <cmath>

#include "drawing/scene_drawing.h"
#include "evaluation/format.h"
#include "evaluation/html.h"
#include "evaluation/report_figures.h"
#include "evaluation/svg_plot.h"

namespace mrose {
namespace {

constexpr Colour realColour{20, 20, 20}, simulatedColour{0, 114, 178};

/// A robot's median errors, from the start on; not a number where none is known.
std::vector<PlotPoint> medianErrors(const Comparison& comparison, std::size_t robot, ErrorKind kind) {
    const bool position = kind == ErrorKind::position;
    std::vector<std::vector<double>> known;
    for (const ComparedCourse& course : comparison.courses) {
        if (course.robot != robot || course.simulated.empty()) continue;
        const std::vector<double>& errors = position ? course.errors.position : course.errors.heading;
        known.resize(std::max(known.size(), errors.size()));
        for (std::size_t k = 0; k < errors.size(); ++k)
            if (std::isfinite(errors[k])) known[k].push_back(errors[k]);
    }
    const double step = toSeconds(comparison.evaluation.options.windows.step);
    std::vector<PlotPoint> points{{0, 0}};
    for (std::size_t k = 0; k < known.size(); ++k)
        points.push_back({static_cast<double>(k + 1) * step, (position ? 100 : degrees) * quantile(known[k], 0.5)});
    return points;
}

/// Between heading arrows: a second; more where courses are long.
Nanoseconds arrowInterval(const Comparison& comparison) {
    int most = 0;
    for (const CourseRequest& request : comparison.requests) most = std::max(most, request.steps);
    const Nanoseconds longest = most * comparison.evaluation.options.windows.step;
    const Nanoseconds second = nanosecondsPerSecond;
    return longest > 30 * second   ? longest / 20 / second * second + second
           : longest >= 5 * second ? second
                                   : second / 5;
}

}  // namespace

std::string errorLinesLegend(const Comparison& comparison) {
    std::string entries;
    for (std::size_t i = 0; i < comparison.robots.size(); ++i)
        entries += lineEntry(seriesClass(i), comparison.robots[i].name);
    return element("div", "legend", entries);
}

std::string errorLinesFigure(const Comparison& comparison, ErrorKind kind) {
    const bool position = kind == ErrorKind::position;
    std::vector<std::vector<PlotPoint>> lines;
    PlotPoint most{0, 0};
    for (std::size_t i = 0; i < comparison.robots.size(); ++i) {
        lines.push_back(medianErrors(comparison, i, kind));
        for (const PlotPoint& point : lines.back())
            if (std::isfinite(point.y)) most = {std::max(most.x, point.x), std::max(most.y, point.y)};
    }
    SvgPlot plot({}, {0, most.x}, {0, 1.06 * most.y},
                 position ? "Position error against time" : "Heading error against time");
    plot.axes("time since the start (s)", position ? "position error (cm)" : "heading error (°)");
    for (std::size_t i = lines.size(); i-- > 0;) plot.line(lines[i], seriesClass(i));
    return plot.text();
}

std::string courseFigure(const Comparison& comparison, std::size_t request, const Environment& environment) {
    const Nanoseconds step = comparison.evaluation.options.windows.step;
    std::vector<DrawnPath> paths;
    for (const ComparedCourse& course : comparison.courses)
        if (course.request == request) paths.push_back({course.real.truth, realColour, false, {}});
    for (const ComparedCourse& course : comparison.courses) {
        if (course.request != request || course.simulated.empty()) continue;
        std::vector<Pose> poses{course.real.measuredPose};
        poses.insert(poses.end(), course.simulated.begin(), course.simulated.end());
        paths.push_back({std::move(poses), simulatedColour, true, comparison.robots[course.robot].name});
    }
    const CourseRequest& shown = comparison.requests[request];
    return drawPaths(environment, "Course " + std::to_string(request + 1),
                     secondsText(shown.steps * step, 0) + " s from " + secondsText(shown.start, 0) +
                         " s on; black: real, blue and dashed: simulated",
                     paths);
}

std::string robotFigure(const Comparison& comparison, const ComparedCourse& course) {
    const Nanoseconds every = arrowInterval(comparison) / comparison.evaluation.options.windows.step;
    return pathFigure({course.real.truth,
                       course.real.measuredPose,
                       {course.simulated},
                       static_cast<std::size_t>(std::max<Nanoseconds>(1, every))});
}

std::string robotFigureLegend(const Comparison& comparison) {
    const Nanoseconds between = arrowInterval(comparison);
    const std::string interval =
        between == nanosecondsPerSecond ? "second" : cat(secondsText(between, between < nanosecondsPerSecond), " s");
    return element(
        "div", "legend",
        cat(lineEntry("real", "real path"), lineEntry(seriesClass(0), "simulated path"), pathMarkEntries(interval)));
}

}  // namespace mrose
