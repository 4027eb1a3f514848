// What a timeline says of what is under the mouse.
#include <QApplication>
#include <QHelpEvent>
#include <QScreen>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include "widgets/qt_text.h"
#include "widgets/timeline_bar.h"
#include "widgets/timeline_glyphs.h"
#include "widgets/timeline_signs.h"

namespace mrose {

QString TimelineBar::nameOf(const TimelineMark& mark) const {
    if (!content_.scenario) return {};
    const Scene& scene = content_.scenario->scene();
    const auto body = [&](std::uint32_t which) {
        const std::size_t robots = scene.robots.size();
        if (which >= scene.bodyCount()) return tr("the place");
        return qtText(which < robots ? scene.robots[which].name : scene.objects[which - robots].name);
    };
    switch (mark.kind) {
        case TimelineMark::Kind::hit: {
            const auto found = content_.breakpoints.find(mark.body);
            return found == content_.breakpoints.end() ? QString() : found->second;
        }
        case TimelineMark::Kind::contact:
            return tr("%1 and %2").arg(body(mark.body), body(mark.other));
        case TimelineMark::Kind::goal:
            return mark.other < scene.environment.goals.size() ? qtText(scene.environment.goals[mark.other].name)
                                                               : QString();
        default:
            return body(mark.body);
    }
}

/// From where to where the marks of a kind are described at a pixel: within a few of it, and all that one sign holds.
std::array<std::pair<double, double>, markKinds> TimelineBar::tipRanges(double pixel) const {
    std::array<std::pair<double, double>, markKinds> ranges;
    ranges.fill({pixel - tipReach, pixel + tipReach});
    for (const TimelineSign& sign : signs()) {
        if (pixel < sign.x - tipReach ||
            pixel > sign.x + std::max(tipReach, sign.count > 1 ? sign.width - tipReach : 0))
            continue;
        auto& [from, to] = ranges[static_cast<std::size_t>(sign.kind)];
        from = std::min(from, sign.x);
        to = std::max(to, pixelOf(sign.last));
    }
    return ranges;
}

QString TimelineBar::textAt(double pixel) const {
    constexpr int mostLines = 6;
    const std::int64_t tick = tickAt(pixel);
    QString text = tr("%1, tick %2").arg(clockText(tick * content_.tickLength)).arg(tick);
    std::array<int, markKinds> counts{};
    std::array<QStringList, markKinds> names;
    const auto ranges = tipRanges(pixel);
    const auto least = std::min_element(ranges.begin(), ranges.end())->first;
    double most = pixel;
    for (const auto& range : ranges) most = std::max(most, range.second);
    for (const TimelineMark& mark : marksBetween(tickAt(least - 1), tickAt(most + 1))) {
        const auto kind = static_cast<std::size_t>(mark.kind);
        const double x = pixelOf(mark.tick);
        if (x < ranges[kind].first || x > ranges[kind].second) continue;
        ++counts[kind];
        QString name = nameOf(mark).toHtmlEscaped();
        if (mark.kind != TimelineMark::Kind::contact)
            name = tr("%1 at %2").arg(name, clockText(mark.tick * content_.tickLength)).trimmed();
        if (!name.isEmpty() && names[kind].size() < mostLines && !names[kind].contains(name)) names[kind] += name;
    }
    for (int kind = markKinds - 1; kind >= 0; --kind) {
        const auto i = static_cast<std::size_t>(kind);
        if (counts[i] == 0) continue;
        const auto which = static_cast<TimelineMark::Kind>(kind);
        text += QString("<br><span style=\"color:%1\">%2</span> %3")
                    .arg(colourOf(which, theme_).name(), markLetter(which), markName(which));
        if (counts[i] > 1) text += QString::fromUtf8(" \u00d7 %1").arg(counts[i]);
        if (!names[i].isEmpty()) text += ": " + names[i].join(", ");
        if (names[i].size() == mostLines) text += QString::fromUtf8(" \u2026");
    }
    for (const Content::Noted& noted : content_.noted)
        if (std::abs(pixelOf(noted.mark.tick) - pixel) <= tipReach + 2)
            text += QString("<br><span style=\"color:%1\">%2</span> %3: %4")
                        .arg(colourOf(noted.mark.kind, theme_).name(), markLetter(noted.mark.kind),
                             markName(noted.mark.kind), noted.text.toHtmlEscaped());
    for (const auto& [from, to] : content_.unknown)
        if (tick > from && tick < to) {
            text += "<br>" + tr("no ground truth");
            break;
        }
    for (const std::int64_t branch : content_.branches)
        if (std::abs(pixelOf(branch) - pixel) <= tipReach) text += "<br>" + tr("a branch departs");
    return text;
}

/// Above the bar, whose times it would hide otherwise, and all of it on the screen.
void TimelineBar::showToolTip(double pixel) {
    const QPoint at = mapToGlobal(QPoint(static_cast<int>(pixel), 0));
    QToolTip::showText(at, textAt(pixel), this);
    for (QWidget* top : QApplication::topLevelWidgets()) {
        if (!top->inherits("QTipLabel") || top->isHidden()) continue;
        const QRect all = screen()->geometry();
        const int left = std::clamp(at.x(), all.left(), std::max(all.left(), all.right() - top->width()));
        top->move(left, std::max(all.top(), at.y() - top->height() - 3));
    }
}

bool TimelineBar::event(QEvent* event) {
    if (event->type() == QEvent::ToolTip) {
        const auto* help = static_cast<QHelpEvent*>(event);
        showToolTip(pixelOf(tickOf(help->pos())));  // on a mark, its instant
        return true;
    }
    return QWidget::event(event);
}

}  // namespace mrose
