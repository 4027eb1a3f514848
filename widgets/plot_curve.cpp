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

}  // namespace mrose
