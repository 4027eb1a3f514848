#include "widgets/plot_curve.h"

#include <algorithm>
#include <limits>

namespace mrose {

QPen curvePen(const PlotCurve& curve) {
    QColor colour = curve.colour;
    if (curve.ghost) colour.setAlpha(150);
    QPen pen(colour, curve.ghost ? 1 : 1.6, curve.style);
    if (curve.style == Qt::DashLine) pen.setDashPattern({5, 2.5});
    if (curve.style == Qt::DotLine) pen.setDashPattern({1.5, 2});
    return pen;
}

QPen aheadPen(const PlotCurve& curve, const QColor& ground) {
    constexpr double own = 0.42;
    const auto mixed = [&](double of, double with) { return own * of + (1 - own) * with; };
    QPen pen = curvePen(curve);
    pen.setColor(QColor::fromRgbF(mixed(curve.colour.redF(), ground.redF()),
                                  mixed(curve.colour.greenF(), ground.greenF()),
                                  mixed(curve.colour.blueF(), ground.blueF())));
    return pen;
}

double levelAt(const PlotLevel& level, double tick) {
    const auto after = std::lower_bound(level.points.begin(), level.points.end(), tick,
                                        [](const QPointF& point, double at) { return point.x() < at; });
    if (after == level.points.end())
        return level.points.isEmpty() ? std::numeric_limits<double>::quiet_NaN() : level.points.back().y();
    if (after->x() == tick) return after->y();
    if (after == level.points.begin()) return std::numeric_limits<double>::quiet_NaN();
    const QPointF &next = *after, &last = *(after - 1);
    return last.y() + (tick - last.x()) / (next.x() - last.x()) * (next.y() - last.y());
}

}  // namespace mrose
