#pragma once

#include <QPolygonF>

namespace mrose {

/// A polyline in pixels, of as few points as show it to within a pixel: ways have one at every tick.
class WayLine {
public:
    /// No line leads to the next point: the one so far ends.
    void begin();
    void add(const QPointF& point);
    /// All lines; none is added to afterwards.
    const QVector<QPolygonF>& lines();

private:
    void keep(const QPointF& point);

    QVector<QPolygonF> lines_;
    QPointF kept_, last_;  ///< the last point of the line, and the last that was added
    QPointF along_;        ///< from kept_, of length 1, once it is known
    double reached_ = 0;   ///< of last_, along it
    bool started_ = false, directed_ = false;
};

}  // namespace mrose
