#include "widgets/timeline_bar.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>

namespace mrose {
namespace {

constexpr double sideMargin = 18, trackTop = 24, trackHeight = 14;
constexpr std::array kindNames{"contact", "kick", "goal", "controller failed", "stop asked for"};

double secondsBetweenLabels(double pixelsPerSecond) {
    const double least = 90 / std::max(pixelsPerSecond, 1e-9);
    for (const double step : {0.02, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 30.0, 60.0, 120.0, 300.0, 600.0, 1800.0, 3600.0})
        if (step >= least) return step;
    return 3600 * std::ceil(least / 3600);
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
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void TimelineBar::setContent(Content content) {
    content_ = std::move(content);
    content_.end = std::max(content_.end, content_.last);
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
        case TimelineMark::Kind::stop:
            break;
    }
    return theme.accent;
}

double TimelineBar::pixelOf(std::int64_t tick) const {
    const auto length = static_cast<double>(std::max<std::int64_t>(content_.end - content_.first, 1));
    return sideMargin + (width() - 2 * sideMargin) * static_cast<double>(tick - content_.first) / length;
}

std::int64_t TimelineBar::tickAt(double pixel) const {
    const double share = (pixel - sideMargin) / std::max(1.0, width() - 2 * sideMargin);
    const auto length = static_cast<double>(content_.end - content_.first);
    return std::clamp<std::int64_t>(content_.first + std::llround(share * length), content_.first, content_.end);
}

void TimelineBar::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.fillRect(rect(), theme_.panel);
    painter.setPen(theme_.line);
    painter.drawLine(0, 0, width(), 0);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF track(sideMargin, trackTop, width() - 2 * sideMargin, trackHeight);
    painter.setPen(theme_.line);
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(track, 3, 3);
    painter.setPen(Qt::NoPen);
    const double now = pixelOf(content_.now), known = pixelOf(content_.last);
    painter.setBrush(theme_.line);
    painter.drawRoundedRect(QRectF(track.left(), track.top(), known - track.left(), track.height()), 3, 3);
    QColor past = theme_.accent;
    past.setAlpha(70);
    painter.setBrush(past);
    painter.drawRoundedRect(QRectF(track.left(), track.top(), now - track.left(), track.height()), 3, 3);
    paintScale(painter);
    paintMarks(painter);
    painter.setPen(QPen(theme_.accent, 2));
    painter.drawLine(QPointF(now, trackTop - 6), QPointF(now, trackTop + trackHeight + 3));
    painter.setPen(Qt::NoPen);
    painter.setBrush(theme_.accent);
    painter.drawPolygon(QPolygonF({{now - 6, trackTop - 12}, {now + 6, trackTop - 12}, {now, trackTop - 4}}));
}

void TimelineBar::paintScale(QPainter& painter) {
    const double seconds = toSeconds((content_.end - content_.first) * content_.tickLength);
    if (seconds <= 0) return;
    const double step = secondsBetweenLabels((width() - 2 * sideMargin) / seconds);
    const double begin = toSeconds(content_.first * content_.tickLength), end = begin + seconds;
    QFont small = font();
    small.setPointSizeF(8);
    painter.setFont(small);
    const int decimals = step < 0.1 ? 2 : step < 1 ? 1 : 0;
    for (double at = std::ceil(begin / step - 1e-9) * step; at <= end + 1e-9; at += step) {
        const double x = sideMargin + (width() - 2 * sideMargin) * (at - begin) / seconds;
        painter.setPen(theme_.line);
        painter.drawLine(QPointF(x, trackTop + trackHeight), QPointF(x, trackTop + trackHeight + 4));
        painter.setPen(theme_.quietText);
        const QString text = end < 120 ? QString::number(at, 'f', decimals) + " s"
                                       : QString("%1:%2").arg(static_cast<int>(at) / 60).arg(static_cast<int>(at) % 60, 2, 10, QChar('0'));
        painter.drawText(QRectF(x - 40, trackTop + trackHeight + 4, 80, 14), Qt::AlignHCenter | Qt::AlignTop, text);
    }
}

void TimelineBar::paintMarks(QPainter& painter) {
    painter.setRenderHint(QPainter::Antialiasing, false);
    if (content_.marks) {
        // Of marks in one pixel the rarest kind is seen.
        std::vector<int> shown(static_cast<std::size_t>(std::max(width(), 1)), -1);
        for (const TimelineMark& mark : *content_.marks) {
            if (mark.tick < content_.first || mark.tick > content_.end) continue;
            int& kind = shown[std::min(shown.size() - 1, static_cast<std::size_t>(pixelOf(mark.tick)))];
            kind = std::max(kind, static_cast<int>(mark.kind));
        }
        for (std::size_t x = 0; x < shown.size(); ++x) {
            if (shown[x] < 0) continue;
            const auto kind = static_cast<TimelineMark::Kind>(shown[x]);
            const bool minor = kind == TimelineMark::Kind::contact;
            painter.setPen(QPen(colourOf(kind, theme_), minor ? 1 : 2));
            const auto at = static_cast<int>(x);
            painter.drawLine(at, static_cast<int>(trackTop + (minor ? 6 : 1)), at,
                             static_cast<int>(trackTop + trackHeight - 1));
        }
    }
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(theme_.text, 1));
    painter.setBrush(theme_.panel);
    for (const std::int64_t tick : content_.branches)
        painter.drawEllipse(QPointF(pixelOf(tick), trackTop + trackHeight / 2), 4, 4);
}

void TimelineBar::ask(double pixel) { emit tickRequested(tickAt(pixel)); }

void TimelineBar::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return;
    dragging_ = true;
    ask(event->localPos().x());
}

void TimelineBar::mouseMoveEvent(QMouseEvent* event) {
    if (dragging_) ask(event->localPos().x());
}

void TimelineBar::mouseReleaseEvent(QMouseEvent* /*event*/) { dragging_ = false; }

QString TimelineBar::textAt(double pixel) const {
    const std::int64_t tick = tickAt(pixel);
    QString text = tr("%1, tick %2").arg(clockText(tick * content_.tickLength)).arg(tick);
    if (!content_.marks) return text;
    std::array<int, kindNames.size()> counts{};
    for (const TimelineMark& mark : *content_.marks)
        if (std::abs(pixelOf(mark.tick) - pixel) < 3) ++counts[static_cast<std::size_t>(mark.kind)];
    for (std::size_t kind = 0; kind < counts.size(); ++kind)
        if (counts[kind] > 0) text += QString("\n%1: %2").arg(tr(kindNames[kind])).arg(counts[kind]);
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
