#include "widgets/command_queue.h"

#include <algorithm>

#include <QPainter>

namespace mrose {
namespace {

QString speedText(double value, bool rotation) {
    return QString::number(value, 'f', 2) + (rotation ? " rad/s" : " m/s");
}

}  // namespace

CommandsOnTheWay commandsOnTheWay(const CommandQueue::Content& content) {
    CommandsOnTheWay way{content.before, {}};
    for (const StampedCommand& issued : content.commands) {
        const Nanoseconds untilV = std::max<Nanoseconds>(0, issued.time + content.deadTimes.v - content.now);
        const Nanoseconds untilW = std::max<Nanoseconds>(0, issued.time + content.deadTimes.w - content.now);
        if (untilV == 0) way.active.v = issued.command.v;
        if (untilW == 0) way.active.w = issued.command.w;
        if (untilV > 0 || untilW > 0) way.coming.push_back({issued, untilV, untilW});
    }
    return way;
}

CommandQueue::CommandQueue(QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("Commands on their way"));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void CommandQueue::setContent(Content content) {
    content_ = std::move(content);
    update();
}

void CommandQueue::setTheme(const Theme& theme) {
    theme_ = theme;
    update();
}

void CommandQueue::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    QFont small = font();
    small.setPointSizeF(8);
    painter.setFont(small);
    painter.setPen(theme_.quietText);
    const QRectF head(6, 2, width() - 12, 14);
    painter.drawText(head, Qt::AlignLeft | Qt::AlignVCenter, tr("takes effect"));
    painter.drawText(head, Qt::AlignRight | Qt::AlignVCenter, tr("issued"));
    lane(painter, QRectF(6, 18, width() - 12, 30), false);
    lane(painter, QRectF(6, 56, width() - 12, 30), true);
}

void CommandQueue::lane(QPainter& painter, const QRectF& box, bool rotation) {
    const Nanoseconds deadTime = rotation ? content_.deadTimes.w : content_.deadTimes.v;
    painter.setPen(theme_.line);
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(box, 3, 3);
    const CommandsOnTheWay way = commandsOnTheWay(content_);
    const double active = rotation ? way.active.w : way.active.v;
    painter.setPen(theme_.text);
    const double nowWidth = 74;
    painter.drawText(QRectF(box.left() + 4, box.top(), nowWidth - 8, box.height()), Qt::AlignLeft | Qt::AlignVCenter,
                     speedText(active, rotation));
    const double left = box.left() + nowWidth;
    painter.setPen(QPen(theme_.accent, 2));
    painter.drawLine(QPointF(left, box.top()), QPointF(left, box.bottom()));
    if (deadTime <= 0) {
        painter.setPen(theme_.quietText);
        painter.drawText(QRectF(left + 6, box.top(), box.right() - left - 8, box.height()),
                         Qt::AlignLeft | Qt::AlignVCenter, tr("at once"));
        return;
    }
    const double perNanosecond = (box.right() - left) / static_cast<double>(deadTime);
    painter.setClipRect(box.adjusted(nowWidth, 0, 0, 0));
    double before = active;
    for (std::size_t i = 0; i < way.coming.size(); ++i) {
        const Nanoseconds until = rotation ? way.coming[i].untilW : way.coming[i].untilV;
        const double value = rotation ? way.coming[i].issued.command.w : way.coming[i].issued.command.v;
        if (until == 0 || value == before) continue;
        before = value;
        const double x = left + perNanosecond * static_cast<double>(until);
        double end = box.right();
        for (std::size_t k = i + 1; k < way.coming.size(); ++k) {
            const double next = rotation ? way.coming[k].issued.command.w : way.coming[k].issued.command.v;
            if (next == value) continue;
            end = left + perNanosecond * static_cast<double>(rotation ? way.coming[k].untilW : way.coming[k].untilV);
            break;
        }
        QColor fill = theme_.accent;
        fill.setAlpha(34);
        painter.setPen(theme_.accent);
        painter.setBrush(fill);
        const QRectF chip(x, box.top() + 2, std::max(2.0, end - x), box.height() - 4);
        painter.drawRect(chip);
        painter.setPen(theme_.text);
        const QString number = QString::number(value, 'f', 2);
        if (painter.fontMetrics().horizontalAdvance(number) + 6 < chip.width())
            painter.drawText(chip.adjusted(3, 0, 0, 0), Qt::AlignLeft | Qt::AlignTop, number);
        const QString wait = QString::number(static_cast<double>(until) * 1e-6, 'f', 0) + " ms";
        painter.setPen(theme_.quietText);
        if (painter.fontMetrics().horizontalAdvance(wait) + 6 < chip.width())
            painter.drawText(chip.adjusted(3, 0, 0, 0), Qt::AlignLeft | Qt::AlignBottom, wait);
    }
    painter.setClipping(false);
}

}  // namespace mrose
