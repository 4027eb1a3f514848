#include "widgets/plot_curve.h"

#include <algorithm>
#include <limits>

#include "widgets/theme.h"

namespace mrose {

QPen curvePen(const PlotCurve& curve) {
    QColor colour = curve.colour;
    if (curve.ghost) colour.setAlpha(150);
    QPen pen(colour, curve.ghost ? 1 : curve.ahead.isEmpty() ? 1.6 : 2, curve.style);
    if (curve.style == Qt::DashLine) pen.setDashPattern({5, 2.5});
    if (curve.style == Qt::DotLine) pen.setDashPattern({1.5, 2});
    return pen;
}

QPen aheadPen(const PlotCurve& curve, const QColor& ground) {
    constexpr double faintest = 0.58, leastContrast = 2.2;
    double share = faintest;  // of the ground
    while (share > 0 && contrast(mixed(curve.colour, ground, share), ground) < leastContrast) share -= 0.04;
    QPen pen = curvePen(curve);
    pen.setColor(seenOn(ground, mixed(curve.colour, ground, std::max(share, 0.0)), leastContrast));
    pen.setWidthF(1.2);
    return pen;
}

ExpectedColours expectedColours(const PlotCurve& curve, const QColor& ground) {
    return {mixed(curve.colour, ground, 0.66), mixed(curve.colour, ground, 0.84)};
}

std::vector<const PlotCurve*> shadedOf(const std::vector<PlotCurve>& curves, bool byUnit) {
    std::vector<const PlotCurve*> shaded;
    for (const PlotCurve& curve : curves) {
        const auto alike = [&](const PlotCurve* other) {
            return byUnit ? other->unit == curve.unit : other->colour == curve.colour;
        };
        if (!curve.expected.isEmpty() && std::none_of(shaded.begin(), shaded.end(), alike)) shaded.push_back(&curve);
    }
    return shaded;
}

QPen expectedPen(const PlotCurve& curve, const QColor& ground) {
    return QPen(expectedColours(curve, ground).half, 8, Qt::SolidLine, Qt::FlatCap);
}

double numberAt(const PlotCurve& curve, std::int64_t tick, std::int64_t last) {
    if (tick <= last || curve.ahead.isEmpty()) return curve.at(tick);
    const auto after = std::upper_bound(curve.ahead.begin(), curve.ahead.end(), static_cast<double>(tick),
                                        [](double at, const QPointF& point) { return at < point.x(); });
    return after == curve.ahead.begin() ? curve.at(tick) : std::prev(after)->y();
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
