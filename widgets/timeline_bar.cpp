#include "widgets/timeline_bar.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <QWheelEvent>
#include <algorithm>
#include <array>
#include <cmath>

#include "widgets/timeline_glyphs.h"

namespace mrose {
namespace {

// Pixels, from above to below: flags with times, signs of what happened, the track, the scale.
constexpr double sideMargin = 18, flagTop = 2, flagHeight = 15, signs = 24, trackTop = 31, trackHeight = 14;
/// Signs do not lie nearer to each other than this.
constexpr double leastSignGap = 9;
constexpr double mostPixelsPerTick = 40;
/// Marks so near to the cursor are told of.
constexpr double told = 4;

double secondsBetweenLabels(double pixelsPerSecond) {
    const double least = 90 / std::max(pixelsPerSecond, 1e-9);
    for (const double step :
         {0.02, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 30.0, 60.0, 120.0, 300.0, 600.0, 1800.0, 3600.0})
        if (step >= least) return step;
    return 3600 * std::ceil(least / 3600);
}

/// "12 s", "0.25 s"; of long runs "2:05", "1:02:05".
QString scaleText(double time, double end, int decimals) {
    if (end < 120) return QString::number(time, 'f', decimals) + " s";
    const auto minutes = static_cast<std::int64_t>((time + 1e-9) / 60);
    const double rest = std::max(0.0, time - 60 * static_cast<double>(minutes));
    const QString seconds = QString::number(rest, 'f', decimals).rightJustified(decimals > 0 ? 3 + decimals : 2, '0');
    if (end < 3600) return QString("%1:%2").arg(minutes).arg(seconds);
    return QString("%1:%2:%3").arg(minutes / 60).arg(minutes % 60, 2, 10, QChar('0')).arg(seconds);
}

}  // namespace

QString clockText(Nanoseconds time) {
    const double seconds = toSeconds(time);
    if (seconds < 60) return QString::number(seconds, 'f', 2) + " s";
    const auto minutes = static_cast<std::int64_t>(seconds / 60);
    const QString rest = QString::number(seconds - 60 * static_cast<double>(minutes), 'f', 2).rightJustified(5, '0');
    if (minutes < 60) return QString("%1:%2").arg(minutes).arg(rest);
    return QString("%1:%2:%3").arg(minutes / 60).arg(minutes % 60, 2, 10, QChar('0')).arg(rest);
}

TimelineBar::TimelineBar(QWidget* parent) : QWidget(parent) {
    setAttribute(Qt::WA_OpaquePaintEvent);
    setAccessibleName(tr("Timeline"));
    setCursor(Qt::PointingHandCursor);
    setMouseTracking(true);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void TimelineBar::setContent(Content content) {
    content_ = std::move(content);
    content_.end = std::max(content_.end, content_.last);
    // Who has zoomed in still sees now go on.
    if (!dragging_ && zoom_ > 1) {
        const double now = pixelOf(content_.now);
        if (now < sideMargin || now > sideMargin + room()) setOffset(offset_ + now - width() / 2.0);
    }
    update();
}

void TimelineBar::setTheme(const Theme& theme) {
    theme_ = theme;
    update();
}

QColor TimelineBar::colourOf(TimelineMark::Kind kind, const Theme& theme) {
    switch (kind) {
        case TimelineMark::Kind::contact:
            return theme.contact;
        case TimelineMark::Kind::kick:
            return theme.dark ? QColor(240, 228, 66) : QColor(176, 132, 0);
        case TimelineMark::Kind::goal:
            return QColor(0, 158, 115);
        case TimelineMark::Kind::fault:
            return theme.warning;
        case TimelineMark::Kind::hit:
            return theme.dark ? QColor(200, 150, 255) : QColor(120, 50, 190);
        case TimelineMark::Kind::stop:
            break;
    }
    return theme.accent;
}

double TimelineBar::room() const { return std::max(1.0, width() - 2 * sideMargin); }

double TimelineBar::length() const { return room() * zoom_; }

double TimelineBar::pixelOf(std::int64_t tick) const {
    const auto ticks = static_cast<double>(std::max<std::int64_t>(content_.end - content_.first, 1));
    return sideMargin - offset_ + length() * static_cast<double>(tick - content_.first) / ticks;
}

std::int64_t TimelineBar::tickAt(double pixel) const {
    const double share = (pixel - sideMargin + offset_) / length();
    const auto ticks = static_cast<double>(content_.end - content_.first);
    return std::clamp<std::int64_t>(content_.first + std::llround(share * ticks), content_.first, content_.end);
}

void TimelineBar::setOffset(double offset) {
    offset_ = std::clamp(offset, 0.0, length() - room());
    update();
}

void TimelineBar::zoom(double factor, double pixel) {
    const auto ticks = static_cast<double>(std::max<std::int64_t>(content_.end - content_.first, 1));
    const double share = (pixel - sideMargin + offset_) / length();
    zoom_ = std::clamp(zoom_ * factor, 1.0, std::max(1.0, mostPixelsPerTick * ticks / room()));
    setOffset(share * length() - (pixel - sideMargin));
}

void TimelineBar::pan(double pixels) { setOffset(offset_ + pixels); }

std::optional<std::int64_t> TimelineBar::nextMark(bool contacts) const {
    for (const TimelineMark& mark : marksBetween(content_.now + 1, content_.end))
        if (contacts || mark.kind != TimelineMark::Kind::contact) return mark.tick;
    return std::nullopt;
}

std::optional<std::int64_t> TimelineBar::previousMark(bool contacts) const {
    const auto marks = marksBetween(content_.first, content_.now - 1);
    for (auto mark = marks.rbegin(); mark != marks.rend(); ++mark)
        if (contacts || mark->kind != TimelineMark::Kind::contact) return mark->tick;
    return std::nullopt;
}

void TimelineBar::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.fillRect(rect(), theme_.panel);
    painter.setPen(theme_.line);
    painter.drawLine(0, 0, width(), 0);
    painter.setRenderHint(QPainter::Antialiasing);
    paintTrack(painter);
    paintScale(painter);
    paintMarks(painter);
    paintBranches(painter);
    if (hovered_ && !dragging_) paintFlag(painter, tickAt(*hovered_), false);
    paintFlag(painter, content_.now, true);
}

void TimelineBar::paintTrack(QPainter& painter) const {
    const auto part = [&](double from, double to, const QBrush& brush) {
        if (to <= from) return;
        painter.setBrush(brush);
        painter.drawRoundedRect(QRectF(from, trackTop, to - from, trackHeight), 3, 3);
    };
    const double begin = pixelOf(content_.first), end = pixelOf(content_.end);
    painter.setPen(theme_.line);
    part(begin, end, Qt::NoBrush);
    painter.setPen(Qt::NoPen);
    part(begin, pixelOf(content_.last), theme_.line);
    QColor past = theme_.accent;
    past.setAlpha(70);
    part(begin, pixelOf(content_.now), past);
    // Before it departed, its past is that of the branch that it came from.
    if (content_.departed > content_.first) {
        part(begin, pixelOf(content_.departed), QBrush(theme_.quietText, Qt::BDiagPattern));
        painter.setBrush(theme_.accent);
        painter.drawEllipse(QPointF(pixelOf(content_.departed), trackTop + trackHeight / 2), 4.5, 4.5);
    }
    if (zoom_ <= 1) return;
    // Which part of all is seen.
    painter.setBrush(theme_.quietText);
    const double from = sideMargin + room() * offset_ / length(), shown = std::max(8.0, room() / zoom_);
    painter.drawRoundedRect(QRectF(std::min(from, width() - sideMargin - shown), height() - 4, shown, 3), 1.5, 1.5);
}

void TimelineBar::paintScale(QPainter& painter) const {
    const double seconds = toSeconds((content_.end - content_.first) * content_.tickLength);
    if (seconds <= 0) return;
    const double step = secondsBetweenLabels(length() / seconds), perSecond = length() / seconds;
    const double begin = toSeconds(content_.first * content_.tickLength), end = begin + seconds;
    const auto at = [&](double time) { return sideMargin - offset_ + perSecond * (time - begin); };
    const double seen = std::max(begin, begin + (offset_ - 60) / perSecond);
    const double until = std::min(end, begin + (offset_ + room() + 60) / perSecond);
    QFont small = font();
    small.setPointSizeF(8);
    painter.setFont(small);
    const int decimals = step < 0.1 ? 2 : step < 1 ? 1 : 0;
    for (auto i = static_cast<std::int64_t>(std::ceil(seen / step - 1e-9));
         static_cast<double>(i) * step <= until + 1e-9; ++i) {
        const double time = static_cast<double>(i) * step, x = at(time);
        painter.setPen(theme_.line);
        painter.drawLine(QPointF(x, trackTop + trackHeight), QPointF(x, trackTop + trackHeight + 4));
        painter.setPen(theme_.quietText);
        const QString text = scaleText(time, end, decimals);
        const double wide = QFontMetricsF(small).horizontalAdvance(text) + 2;
        const double left = std::clamp(x - wide / 2, 1.0, std::max(1.0, width() - wide - 1));
        painter.drawText(QRectF(left, trackTop + trackHeight + 3, wide, 13), Qt::AlignHCenter | Qt::AlignTop, text);
    }
}

/// Those from one tick to another, both among them.
std::span<const TimelineMark> TimelineBar::marksBetween(std::int64_t from, std::int64_t to) const {
    if (!content_.marks) return {};
    const auto begin = std::lower_bound(content_.marks->begin(), content_.marks->end(), from,
                                        [](const TimelineMark& mark, std::int64_t tick) { return mark.tick < tick; });
    const auto end = std::upper_bound(begin, content_.marks->end(), to,
                                      [](std::int64_t tick, const TimelineMark& mark) { return tick < mark.tick; });
    return {begin, end};
}

void TimelineBar::paintMarks(QPainter& painter) const {
    // Contacts are many: a line in each pixel, the higher the more there are. Of other marks that lie too near to one
    // another the rarest kind is seen.
    std::vector<int> contacts(static_cast<std::size_t>(std::max(width(), 1)), 0);
    struct Sign {
        double x;
        TimelineMark::Kind kind;
    };
    std::vector<Sign> shown;
    const double origin = pixelOf(0), perTick = pixelOf(1) - origin;
    const auto marks = marksBetween(tickAt(-1), tickAt(width()));
    for (const TimelineMark& mark : marks) {
        const double x = origin + perTick * static_cast<double>(mark.tick);
        if (x < 0 || x >= width()) continue;
        if (mark.kind == TimelineMark::Kind::contact)
            ++contacts[static_cast<std::size_t>(x)];
        else if (shown.empty() || x - shown.back().x >= leastSignGap)
            shown.push_back({x, mark.kind});
        else
            shown.back().kind = std::max(shown.back().kind, mark.kind);
    }
    painter.setRenderHint(QPainter::Antialiasing, false);
    const QColor touched = colourOf(TimelineMark::Kind::contact, theme_);
    for (std::size_t x = 0; x < contacts.size(); ++x) {
        if (contacts[x] == 0) continue;
        const int high = std::min(static_cast<int>(trackHeight) - 2, 5 + 2 * std::ilogb(contacts[x]));
        painter.fillRect(QRect(static_cast<int>(x), static_cast<int>(trackTop + trackHeight) - 1 - high, 1, high),
                         touched);
    }
    painter.setRenderHint(QPainter::Antialiasing);
    for (const Sign& sign : shown) {
        painter.fillRect(QRectF(sign.x - 0.5, signs + 4, 1, trackTop + trackHeight - signs - 6),
                         colourOf(sign.kind, theme_));
        drawMark(painter, {sign.x, signs}, sign.kind, theme_);
    }
}

void TimelineBar::paintBranches(QPainter& painter) const {
    painter.setPen(QPen(theme_.text, 1.4));
    painter.setBrush(theme_.panel);
    for (const std::int64_t tick : content_.branches)
        painter.drawEllipse(QPointF(pixelOf(tick), trackTop + trackHeight / 2), 4, 4);
}

/// A line at a tick, under its time.
void TimelineBar::paintFlag(QPainter& painter, std::int64_t tick, bool now) const {
    const double x = pixelOf(tick);
    if (x < sideMargin - 1 || x > sideMargin + room() + 1) return;
    const QColor colour = now ? theme_.accent : theme_.quietText;
    painter.setPen(QPen(colour, now ? 2 : 1));
    painter.drawLine(QPointF(x, flagTop + flagHeight), QPointF(x, trackTop + trackHeight + 3));
    QFont small = font();
    small.setPointSizeF(8);
    painter.setFont(small);
    const QString text = clockText(tick * content_.tickLength);
    const double wide = QFontMetricsF(small).horizontalAdvance(text) + 10;
    const QRectF box(std::clamp(x - wide / 2, 2.0, std::max(2.0, width() - wide - 2)), flagTop, wide, flagHeight);
    painter.setPen(now ? QPen(Qt::NoPen) : QPen(theme_.line, 1));
    painter.setBrush(now ? theme_.accent : theme_.panel);
    painter.drawRoundedRect(box, 3, 3);
    painter.setPen(now ? setOff(theme_.accent) : theme_.text);
    painter.drawText(box, Qt::AlignCenter, text);
}

void TimelineBar::ask(double pixel) { emit tickRequested(tickAt(pixel)); }

void TimelineBar::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return;
    dragging_ = true;
    ask(event->localPos().x());
}

void TimelineBar::mouseMoveEvent(QMouseEvent* event) {
    hovered_ = event->localPos().x();
    if (dragging_) ask(*hovered_);
    update();
}

void TimelineBar::mouseReleaseEvent(QMouseEvent* /*event*/) { dragging_ = false; }

void TimelineBar::wheelEvent(QWheelEvent* event) {
    const QPoint by = event->angleDelta();
    if (by.x() != 0 || event->modifiers().testFlag(Qt::ShiftModifier))
        pan(by.x() != 0 ? -by.x() : -by.y());
    else
        zoom(std::pow(1.0015, by.y()), event->position().x());
    event->accept();
}

void TimelineBar::leaveEvent(QEvent* /*event*/) {
    hovered_.reset();
    update();
}

QString TimelineBar::nameOf(const TimelineMark& mark) const {
    if (!content_.scenario) return {};
    const Scene& scene = content_.scenario->scene();
    const auto body = [&](std::uint32_t which) {
        const std::size_t robots = scene.robots.size();
        if (which >= scene.bodyCount()) return tr("the place");
        return QString::fromStdString(which < robots ? scene.robots[which].name : scene.objects[which - robots].name);
    };
    switch (mark.kind) {
        case TimelineMark::Kind::hit: {
            const auto found = content_.breakpoints.find(mark.body);
            return found == content_.breakpoints.end() ? QString() : found->second;
        }
        case TimelineMark::Kind::contact:
            return tr("%1 and %2").arg(body(mark.body), body(mark.other));
        case TimelineMark::Kind::goal:
            return mark.other < scene.environment.goals.size()
                       ? QString::fromStdString(scene.environment.goals[mark.other].name)
                       : QString();
        default:
            return body(mark.body);
    }
}

QString TimelineBar::textAt(double pixel) const {
    constexpr int mostLines = 6;
    const std::int64_t tick = tickAt(pixel);
    QString text = tr("%1, tick %2").arg(clockText(tick * content_.tickLength)).arg(tick);
    std::array<int, markKinds> counts{};
    std::array<QStringList, markKinds> names;
    for (const TimelineMark& mark : marksBetween(tickAt(pixel - told - 1), tickAt(pixel + told + 1))) {
        if (std::abs(pixelOf(mark.tick) - pixel) > told) continue;
        const auto kind = static_cast<std::size_t>(mark.kind);
        ++counts[kind];
        const QString name = nameOf(mark).toHtmlEscaped();
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
    for (const std::int64_t branch : content_.branches)
        if (std::abs(pixelOf(branch) - pixel) <= told) text += "<br>" + tr("a branch departs");
    return text;
}

bool TimelineBar::event(QEvent* event) {
    if (event->type() == QEvent::ToolTip) {
        const auto* help = static_cast<QHelpEvent*>(event);
        QToolTip::showText(help->globalPos(), textAt(help->pos().x()), this);
        return true;
    }
    return QWidget::event(event);
}

}  // namespace mrose
