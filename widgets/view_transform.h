#pragma once

#include <QPointF>
#include <QRectF>
#include <QSizeF>

#include "geometry/area.h"

namespace mrose {

/// Where the field's metres (y up) lie in a picture's pixels (y down).
class ViewTransform {
public:
    static constexpr double leastScale = 0.5, mostScale = 5000;  ///< pixels per metre

    void setSize(const QSizeF& pixels) { size_ = pixels; }
    const QSizeF& size() const { return size_; }
    double scale() const { return scale_; }  ///< pixels per metre
    const Point& centre() const { return centre_; }
    void setCentre(const Point& centre) { centre_ = centre; }
    /// Shows the same place as large, in a picture of its own size.
    void showLike(const ViewTransform& other) {
        centre_ = other.centre_;
        scale_ = other.scale_;
    }

    QPointF toPixels(const Point& metres) const {
        return {size_.width() / 2 + scale_ * (metres.x - centre_.x),
                size_.height() / 2 - scale_ * (metres.y - centre_.y)};
    }
    Point toMetres(const QPointF& pixels) const {
        return {centre_.x + (pixels.x() - size_.width() / 2) / scale_,
                centre_.y - (pixels.y() - size_.height() / 2) / scale_};
    }
    Area shown() const;

    /// `factor` times as large; what lies at `about` stays there.
    void zoom(double factor, const QPointF& about);
    /// What lies at `from` comes to lie at `to`.
    void pan(const QPointF& from, const QPointF& to);
    /// All of an area, in the middle of a rectangle of the picture (pixels).
    void fit(const Area& area, const QRectF& into);

    bool operator==(const ViewTransform&) const = default;

private:
    Point centre_;
    double scale_ = 80;
    QSizeF size_{1, 1};
};

}  // namespace mrose
