#include "reality/overlay_strip.h"

#include <limits>

#include "logs/pose_grid.h"

namespace mrose::gui {
namespace {

/// Where poses are too far apart to say anything in between, on the take's clock.
std::vector<CourseStrip::Span> unknownSpans(const std::vector<StampedPose>& poses, Nanoseconds origin,
                                            Nanoseconds length) {
    std::vector<CourseStrip::Span> spans;
    Nanoseconds last = 0;
    const auto add = [&](Nanoseconds until) {
        if (until - last > truthGap) spans.push_back({last, until});
    };
    for (const StampedPose& stamped : poses) {
        if (stamped.time < origin) continue;
        add(stamped.time - origin);
        last = stamped.time - origin;
    }
    add(length);
    return spans;
}

}  // namespace

CourseStrip::Content stripOf(const Overlay& overlay) {
    CourseStrip::Content content;
    if (!overlay.world()) return content;
    const LogWorld& world = overlay.world()->world();
    const std::vector<CourseRequest>& requests = overlay.requests();
    const std::size_t take = overlay.shownCourse() ? requests[*overlay.shownCourse()].take : 0;
    const std::size_t robot = overlay.shownRobot().value_or(0);
    const QString title = QString::fromStdString(world.robots()[robot].name);
    const QString takeName = QString::fromStdString(takeText(world.takes()[take]));
    content.title = QObject::tr("%1 in %2")
                        .arg(title, takeName.isEmpty() ? QString::fromStdString(overlay.world()->name()) : takeName);
    content.length = world.takes()[take].length;
    content.shown = overlay.shownCourse();
    const Nanoseconds step = WindowOptions{}.step;
    for (std::size_t course = 0; course < requests.size(); ++course) {
        const CourseRequest& request = requests[course];
        if (request.take != take || (request.robot && *request.robot != robot)) continue;
        const OverlayRow* const row = overlay.rowOf(course, robot);
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        const double error = row != nullptr ? row->position.value_or(unknown) : unknown;
        CourseStrip::Cell cell{course, request.start, request.start + request.steps * step, error, {}};
        if (row != nullptr && row->divergence) cell.diverges = request.start + row->divergence->time;
        content.cells.push_back(cell);
    }
    content.unknown =
        unknownSpans(world.trajectory(take, robot).poses, world.takes()[take].parts[robot].origin, content.length);
    return content;
}

}  // namespace mrose::gui
