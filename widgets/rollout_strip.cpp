#include "widgets/rollout_strip.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <array>
#include <cmath>

#include "widgets/field_readout.h"
#include "widgets/fixed_text.h"
#include "widgets/tool_tip.h"

namespace mrose {
namespace {

// Pixels: margins as the timeline has them, the title with the legend at its right, cells below.
constexpr double stripMargin = 18, cellsTop = 18, cellsHeight = 15, rampWidth = 44, gap = 6;
/// The colours reach up to an error that so many rollouts stay below: one outlier does not make all others alike.
constexpr double colouredShare = 0.95;

}  // namespace

RolloutStrip::RolloutStrip(QWidget* parent) : QWidget(parent) {
    setAttribute(Qt::WA_OpaquePaintEvent);
    setAccessibleName(tr("Rollouts of the log"));
    setCursor(Qt::PointingHandCursor);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void RolloutStrip::setContent(Content content) {
    content_ = std::move(content);
    std::vector<double> errors;
    for (const Cell& cell : content_.cells)
        if (std::isfinite(cell.error)) errors.push_back(cell.error);
    std::sort(errors.begin(), errors.end());
    const auto rank = static_cast<std::size_t>(colouredShare * static_cast<double>(errors.size()));
    worst_ = errors.empty() ? 0 : errors[std::min(rank, errors.size() - 1)];
    update();
}

void RolloutStrip::setNow(Nanoseconds now) {
    if (now == content_.now) return;
    content_.now = now;
    update();
}

void RolloutStrip::setTheme(const Theme& theme) {
    theme_ = theme;
    update();
}

QColor RolloutStrip::rampColour(double share) {
    static constexpr std::array<std::array<int, 3>, 6> stops{
        {{0, 34, 78}, {53, 69, 108}, {102, 105, 112}, {148, 142, 119}, {200, 184, 102}, {254, 232, 56}}};
    const double at = std::clamp(share, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(at), stops.size() - 2);
    const double part = at - static_cast<double>(below);
    const auto mix = [&](std::size_t c) {
        return static_cast<int>(std::lround((1 - part) * stops[below][c] + part * stops[below + 1][c]));
    };
    return {mix(0), mix(1), mix(2)};
}

double RolloutStrip::trackWidth() const { return std::max(1.0, width() - 2 * stripMargin); }

QFont RolloutStrip::smallFont() const {
    QFont small = font();
    small.setPointSizeF(small.pointSizeF() * 0.85);
    return small;
}

/// "0", the colours, and what the last one stands for.
QRectF RolloutStrip::legendRoom() const {
    if (worst_ <= 0) return {};
    const QFontMetricsF metrics(smallFont());
    const double wide = metrics.horizontalAdvance("0") + metrics.horizontalAdvance(worstText());
    return {stripMargin + trackWidth() - wide - rampWidth - 2 * gap, 2, wide + rampWidth + 2 * gap, cellsTop - 4};
}

QString RolloutStrip::worstText() const {
    const bool more = std::any_of(content_.cells.begin(), content_.cells.end(),
                                  [this](const Cell& cell) { return cell.error > worst_; });
    return (more ? QString::fromUtf8("\u2265 ") : QString()) + lengthText(worst_);
}

QString RolloutStrip::shownTitle() const {
    const QString title = tr("%1, %2").arg(content_.title, logTimeText(content_.length));
    return QFontMetricsF(smallFont()).elidedText(title, Qt::ElideRight, trackWidth() - legendRoom().width() - 2 * gap);
}

double RolloutStrip::pixelAt(Nanoseconds time) const {
    const double length = toSeconds(std::max<Nanoseconds>(1, content_.length));
    return stripMargin + trackWidth() * std::clamp(toSeconds(time) / length, 0.0, 1.0);
}

double RolloutStrip::pixelOf(std::size_t rollout) const {
    for (const Cell& cell : content_.cells)
        if (cell.rollout == rollout) return (pixelAt(cell.from) + pixelAt(cell.to)) / 2;
    return -1;
}

const RolloutStrip::Cell* RolloutStrip::cellAt(double pixel) const {
    const double share = (pixel - stripMargin) / trackWidth();
    if (share < 0 || share > 1) return nullptr;
    const auto time = static_cast<Nanoseconds>(share * static_cast<double>(content_.length));
    for (const Cell& cell : content_.cells)
        if (cell.from <= time && time < cell.to) return &cell;
    return nullptr;
}

QString RolloutStrip::textAt(double pixel) const {
    const Cell* const cell = cellAt(pixel);
    if (cell == nullptr) return tr("No rollout begins here: there is no ground truth, or the robot moves too little");
    const QString where = tr("%1 to %2").arg(logTimeText(cell->from), logTimeText(cell->to));
    if (!std::isfinite(cell->error)) return tr("%1: no ground truth").arg(where);
    QString text = tr("%1: %2 off on average").arg(where, lengthText(cell->error));
    if (cell->diverges)
        text +=
            tr(", leaves the trajectory of the log after %1 s").arg(toSeconds(*cell->diverges - cell->from), 0, 'f', 1);
    return text;
}

void RolloutStrip::paintCells(QPainter& painter) const {
    painter.setPen(Qt::NoPen);
    painter.setBrush(theme_.surround);
    painter.drawRect(QRectF(stripMargin, cellsTop, trackWidth(), cellsHeight));
    for (const Cell& cell : content_.cells) {
        if (!std::isfinite(cell.error)) continue;
        const double left = pixelAt(cell.from), right = pixelAt(cell.to);
        const double apart = right - left > 5 ? 1 : 0;
        painter.fillRect(QRectF(left, cellsTop, std::max(1.0, right - left - apart), cellsHeight),
                         rampColour(worst_ > 0 ? cell.error / worst_ : 0));
    }
    for (const Span& span : content_.unknown) {
        const double left = pixelAt(span.from), right = pixelAt(span.to);
        if (right - left < 1) continue;
        const QRectF room(left, cellsTop, right - left, cellsHeight);
        painter.fillRect(room, theme_.panel);
        painter.fillRect(room, QBrush(theme_.quietText, Qt::BDiagPattern));
    }
    painter.setPen(QPen(theme_.contact, 1.4));
    double last = -10;
    for (const Cell& cell : content_.cells) {
        if (!cell.diverges) continue;
        const double x = pixelAt(*cell.diverges);
        if (x - last < 2) continue;
        painter.drawLine(QPointF(x, cellsTop + cellsHeight), QPointF(x, cellsTop + cellsHeight + 4));
        last = x;
    }
    for (const Cell& cell : content_.cells) {
        if (!content_.shown || cell.rollout != *content_.shown) continue;
        const double left = pixelAt(cell.from), right = pixelAt(cell.to);
        painter.setBrush(Qt::NoBrush);
        painter.setPen(QPen(theme_.accent, 2));
        painter.drawRect(QRectF(left - 1, cellsTop - 1, std::max(3.0, right - left + 1), cellsHeight + 2));
    }
    const double now = pixelAt(content_.now);
    painter.setPen(QPen(theme_.accent, 1.4));
    painter.drawLine(QPointF(now, cellsTop - 3), QPointF(now, cellsTop + cellsHeight + 3));
}

void RolloutStrip::paintLegend(QPainter& painter) const {
    if (worst_ <= 0) return;
    const QRectF room = legendRoom();
    painter.setPen(theme_.quietText);
    painter.drawText(room, Qt::AlignLeft | Qt::AlignVCenter, "0");
    painter.drawText(room, Qt::AlignRight | Qt::AlignVCenter, worstText());
    const double left = room.left() + gap + QFontMetricsF(painter.font()).horizontalAdvance("0");
    for (int x = 0; x < static_cast<int>(rampWidth); ++x)
        painter.fillRect(QRectF(left + x, room.top() + 2, 1.5, room.height() - 3), rampColour(x / rampWidth));
}

void RolloutStrip::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    painter.fillRect(rect(), theme_.panel);
    painter.setFont(smallFont());
    painter.setPen(theme_.quietText);
    painter.drawText(QRectF(stripMargin, 2, trackWidth(), cellsTop - 4), Qt::AlignLeft | Qt::AlignVCenter,
                     shownTitle());
    painter.setRenderHint(QPainter::Antialiasing);
    paintCells(painter);
    paintLegend(painter);
}

void RolloutStrip::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return;
    if (const Cell* const cell = cellAt(event->localPos().x())) emit rolloutRequested(cell->rollout);
}

bool RolloutStrip::event(QEvent* event) {
    return showToolTip(event, *this, [this](int pixel) { return textAt(pixel); }) || QWidget::event(event);
}

}  // namespace mrose
