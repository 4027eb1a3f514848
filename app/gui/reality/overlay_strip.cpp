#include "reality/overlay_strip.h"

#include <limits>

#include "logs/pose_grid.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

/// Where poses are too far apart to say anything in between, on the session's clock.
std::vector<RolloutStrip::Span> unknownSpans(const std::vector<StampedPose>& poses, Nanoseconds origin,
                                             Nanoseconds length) {
    std::vector<RolloutStrip::Span> spans;
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

RolloutStrip::Content stripOf(const Overlay& overlay) {
    RolloutStrip::Content content;
    if (!overlay.rollouts().log()) return content;
    const LogWorld& world = overlay.rollouts().world();
    const std::vector<RolloutRequest>& requests = overlay.rollouts().requests();
    const std::size_t session = overlay.rollouts().shown() ? requests[*overlay.rollouts().shown()].session : 0;
    const std::size_t robot = overlay.rollouts().robot().value_or(0);
    const QString title = qtText(world.robots()[robot].name);
    const QString sessionName = qtText(sessionText(world.sessions()[session]));
    content.title = QObject::tr("%1 in %2")
                        .arg(title, sessionName.isEmpty() ? qtText(overlay.rollouts().log()->name()) : sessionName);
    content.length = world.sessions()[session].length;
    content.shown = overlay.rollouts().shown();
    const Nanoseconds step = WindowOptions{}.step;
    for (std::size_t rollout = 0; rollout < requests.size(); ++rollout) {
        const RolloutRequest& request = requests[rollout];
        if (request.session != session || (request.robot && *request.robot != robot)) continue;
        const RolloutRow* const row = overlay.rollouts().rowOf(rollout, robot);
        constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
        const double error = row != nullptr ? row->position.value_or(unknown) : unknown;
        RolloutStrip::Cell cell{rollout, request.start, request.start + request.steps * step, error, {}};
        if (row != nullptr && row->divergence) cell.diverges = request.start + row->divergence->time;
        content.cells.push_back(cell);
    }
    content.unknown = unknownSpans(world.trajectory(session, robot).poses,
                                   world.sessions()[session].parts[robot].origin, content.length);
    return content;
}

}  // namespace mrose::gui
