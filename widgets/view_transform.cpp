#include "widgets/view_transform.h"

#include <algorithm>

namespace mrose {

void FieldArea::include(const Point& point, double reach) {
    const Point low = point - Point{reach, reach}, high = point + Point{reach, reach};
    if (empty()) {
        least = low;
        most = high;
        return;
    }
    least = {std::min(least.x, low.x), std::min(least.y, low.y)};
    most = {std::max(most.x, high.x), std::max(most.y, high.y)};
}

void FieldArea::include(const FieldArea& other) {
    if (other.empty()) return;
    include(other.least);
    include(other.most);
}

FieldArea ViewTransform::shown() const {
    const Point half{size_.width() / 2 / scale_, size_.height() / 2 / scale_};
    return {centre_ - half, centre_ + half};
}

void ViewTransform::zoom(double factor, const QPointF& about) {
    const Point fixed = toMetres(about);
    scale_ = std::clamp(scale_ * factor, leastScale, mostScale);
    centre_ = centre_ + (fixed - toMetres(about));
}

void ViewTransform::pan(const QPointF& from, const QPointF& to) { centre_ = centre_ + (toMetres(from) - toMetres(to)); }

void ViewTransform::fit(const FieldArea& area, const QRectF& into) {
    if (area.empty()) return;
    const Point extent = area.most - area.least;
    const double width = std::max(1.0, into.width()), height = std::max(1.0, into.height());
    scale_ = std::clamp(std::min(width / std::max(extent.x, 1e-3), height / std::max(extent.y, 1e-3)), leastScale,
                        mostScale);
    const QPointF off = into.center() - QPointF(size_.width() / 2, size_.height() / 2);
    centre_ = area.middle() - Point{off.x() / scale_, -off.y() / scale_};
}

}  // namespace mrose
