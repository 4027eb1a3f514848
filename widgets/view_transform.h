#pragma once

#include <QPointF>
#include <QRectF>
#include <QSizeF>
#include <cmath>

#include "geometry/area.h"

namespace mrose {

/// Where the field's metres lie in a picture's pixels (y down): y up, or turned by a quarter, x up.
class ViewTransform {
public:
    static constexpr double leastScale = 0.5, mostScale = 5000;  ///< pixels per metre

    void setSize(const QSizeF& pixels) { size_ = pixels; }
    const QSizeF& size() const { return size_; }
    double scale() const { return scale_; }  ///< pixels per metre
    const Point& centre() const { return centre_; }
    bool turned() const { return turned_; }
    void setTurned(bool turned) { turned_ = turned; }
    void setCentre(const Point& centre) { centre_ = centre; }
    /// Shows the same place as large, in a picture of its own size.
    void showLike(const ViewTransform& other) {
        centre_ = other.centre_;
        scale_ = other.scale_;
        turned_ = other.turned_;
    }

    QPointF toPixels(const Point& metres) const { return middle() + scale_ * turn(metres - centre_); }
    Point toMetres(const QPointF& pixels) const { return centre_ + turnBack((pixels - middle()) / scale_); }
    /// Which way a heading points in the picture; of length 1.
    QPointF along(double heading) const { return turn({std::cos(heading), std::sin(heading)}); }
    /// A way to the right and up in the picture as one over the field.
    Point onField(const Point& way) const { return turnBack({way.x, -way.y}); }
    QRectF box(const Area& area) const { return QRectF(toPixels(area.least), toPixels(area.most)).normalized(); }
    Area shown() const;

    /// `factor` times as large; what lies at `about` stays there.
    void zoom(double factor, const QPointF& about);
    /// What lies at `from` comes to lie at `to`.
    void pan(const QPointF& from, const QPointF& to);
    /// All of an area, in the middle of a rectangle of the picture (pixels).
    void fit(const Area& area, const QRectF& into);

    bool operator==(const ViewTransform&) const = default;

private:
    QPointF middle() const { return {size_.width() / 2, size_.height() / 2}; }
    QPointF turn(const Point& way) const { return turned_ ? QPointF(-way.y, -way.x) : QPointF(way.x, -way.y); }
    Point turnBack(const QPointF& way) const { return turned_ ? Point{-way.y(), -way.x()} : Point{way.x(), -way.y()}; }

    Point centre_;
    double scale_ = 80;
    QSizeF size_{1, 1};
    bool turned_ = false;
};

}  // namespace mrose
