#include "widgets/command_queue.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include "drawing/axis_ticks.h"
#include "widgets/fixed_text.h"

namespace mrose {
namespace {

constexpr double side = 4, activeWidth = 78, laneTop = 17, laneHeight = 44, laneGap = 6;
constexpr Nanoseconds millisecond = 1'000'000;

const char* unitOf(bool rotation) { return rotation ? "rad/s" : "m/s"; }
double partOf(const Command& command, bool rotation) { return rotation ? command.w : command.v; }

}  // namespace

CommandQueue::CommandQueue(QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("Commands on their way"));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setMouseTracking(true);
    setFocusPolicy(Qt::TabFocus);
}

/// A robot that goes on as before gets that command at every control instant: those instants are seen travelling too.
void CommandQueue::setContent(Content content) {
    content_ = std::move(content);
    std::vector<Nanoseconds> times;
    for (const StampedCommand& issued : content_.commands) times.push_back(issued.time);
    const Nanoseconds farthest = content_.now - std::max(content_.deadTimes.v, content_.deadTimes.w);
    for (Nanoseconds at = content_.lastInstant; content_.period > 0; at -= content_.period) {
        if (at < content_.now && at >= 0) times.push_back(at);
        if (at <= farthest || at < 0) break;
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    const CommandView view(content_.commands, content_.before);
    instants_.clear();
    for (const Nanoseconds at : times)
        instants_.push_back(
            {at, view.at(at), at + content_.deadTimes.v - content_.now, at + content_.deadTimes.w - content_.now});
    // Of those that have taken effect in both lanes only the last one counts.
    const auto begun = [](const Instant& instant) { return instant.untilV <= 0 && instant.untilW <= 0; };
    const auto onTheWay = std::find_if_not(instants_.begin(), instants_.end(), begun);
    if (onTheWay - instants_.begin() > 1) instants_.erase(instants_.begin(), onTheWay - 1);
    update();
}

void CommandQueue::setTheme(const Theme& theme) {
    theme_ = theme;
    update();
}

Nanoseconds CommandQueue::scaleEnd() const {
    return std::max({content_.deadTimes.v, content_.deadTimes.w, 50 * millisecond});
}

double CommandQueue::pixelOf(Nanoseconds until) const {
    const double left = side + activeWidth, right = width() - side - 2;
    return left + (right - left) * static_cast<double>(until) / static_cast<double>(scaleEnd());
}

QRectF CommandQueue::laneBox(bool rotation) const {
    return {side, laneTop + (rotation ? laneHeight + laneGap : 0), width() - 2 * side, laneHeight};
}

std::optional<std::size_t> CommandQueue::instantAt(const QPointF& place) const {
    const bool rotation = place.y() > laneBox(false).bottom() + laneGap / 2;
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < instants_.size(); ++i)
        if (place.x() >= pixelOf(std::max<Nanoseconds>(0, rotation ? instants_[i].untilW : instants_[i].untilV)))
            found = i;
    if (!found && !instants_.empty()) found = 0;
    return found;
}

QString CommandQueue::textOf(const Instant& instant) const {
    const auto effect = [&](Nanoseconds until, Nanoseconds deadTime) {
        const QString when = clockText(instant.issued + deadTime);
        return until > 0 ? tr("%1, in %2 ms").arg(when).arg((until + millisecond / 2) / millisecond)
                         : tr("%1, now").arg(when);
    };
    return tr("%1 m/s, %2 rad/s\ntold at %3\nforward speed takes effect at %4\nturning takes effect at %5")
        .arg(instant.command.v, 0, 'f', 4)
        .arg(instant.command.w, 0, 'f', 4)
        .arg(clockText(instant.issued), effect(instant.untilV, content_.deadTimes.v),
             effect(instant.untilW, content_.deadTimes.w));
}

double CommandQueue::highest(bool rotation) const {
    double most = rotation ? 0.2 : 0.1;
    for (const Instant& instant : instants_) most = std::max(most, std::abs(partOf(instant.command, rotation)));
    // So that the scale seldom changes while playing.
    return roundStep(std::max(most, std::abs(partOf(commandsOnTheWay(content_).active, rotation))));
}

void CommandQueue::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    QFont small = font();
    small.setPointSizeF(8);
    painter.setFont(small);
    painter.setPen(theme_.quietText);
    painter.drawText(QRectF(side, 0, width() - 2 * side, laneTop - 2), Qt::AlignLeft | Qt::AlignVCenter,
                     tr("Commands on their way"));
    paintLane(painter, false);
    paintLane(painter, true);
    paintScale(painter);
    if (!hasFocus()) return;
    painter.setPen(QPen(theme_.accent, 1, Qt::DotLine));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(rect().adjusted(0, 0, -1, -1));
}

/// The values as a step curve over the time until they take effect, and each instant of issue as a thin line.
void CommandQueue::paintLane(QPainter& painter, bool rotation) const {
    const QRectF box = laneBox(rotation);
    const double now = pixelOf(0), active = partOf(commandsOnTheWay(content_).active, rotation);
    const Nanoseconds deadTime = rotation ? content_.deadTimes.w : content_.deadTimes.v;
    const double end = pixelOf(deadTime), most = highest(rotation);
    const bool signedValues =
        active < 0 || std::any_of(instants_.begin(), instants_.end(),
                                  [&](const Instant& instant) { return partOf(instant.command, rotation) < 0; });
    const bool middle = rotation || signedValues;
    const double zero = middle ? box.center().y() : box.bottom() - 4;
    const double height = (middle ? box.height() / 2 : box.height()) - 14;
    const auto levelOf = [&](double value) { return zero - std::clamp(value / most, -1.0, 1.0) * height; };

    painter.fillRect(box, theme_.dark ? theme_.surround : QColor(Qt::white));
    painter.setPen(theme_.line);
    painter.drawLine(QPointF(now, zero), QPointF(end, zero));
    QColor fill = seenOn(theme_.dark ? theme_.surround : QColor(Qt::white),
                         content_.colour.isValid() ? content_.colour : theme_.accent, theme_.dark ? 2.5 : 1.7);
    QColor separator = theme_.quietText;
    fill.setAlpha(theme_.dark ? 80 : 120);
    separator.setAlpha(90);
    const auto untilOf = [&](const Instant& instant) { return rotation ? instant.untilW : instant.untilV; };
    for (std::size_t i = 0; i < instants_.size() && deadTime > 0; ++i) {
        const Instant& instant = instants_[i];
        const double x = pixelOf(std::max<Nanoseconds>(0, untilOf(instant)));
        const double next = i + 1 < instants_.size() ? std::max(now, pixelOf(untilOf(instants_[i + 1]))) : end;
        if (next <= x) continue;
        const double value = partOf(instant.command, rotation), level = levelOf(value);
        if (marked_ == instant.issued) {
            QColor light = theme_.accent;
            light.setAlpha(45);
            painter.fillRect(QRectF(x, box.top(), next - x, box.height()), light);
        }
        painter.fillRect(QRectF(QPointF(x, std::min(level, zero)), QPointF(next, std::max(level, zero))), fill);
        painter.setPen(theme_.text);
        painter.drawLine(QPointF(x, level), QPointF(next, level));
        const double before = i > 0 ? partOf(instants_[i - 1].command, rotation) : value;
        if (untilOf(instant) > 0) {
            painter.setPen(separator);
            painter.drawLine(QPointF(x, box.top() + 1), QPointF(x, box.bottom() - 2));
            painter.setPen(theme_.text);
            painter.drawLine(QPointF(x, level), QPointF(x, levelOf(before)));
        }
        const QString number = fixedText(value, 2);
        if (untilOf(instant) <= 0 || painter.fontMetrics().horizontalAdvance(number) + 5 > next - x) continue;
        const bool above = value >= 0 && level - 13 >= box.top();
        // On the bar itself nothing is quiet.
        painter.setPen(above && number == fixedText(before, 2) ? theme_.quietText : theme_.text);
        painter.drawText(QRectF(x + 3, above ? level - 13 : level + 1, next - x, 12), Qt::AlignLeft | Qt::AlignVCenter,
                         number);
    }
    painter.setBrush(Qt::NoBrush);
    painter.setPen(theme_.line);
    painter.drawRect(box.adjusted(0, 0, -1, -1));
    if (deadTime <= 0) {
        painter.setPen(theme_.quietText);
        painter.drawText(QRectF(now + 6, box.top(), box.right() - now - 8, box.height()),
                         Qt::AlignLeft | Qt::AlignVCenter, tr("takes effect at once"));
    }
    painter.fillRect(QRectF(now - 1, box.top(), 2, box.height()), theme_.accent);
    QFont large = painter.font(), small = large;
    large.setPointSizeF(11);
    painter.setFont(large);
    painter.setPen(theme_.text);
    painter.drawText(QRectF(side, box.top() + 4, activeWidth - 10, 20), Qt::AlignRight | Qt::AlignVCenter,
                     fixedText(active, 2));
    painter.setFont(small);
    painter.setPen(theme_.quietText);
    painter.drawText(QRectF(side, box.top() + 24, activeWidth - 10, 14), Qt::AlignRight | Qt::AlignVCenter,
                     unitOf(rotation));
}

void CommandQueue::paintScale(QPainter& painter) const {
    const double top = laneBox(true).bottom() + 2;
    painter.setPen(theme_.accent);
    painter.drawText(QRectF(side, top, activeWidth + 12, 14), Qt::AlignRight | Qt::AlignVCenter, tr("now"));
    painter.setPen(theme_.quietText);
    const Nanoseconds end = scaleEnd();
    const Nanoseconds step = end > 600 * millisecond   ? 500 * millisecond
                             : end > 250 * millisecond ? 100 * millisecond
                                                       : 50 * millisecond;
    constexpr double leastApart = 34;  // pixels, of two numbers
    const auto every = static_cast<Nanoseconds>(std::ceil(leastApart / std::max(1.0, pixelOf(step) - pixelOf(0))));
    for (Nanoseconds until = every * step; until <= end; until += every * step) {
        const double x = pixelOf(until);
        const bool last = until + every * step > end;
        const QString text = QString::number(until / millisecond) + (last ? " ms" : "");
        painter.drawLine(QPointF(x, top - 2), QPointF(x, top + 1));
        painter.drawText(QRectF(std::min(x - 30, width() - side - 60), top, 60, 14),
                         (x > width() - side - 30 ? Qt::AlignRight : Qt::AlignHCenter) | Qt::AlignVCenter, text);
    }
}

void CommandQueue::mark(std::optional<std::size_t> instant) {
    const auto marked = instant ? std::optional(instants_[*instant].issued) : std::nullopt;
    if (std::exchange(marked_, marked) != marked) update();
}

void CommandQueue::mouseMoveEvent(QMouseEvent* event) { mark(instantAt(event->localPos())); }

void CommandQueue::leaveEvent(QEvent* /*event*/) { mark({}); }

void CommandQueue::mouseDoubleClickEvent(QMouseEvent* event) {
    if (const auto instant = instantAt(event->localPos()); instant && event->button() == Qt::LeftButton)
        emit commandActivated(instants_[*instant].issued);
}

void CommandQueue::keyPressEvent(QKeyEvent* event) {
    const auto at = std::find_if(instants_.begin(), instants_.end(),
                                 [&](const Instant& instant) { return marked_ == instant.issued; });
    const auto now = static_cast<std::size_t>(at - instants_.begin());
    const bool any = at != instants_.end();
    if (instants_.empty()) return QWidget::keyPressEvent(event);
    if (event->key() == Qt::Key_Right)
        mark(any ? std::min(now + 1, instants_.size() - 1) : 0);
    else if (event->key() == Qt::Key_Left)
        mark(any && now > 0 ? now - 1 : 0);
    else if (any && (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter))
        emit commandActivated(at->issued);
    else
        return QWidget::keyPressEvent(event);
    setAccessibleDescription(any ? textOf(*at) : QString());
}

bool CommandQueue::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride) {
        // The arrows choose a command here, not a tick.
        const int key = static_cast<QKeyEvent*>(event)->key();
        if (key == Qt::Key_Left || key == Qt::Key_Right) event->accept();
    }
    if (event->type() == QEvent::ToolTip) {
        const auto* help = static_cast<QHelpEvent*>(event);
        if (const auto instant = instantAt(help->pos()))
            QToolTip::showText(help->globalPos(), textOf(instants_[*instant]), this);
        return true;
    }
    return QWidget::event(event);
}

}  // namespace mrose
