#include "widgets/plot_read_out.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "widgets/fixed_text.h"

namespace mrose {

PlotReadOut::PlotReadOut(QWidget* parent) : QLabel(parent) {
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setTextFormat(Qt::RichText);
    setMargin(5);
    hide();
}

void PlotReadOut::place(const QPoint& mouse, const QRect& room, const std::function<int(const QRect& place)>& cost) {
    constexpr int beside = 14, stays = 3;  // pixels; points of curves: another place covers more
    setWordWrap(false);
    QSize size = sizeHint();
    if (size.width() > room.width()) {
        setWordWrap(true);
        size = {room.width(), heightForWidth(room.width())};
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
        const int here = cost(places[i]) - (i == place_ ? stays : 0);
        if (here >= least) continue;
        best = i;
        least = here;
    }
    place_ = best;
    setGeometry(places[best]);
}

QString readOutText(const std::vector<PlotCurve>& curves, const QString& ghostName, const PlotAxis::Time& time,
                    std::int64_t tick) {
    QString text = QString("<b>%1</b>&nbsp;&nbsp;%2<table cellspacing=0>")
                       .arg(clockText(tick * time.tickLength), QObject::tr("tick %1").arg(tick));
    const auto number = [](const QString& digits) { return "<td align=right>&nbsp;&nbsp;" + digits + "</td>"; };
    bool ghosts = false;
    QString rows;
    for (const PlotCurve& curve : curves) {
        if (curve.ghost) continue;
        const auto ghost = std::find_if(curves.begin(), curves.end(), [&](const PlotCurve& other) {
            return other.ghost && other.name == curve.name;
        });
        rows += QString("<tr><td><font color='%1'>%2</font>&nbsp;</td><td>%3</td>")
                    .arg(curve.colour.name(),
                         curve.style == Qt::SolidLine  ? QString::fromUtf8("\u2501\u2501")
                         : curve.style == Qt::DashLine ? QString::fromUtf8("\u2578\u2578")
                                                       : QString::fromUtf8("\u00b7\u00b7\u00b7"),
                         (curve.label.isEmpty() ? curve.name : curve.label).toHtmlEscaped());
        const double here = numberAt(curve, tick, time.last);
        rows += number(fixedText(here, curve.decimals));
        if (ghost != curves.end()) rows += number(fixedText(ghost->at(tick), curve.decimals));
        rows += "<td>&nbsp;" + (std::isfinite(here) ? curve.unit.toHtmlEscaped() : QString()) + "</td></tr>";
        ghosts = ghosts || ghost != curves.end();
    }
    if (ghosts)
        text +=
            QString("<tr><td></td><td></td><td align=right>&nbsp;&nbsp;%1</td><td align=right>&nbsp;&nbsp;%2</td></tr>")
                .arg(QObject::tr("here"), ghostName.toHtmlEscaped());
    return text + rows + "</table>";
}

}  // namespace mrose
