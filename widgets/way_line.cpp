#include "widgets/way_line.h"

#include <cmath>

namespace mrose {
namespace {

/// Pixels: how far a left-out point may lie off the line, and how far off another one must be to give it a direction.
constexpr double slack = 0.4, leastStep = 1;

}  // namespace

void WayLine::begin() {
    if (started_ && last_ != kept_) keep(last_);
    started_ = directed_ = false;
}

void WayLine::keep(const QPointF& point) {
    lines_.back().append(point);
    kept_ = point;
    directed_ = false;
    reached_ = 0;
}

void WayLine::add(const QPointF& point) {
    if (!started_) {
        started_ = true;
        lines_.append(QPolygonF());
        keep(point);
    } else if (directed_) {
        const QPointF by = point - kept_;
        const double forwards = QPointF::dotProduct(by, along_), sideways = by.x() * along_.y() - by.y() * along_.x();
        if (std::abs(sideways) > slack || forwards < reached_ - slack) {
            keep(last_);
            add(point);
            return;
        }
        reached_ = std::max(reached_, forwards);
    }
    if (!directed_) {
        const QPointF by = point - kept_;
        const double length = std::hypot(by.x(), by.y());
        if (length >= leastStep) {
            along_ = by / length;
            reached_ = length;
            directed_ = true;
        }
    }
    last_ = point;
}

const QVector<QPolygonF>& WayLine::lines() {
    begin();
    return lines_;
}

}  // namespace mrose
