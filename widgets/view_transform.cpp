#include "widgets/view_transform.h"

#include <algorithm>
#include <utility>

namespace mrose {

Area ViewTransform::shown() const {
    Point half{size_.width() / 2 / scale_, size_.height() / 2 / scale_};
    if (turned_) std::swap(half.x, half.y);
    return {centre_ - half, centre_ + half};
}

void ViewTransform::zoom(double factor, const QPointF& about) {
    const Point fixed = toMetres(about);
    scale_ = std::clamp(scale_ * factor, leastScale, mostScale);
    centre_ = centre_ + (fixed - toMetres(about));
}

void ViewTransform::pan(const QPointF& from, const QPointF& to) { centre_ = centre_ + (toMetres(from) - toMetres(to)); }

void ViewTransform::fit(const Area& area, const QRectF& into) {
    if (area.empty()) return;
    Point extent = area.most - area.least;
    if (turned_) std::swap(extent.x, extent.y);
    const double width = std::max(1.0, into.width()), height = std::max(1.0, into.height());
    scale_ = std::clamp(std::min(width / std::max(extent.x, 1e-3), height / std::max(extent.y, 1e-3)), leastScale,
                        mostScale);
    centre_ = area.middle() - turnBack((into.center() - middle()) / scale_);
}

}  // namespace mrose
