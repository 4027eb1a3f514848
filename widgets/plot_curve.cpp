#include "widgets/plot_curve.h"

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

}  // namespace mrose
