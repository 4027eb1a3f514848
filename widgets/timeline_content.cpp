#include "widgets/timeline_content.h"

#include <QObject>
#include <algorithm>

#include "widgets/qt_text.h"

namespace mrose {

std::span<const TimelineMark> TimelineContent::marksBetween(std::int64_t from, std::int64_t to) const {
    if (!marks) return {};
    const auto least = std::lower_bound(marks->begin(), marks->end(), from,
                                        [](const TimelineMark& mark, std::int64_t tick) { return mark.tick < tick; });
    const auto most = std::upper_bound(least, marks->end(), to,
                                       [](std::int64_t tick, const TimelineMark& mark) { return tick < mark.tick; });
    return {least, most};
}

std::optional<std::int64_t> TimelineContent::nextMark(bool contacts) const {
    std::optional<std::int64_t> next;
    for (const Noted& other : noted)
        if (other.mark.tick > now && other.mark.tick <= end && (!next || other.mark.tick < *next))
            next = other.mark.tick;
    for (const TimelineMark& mark : marksBetween(now + 1, next.value_or(end)))
        if (contacts || mark.kind != TimelineMark::Kind::contact) return mark.tick;
    return next;
}

std::optional<std::int64_t> TimelineContent::previousMark(bool contacts) const {
    std::optional<std::int64_t> previous;
    for (const Noted& other : noted)
        if (other.mark.tick < now && (!previous || other.mark.tick > *previous)) previous = other.mark.tick;
    const auto marks = marksBetween(previous.value_or(first), now - 1);
    for (auto mark = marks.rbegin(); mark != marks.rend(); ++mark)
        if (contacts || mark->kind != TimelineMark::Kind::contact) return mark->tick;
    return previous;
}

QString TimelineContent::nameOf(const TimelineMark& mark) const {
    if (!scenario) return {};
    const Scene& scene = scenario->scene();
    const auto body = [&](std::uint32_t which) {
        const std::size_t robots = scene.robots.size();
        if (which >= scene.bodyCount()) return QObject::tr("the place");
        return qtText(which < robots ? scene.robots[which].name : scene.objects[which - robots].name);
    };
    switch (mark.kind) {
        case TimelineMark::Kind::hit: {
            const auto found = breakpoints.find(mark.body);
            return found == breakpoints.end() ? QString() : found->second;
        }
        case TimelineMark::Kind::contact:
            return QObject::tr("%1 and %2").arg(body(mark.body), body(mark.other));
        case TimelineMark::Kind::goal:
            return mark.other < scene.environment.goals.size() ? qtText(scene.environment.goals[mark.other].name)
                                                               : QString();
        default:
            return body(mark.body);
    }
}

}  // namespace mrose
