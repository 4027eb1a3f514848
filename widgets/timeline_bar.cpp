#include "widgets/timeline_bar.h"

#include <QApplication>
#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QScreen>
#include <QToolTip>
#include <QWheelEvent>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "widgets/fixed_text.h"

namespace mrose {
namespace {

using namespace timeline;

constexpr double sideMargin = 18;
constexpr double mostPixelsPerTick = 40;
/// Of marks whose robot is not asked about, and between a mark and its name.
constexpr double faintly = 0.4, nameGap = 9;
/// What was pressed and has not gone farther than this is a click.
constexpr double clickPixels = 3;
/// Of what is seen of the ticks: how far the keys for a page go.
constexpr double pageShare = 0.1;

QFont countFont(QFont font) {
    font.setPointSizeF(7);
    return font;
}

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

TimelineBar::TimelineBar(QWidget* parent) : QWidget(parent) {
    setAttribute(Qt::WA_OpaquePaintEvent);
    setAccessibleName(tr("Timeline"));
    setCursor(Qt::PointingHandCursor);
    setMouseTracking(true);
    setFocusPolicy(Qt::TabFocus);
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

void TimelineBar::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.fillRect(rect(), theme_.panel);
    painter.setPen(theme_.line);
    painter.drawLine(0, 0, width(), 0);
    if (!content_.scenario && content_.end <= content_.first) return;  // nothing is open
    painter.setRenderHint(QPainter::Antialiasing);
    paintTrack(painter);
    paintUnknown(painter);
    paintScale(painter);
    paintContacts(painter);
    paintMarks(painter);
    paintNoted(painter);
    paintBranches(painter);
    if (hovered_ && !dragging_) paintFlag(painter, tickOf(*hovered_), false);
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
        painter.drawLine(QPointF(x, scaleTop), QPointF(x, scaleTop + 3));
        painter.setPen(theme_.quietText);
        const QString text = scaleText(time, end, decimals);
        const double wide = QFontMetricsF(small).horizontalAdvance(text) + 2;
        const double left = std::clamp(x - wide / 2, 1.0, std::max(1.0, width() - wide - 1));
        painter.drawText(QRectF(left, scaleTop + 2, wide, 13), Qt::AlignHCenter | Qt::AlignTop, text);
    }
}

std::vector<TimelineSign> TimelineBar::signs() const {
    if (!content_.marks) return {};
    const QFontMetricsF metrics(countFont(font()));
    return signsOf(
        *content_.marks, [this](std::int64_t tick) { return pixelOf(tick); },
        [&](int count) {
            return count < 2 ? leastSignGap : leastSignGap + 7 + metrics.horizontalAdvance(QString::number(count));
        });
}

/// Contacts are many: a line in each pixel, the higher the more there are, compared with where they are most.
void TimelineBar::paintContacts(QPainter& painter) const {
    constexpr int least = 3, few = 4;
    std::vector<int> counts(static_cast<std::size_t>(std::max(width(), 1)), 0);
    const double origin = pixelOf(0), perTick = pixelOf(1) - origin;
    int most = few;
    for (const TimelineMark& mark : content_.marksBetween(tickAt(-1), tickAt(width()))) {
        const double x = origin + perTick * static_cast<double>(mark.tick);
        if (mark.kind != TimelineMark::Kind::contact || x < 0 || x >= width()) continue;
        most = std::max(most, ++counts[static_cast<std::size_t>(x)]);
    }
    painter.setRenderHint(QPainter::Antialiasing, false);
    const QColor touched = markColour(TimelineMark::Kind::contact, theme_);
    for (std::size_t x = 0; x < counts.size(); ++x) {
        if (counts[x] == 0) continue;
        const int high = least + (static_cast<int>(contactHeight) - least) * counts[x] / most;
        painter.fillRect(QRect(static_cast<int>(x), static_cast<int>(contactTop + contactHeight) - high, 1, high),
                         touched);
    }
    painter.setRenderHint(QPainter::Antialiasing);
}

/// A sign in its lane, on a thin line that leads to its instant.
void TimelineBar::paintSign(QPainter& painter, double x, TimelineMark::Kind kind) const {
    const double lane = laneOf(kind);
    QColor stem = markColour(kind, theme_);
    stem.setAlpha(120);
    painter.fillRect(QRectF(x - 0.5, lane + 4, 1, trackTop + trackHeight - lane - 4), stem);
    drawMark(painter, {x, lane}, kind, theme_);
}

void TimelineBar::paintMarks(QPainter& painter) const {
    painter.setFont(countFont(font()));
    const std::vector<TimelineSign> all = signs();
    const auto seen = [&](const TimelineSign& sign) { return sign.x >= -sign.width && sign.x <= width(); };
    for (const TimelineSign& sign : all)
        if (seen(sign)) paintSign(painter, sign.x, sign.kind);
    // No line of another lane goes through a number.
    for (const TimelineSign& sign : all) {
        if (!seen(sign) || !sign.numbered) continue;
        const QString number = QString::number(sign.count);
        const QSizeF size(QFontMetricsF(painter.font()).horizontalAdvance(number) + 1, 9);
        const QRectF box(QPointF(sign.x + 5, laneOf(sign.kind) - size.height() / 2), size);
        painter.fillRect(box, theme_.panel);
        painter.setPen(theme_.text);
        painter.drawText(box, Qt::AlignCenter | Qt::TextDontClip, number);
    }
}

void TimelineBar::paintNoted(QPainter& painter) const {
    QFont small = font();
    small.setPointSizeF(8);
    painter.setFont(small);
    for (const Content::Noted& noted : content_.noted) {
        const double x = pixelOf(noted.mark.tick), lane = laneOf(noted.mark.kind);
        painter.setOpacity(noted.faint ? faintly : 1);
        // Above what else is there: it hides a run's own mark, and says so by its tool tip alone.
        painter.fillRect(QRectF(x - 6.5, lane - 5, 13, 10), theme_.panel);
        paintSign(painter, x, noted.mark.kind);
        painter.setOpacity(1);
        if (QFontMetricsF(small).horizontalAdvance(noted.name) > roomBeside(noted)) continue;
        painter.setPen(noted.faint ? theme_.quietText : theme_.text);
        painter.drawText(QRectF(x + nameGap, lane - 7, width(), 14), Qt::AlignLeft | Qt::AlignVCenter, noted.name);
    }
}

/// Up to the next sign, or the end.
double TimelineBar::roomBeside(const Content::Noted& noted) const {
    const double begin = pixelOf(noted.mark.tick) + nameGap;
    double room = width() - begin;
    const auto stopAt = [&](std::int64_t tick) { room = std::min(room, pixelOf(tick) - nameGap - begin); };
    for (const Content::Noted& other : content_.noted)
        if (other.mark.tick > noted.mark.tick) stopAt(other.mark.tick);
    for (const TimelineMark& mark : content_.marksBetween(noted.mark.tick + 1, tickAt(width())))
        if (mark.kind != TimelineMark::Kind::contact) {
            stopAt(mark.tick);
            break;
        }
    return room;
}

/// Thinly along the track's upper edge.
void TimelineBar::paintUnknown(QPainter& painter) const {
    painter.setPen(Qt::NoPen);
    painter.setBrush(QBrush(theme_.text, Qt::Dense5Pattern));
    for (const auto& [from, to] : content_.unknown) {
        const double left = std::max(0.0, pixelOf(std::max(from, content_.first)));
        const double right = std::min<double>(width(), pixelOf(std::min(to, content_.end)));
        if (right >= left) painter.drawRect(QRectF(left, trackTop, std::max(1.0, right - left), 4));
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
    painter.drawLine(QPointF(x, flagTop + flagHeight), QPointF(x, scaleTop));
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

/// What a click there asks for: the nearest mark within a few pixels, in its own lane rather than in another, or else
/// the instant itself.
std::int64_t TimelineBar::tickOf(const QPointF& pixel) const {
    constexpr double halfLane = 5, aside = 0.15;
    std::int64_t found = tickAt(pixel.x());
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](std::int64_t tick, double lane, double width) {
        const double x = pixelOf(tick), off = std::abs(pixel.y() - lane);
        const bool onCount = off <= halfLane && pixel.x() >= x && pixel.x() <= x + width;
        const double away = onCount ? 0 : std::abs(pixel.x() - x);
        if (away > tipReach || away + aside * off >= least) return;
        least = away + aside * off;
        found = tick;
    };
    for (const TimelineSign& sign : signs())
        consider(sign.first, laneOf(sign.kind), sign.count > 1 ? sign.width - tipReach : 0);
    for (const Content::Noted& noted : content_.noted) consider(noted.mark.tick, laneOf(noted.mark.kind), 0);
    for (const std::int64_t branch : content_.branches) consider(branch, trackTop + trackHeight / 2, 0);
    if (content_.departed > content_.first) consider(content_.departed, trackTop + trackHeight / 2, 0);
    return found;
}

void TimelineBar::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return;
    dragging_ = true;
    pressedAt_ = event->localPos().x();
    emit tickRequested(tickOf(event->localPos()));
}

void TimelineBar::mouseMoveEvent(QMouseEvent* event) {
    hovered_ = event->localPos();
    if (dragging_ && (!pressedAt_ || std::abs(hovered_->x() - *pressedAt_) > clickPixels)) {
        pressedAt_.reset();
        emit tickRequested(tickAt(hovered_->x()));
    }
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

void TimelineBar::keyPressEvent(QKeyEvent* event) {
    const auto page = static_cast<std::int64_t>(
        std::max(1.0, pageShare * static_cast<double>(content_.end - content_.first) / zoom_));
    const int pages = event->key() == Qt::Key_PageDown ? 1 : event->key() == Qt::Key_PageUp ? -1 : 0;
    if (pages == 0) return QWidget::keyPressEvent(event);
    emit tickRequested(std::clamp(content_.now + pages * page, content_.first, content_.end));
}

void TimelineBar::leaveEvent(QEvent* /*event*/) {
    hovered_.reset();
    update();
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
    for (const TimelineMark& mark : content_.marksBetween(tickAt(least - 1), tickAt(most + 1))) {
        const auto kind = static_cast<std::size_t>(mark.kind);
        const double x = pixelOf(mark.tick);
        if (x < ranges[kind].first || x > ranges[kind].second) continue;
        ++counts[kind];
        QString name = content_.nameOf(mark).toHtmlEscaped();
        if (mark.kind != TimelineMark::Kind::contact)
            name = tr("%1 at %2").arg(name, clockText(mark.tick * content_.tickLength)).trimmed();
        if (!name.isEmpty() && names[kind].size() < mostLines && !names[kind].contains(name)) names[kind] += name;
    }
    for (int kind = markKinds - 1; kind >= 0; --kind) {
        const auto i = static_cast<std::size_t>(kind);
        if (counts[i] == 0) continue;
        const auto which = static_cast<TimelineMark::Kind>(kind);
        text += QString("<br><span style=\"color:%1\">%2</span> %3")
                    .arg(markColour(which, theme_).name(), markLetter(which), markName(which));
        if (counts[i] > 1) text += QString::fromUtf8(" \u00d7 %1").arg(counts[i]);
        if (!names[i].isEmpty()) text += ": " + names[i].join(", ");
        if (names[i].size() == mostLines) text += QString::fromUtf8(" \u2026");
    }
    for (const Content::Noted& noted : content_.noted)
        if (std::abs(pixelOf(noted.mark.tick) - pixel) <= tipReach + 2)
            text += QString("<br><span style=\"color:%1\">%2</span> %3: %4")
                        .arg(markColour(noted.mark.kind, theme_).name(), markLetter(noted.mark.kind),
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
