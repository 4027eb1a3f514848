#include "overlay_strip.h"

#include <limits>

namespace mrose::gui {

CourseStrip::Content stripOf(const Overlay& overlay) {
    CourseStrip::Content content;
    if (!overlay.world()) return content;
    const LogWorld& world = overlay.world()->world();
    const std::vector<CourseRequest>& requests = overlay.requests();
    const std::size_t take = overlay.shownCourse() ? requests[*overlay.shownCourse()].take : 0;
    const std::size_t robot = overlay.shownRobot().value_or(0);
    const QString title = QString::fromStdString(world.robots()[robot].name);
    const QString takeName = QString::fromStdString(world.takes()[take].name);
    content.title = QObject::tr("%1 in %2")
                        .arg(title, takeName.isEmpty() ? QString::fromStdString(overlay.world()->name()) : takeName);
    content.length = world.takes()[take].length;
    content.shown = overlay.shownCourse();
    const Nanoseconds step = WindowOptions{}.step;
    for (std::size_t request = 0; request < requests.size(); ++request) {
        const CourseRequest& course = requests[request];
        if (course.take != take || (course.robot && *course.robot != robot)) continue;
        const OverlayRow* const row = overlay.rowOf(request, robot);
        const bool known = row != nullptr && row->position >= 0;
        CourseStrip::Cell cell{request,
                               course.start,
                               course.start + course.steps * step,
                               known ? row->position : std::numeric_limits<double>::quiet_NaN(),
                               {}};
        if (row != nullptr && row->divergence) cell.diverges = course.start + row->divergence->time;
        content.cells.push_back(cell);
    }
    const Reality reality = realityOf(world, overlay.world()->log, take, 0);
    for (const auto& [from, to] : reality.robots[robot].unknownBetween(0, content.length))
        content.unknown.push_back({from, to});
    return content;
}

}  // namespace mrose::gui
