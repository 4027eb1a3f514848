// What a plot says of what is under the mouse, and what the mouse does.
#include <QLabel>
#include <QMouseEvent>
#include <algorithm>
#include <cmath>
#include <limits>

#include "widgets/fixed_text.h"
#include "widgets/plot_band.h"
#include "widgets/timeline_bar.h"

namespace mrose {

/// What has happened, or else what is known ahead of it.
double PlotView::numberAt(const PlotCurve& curve, std::int64_t tick) const {
    if (tick <= time_.last || curve.ahead.isEmpty()) return curve.at(tick);
    const auto after = std::upper_bound(curve.ahead.begin(), curve.ahead.end(), static_cast<double>(tick),
                                        [](double at, const QPointF& point) { return at < point.x(); });
    return after == curve.ahead.begin() ? curve.at(tick) : std::prev(after)->y();
}

QString PlotView::textAt(std::int64_t tick) const {
    QString text = QString("<b>%1</b>&nbsp;&nbsp;%2<table cellspacing=0>")
                       .arg(clockText(tick * time_.tickLength), tr("tick %1").arg(tick));
    const auto number = [](const QString& digits) { return "<td align=right>&nbsp;&nbsp;" + digits + "</td>"; };
    bool ghosts = false;
    QString rows;
    for (const PlotCurve& curve : curves_) {
        if (curve.ghost) continue;
        const auto ghost = std::find_if(curves_.begin(), curves_.end(), [&](const PlotCurve& other) {
            return other.ghost && other.name == curve.name;
        });
        rows += QString("<tr><td><font color='%1'>%2</font>&nbsp;</td><td>%3</td>")
                    .arg(curve.colour.name(),
                         curve.style == Qt::SolidLine  ? QString::fromUtf8("\u2501\u2501")
                         : curve.style == Qt::DashLine ? QString::fromUtf8("\u2578\u2578")
                                                       : QString::fromUtf8("\u00b7\u00b7\u00b7"),
                         (curve.label.isEmpty() ? curve.name : curve.label).toHtmlEscaped());
        const double here = numberAt(curve, tick);
        rows += number(fixedText(here, curve.decimals));
        if (ghost != curves_.end()) rows += number(fixedText(ghost->at(tick), curve.decimals));
        rows += "<td>&nbsp;" + (std::isfinite(here) ? curve.unit.toHtmlEscaped() : QString()) + "</td></tr>";
        ghosts = ghosts || ghost != curves_.end();
    }
    if (ghosts)
        text +=
            QString("<tr><td></td><td></td><td align=right>&nbsp;&nbsp;%1</td><td align=right>&nbsp;&nbsp;%2</td></tr>")
                .arg(tr("here"), ghostName_.toHtmlEscaped());
    return text + rows + "</table>";
}

void PlotView::hover(std::optional<double> pixel, const QPoint& place) {
    const bool inside = pixel && !bands_.empty() && *pixel >= leftMargin && *pixel <= plot_->width() - rightMargin;
    std::optional<std::int64_t> tick;
    if (inside) tick = tickAt(*pixel);
    for (const auto& band : bands_) {
        band->mouse->setVisible(inside);
        if (!inside) continue;
        const double at = seconds(static_cast<double>(*tick));
        band->mouse->start->setCoords(at, 0);
        band->mouse->end->setCoords(at, 1);
    }
    plot_->layer("overlay")->replot();
    readOut_->setVisible(inside);
    if (inside) {
        readOut_->setText(textAt(*tick));
        placeReadOut(place);
        readOut_->raise();
    }
    emit hovered(tick);
}

/// Beside the mouse, within what is seen of the plot, and where it covers the least of the curves.
void PlotView::placeReadOut(const QPoint& mouse) {
    constexpr int beside = 14, stays = 3;  // pixels; points of curves: another place covers more
    const QRect room = parentWidget() == nullptr ? rect() : rect() & QRect(-pos(), parentWidget()->size());
    readOut_->setWordWrap(false);
    QSize size = readOut_->sizeHint();
    if (size.width() > room.width()) {
        readOut_->setWordWrap(true);
        size = {room.width(), readOut_->heightForWidth(room.width())};
    }
    const int lowest = std::max(room.top(), room.bottom() + 1 - size.height());
    std::vector<QRect> places;
    for (const int left : {mouse.x() + beside, mouse.x() - beside - size.width()}) {
        const int farthest = std::max(room.left(), room.right() + 1 - size.width());
        const int within = std::clamp(left, room.left(), farthest);
        for (const int top : {mouse.y() - size.height() / 2, room.top(), lowest})
            places.emplace_back(QPoint(within, std::clamp(top, room.top(), lowest)), size);
    }
    std::size_t best = 0;
    int least = std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < places.size(); ++i) {
        const bool overMouse = places[i].left() <= mouse.x() && places[i].right() >= mouse.x();
        const int more = overMouse ? width() * static_cast<int>(curves_.size()) : 0;
        const int cost = coveredBy(places[i]) + more - (i == readOutPlace_ ? stays : 0);
        if (cost >= least) continue;
        best = i;
        least = cost;
    }
    readOutPlace_ = best;
    readOut_->setGeometry(places[best]);
}

/// How many points of the curves, of which each has one in every fourth pixel.
int PlotView::coveredBy(const QRect& place) const {
    int covered = 0;
    for (const auto& band : bands_)
        for (const auto& [index, graph] : band->graphs)
            for (int x = place.left(); x <= place.right(); x += 4) {
                const double number = numberAt(curves_[index], tickAt(x));
                if (!std::isfinite(number)) continue;
                const double y = band->value()->coordToPixel(number);
                covered += y >= place.top() && y <= place.bottom() ? 1 : 0;
            }
    return covered;
}

bool PlotView::press(const QMouseEvent& event) {
    if (event.button() == Qt::LeftButton && !bands_.empty()) {
        seeking_ = true;
        emit tickRequested(tickAt(event.localPos().x()));
    } else if (event.button() == Qt::RightButton || event.button() == Qt::MiddleButton) {
        panFrom_ = event.localPos().x();
    }
    return true;
}

bool PlotView::move(const QMouseEvent& event) {
    const double pixel = event.localPos().x();
    if (seeking_) emit tickRequested(tickAt(pixel));
    if (panFrom_) {
        const double width = std::max(1, plot_->width() - leftMargin - rightMargin);
        const double by = (*panFrom_ - pixel) / width * (to_ - from_), length = to_ - from_;
        const double from = std::clamp(from_ + by, static_cast<double>(time_.first) - 0.5 * length, reach());
        panFrom_ = pixel;
        all_ = false;
        setRange(from, from + length);
        refresh();
    }
    hover(pixel, event.pos());
    return true;
}

bool PlotView::eventFilter(QObject* watched, QEvent* event) {
    if (watched != plot_) return QWidget::eventFilter(watched, event);
    switch (event->type()) {
        case QEvent::MouseButtonPress:
            return press(*static_cast<QMouseEvent*>(event));
        case QEvent::MouseMove:
            return move(*static_cast<QMouseEvent*>(event));
        case QEvent::MouseButtonRelease:
            seeking_ = false;
            panFrom_.reset();
            return true;
        case QEvent::MouseButtonDblClick:
            showAll();
            return true;
        case QEvent::Wheel: {
            const auto* wheel = static_cast<QWheelEvent*>(event);
            zoom(std::pow(1.2, wheel->angleDelta().y() / 120.0), wheel->position().x());
            event->accept();
            return true;
        }
        case QEvent::Leave:
            hover({}, {});
            break;
        case QEvent::Resize:
            dirty_ = true;
            break;
        default:
            break;
    }
    return QWidget::eventFilter(watched, event);
}

}  // namespace mrose
