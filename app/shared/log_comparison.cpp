#include "shared/log_comparison.h"

#include <algorithm>

#include "evaluation/format.h"
#include "shared/log_files.h"
#include "shared/notices.h"
#include "shared/resources.h"
#include "version.h"

namespace mrose {
namespace {

/// What must be known before the figures are believed. `asked`: how long a course was to be.
std::vector<std::string> noticesAbout(const LogWorld& world, const Comparison& comparison,
                                      std::optional<Nanoseconds> asked) {
    // Only the robots that are compared need to be known.
    Log compared = world.log();
    std::erase_if(compared.robots, [&](const RobotLog& robot) {
        return std::none_of(world.robots().begin(), world.robots().end(),
                            [&](const ComparedRobot& r) { return r.realName == robot.robot; });
    });
    std::vector<std::string> notices;
    if (compared.synthetic)
        notices.push_back("The log comes from a simulated robot: nothing here tells of a real one.");
    const Nanoseconds length = comparison.requests.front().steps * comparison.evaluation.options.windows.step;
    if (asked && length < *asked)
        notices.push_back("The ground truth ends " + secondsText(length) +
                          " s after the start: compared up to there, not " + secondsText(*asked, 0) + " s.");
    for (const MotionNetwork* network : networksOf(world.parts()))
        for (std::string& notice : noticesOf(*network, compared))
            if (std::find(notices.begin(), notices.end(), notice) == notices.end())
                notices.push_back(std::move(notice));
    return notices;
}

Expected<std::vector<CourseRequest>> coursesAsked(const LogComparisonRequest& request, const LogWorld& world) {
    constexpr double windowLength = 10;
    if (request.windows.empty()) {
        StretchOptions options;
        options.start = fromSeconds(request.start);
        if (request.duration) options.duration = fromSeconds(*request.duration);
        if (request.every) options.every = fromSeconds(*request.every);
        if (!request.duration && !request.every)
            options.duration = std::max(options.step, world.parts().duration / options.step * options.step);
        return coursesOf(world, options);
    }
    auto windows = readWindows(request.windows);
    if (!windows) return tl::unexpected(windows.error());
    const Nanoseconds length = fromSeconds(request.duration.value_or(windowLength)), step = WindowOptions{}.step;
    if (length % step != 0)
        return fail({}, secondsText(length) + " s is no whole number of steps of " + secondsText(step) + " s", 0,
                    "--duration");
    return requestedCourses(world, std::move(*windows), request.robots, static_cast<int>(length / step),
                            request.windows);
}

/// An error that names no file is of this one.
tl::unexpected<Error> errorOf(Error error, const std::string& file) {
    if (error.file.empty()) error.file = file;
    return tl::unexpected(std::move(error));
}

}  // namespace

Expected<LogComparison> compareLog(const LogComparisonRequest& request, const LogComparisonPlugins& plugins,
                                   const std::string& commandLine, const std::function<bool(double share)>& goesOn) {
    DiskDescriptions source = openDescriptions(request.log);
    auto loaded = loadScenario(request.scenario, source, {plugins.load, false});
    if (!loaded) return tl::unexpected(loaded.error());
    if (plugins.loaded) plugins.loaded(loaded->parts);
    const auto networks = networksOf(loaded->parts);
    auto opened = openLog(placeOfLog(request.log), {}, networks.empty() ? std::nullopt : networks.front()->drive);
    if (!opened) return tl::unexpected(opened.error());
    const auto log = std::make_shared<const Log>(std::move(*opened));
    ComparisonOptions options;
    options.seed = request.seed.value_or(loaded->parts.seed);
    if (goesOn) options.progress = [&](std::span<const ComparedCourse>, double share) { return goesOn(share); };
    auto world = LogWorld::create(std::move(loaded->parts), *log, request.robots);
    if (!world) return errorOf(world.error(), source.shown(loaded->name));
    const auto requests = coursesAsked(request, *world);
    if (!requests) return tl::unexpected(requests.error());
    auto comparison = compare(*world, *requests, options);
    if (!comparison) return errorOf(comparison.error(), source.shown(loaded->name));
    const Nanoseconds step = comparison->evaluation.options.windows.step;
    std::optional<Nanoseconds> asked;
    if (request.windows.empty() && !request.every)
        asked = request.duration ? fromSeconds(*request.duration) : world->parts().duration / step * step;
    ReportContext context;
    context.program = "mrose " MROSE_VERSION;
    context.commandLine = commandLine;
    context.synthetic = log->synthetic;
    context.notices = noticesAbout(*world, *comparison, asked);
    return LogComparison{log, std::move(*world), std::move(*comparison), std::move(context)};
}

}  // namespace mrose
