#pragma once

#include <QColor>
#include <QPen>
#include <QPointF>
#include <QString>
#include <QVector>
#include <cstdint>
#include <functional>
#include <vector>

namespace mrose {

/// Between which numbers a curve is to be expected at a tick: the half, and most, of all runs. NaN interrupts it.
struct ExpectedRange {
    double tick = 0;
    double halfLow = 0, halfHigh = 0, mostLow = 0, mostHigh = 0;
    bool operator==(const ExpectedRange&) const = default;
};

/// Some number over the ticks. Drawing asks for as much as is seen.
struct PlotCurve {
    QString id;        ///< its own
    QString name;      ///< "red 1  speed"
    QString unit;      ///< curves of one unit share an axis
    QString label;     ///< what tells it from those beside it, for lists; empty: its name
    QString quantity;  ///< what all curves of its axis may be of, for the axis's title; empty: nothing is said
    QColor colour;
    bool ghost = false;  ///< of another branch: thin and pale, beside the curve of the same name
    Qt::PenStyle style = Qt::SolidLine;
    int decimals = 3;
    bool fromZero = false;            ///< it is never below, and an axis of such curves begins there
    QVector<ExpectedRange> expected;  ///< shaded behind it; empty: not known
    QVector<QPointF> ahead;           ///< (tick, number): known before it has happened; drawn faintly from there on
    /// Points (tick, number) between two ticks, of each `step` of them a few (curve_sampling.h).
    std::function<void(std::int64_t from, std::int64_t to, std::int64_t step, QVector<QPointF>& points)> sample;
    std::function<double(std::int64_t tick)> at;  ///< NaN: unknown
};

/// What has happened up to the `last` tick that is known, or else what is known ahead of it.
double numberAt(const PlotCurve& curve, std::int64_t tick, std::int64_t last);
/// What it is drawn with, also in a legend.
QPen curvePen(const PlotCurve& curve);
/// What is drawn of it ahead of time, on a ground of that colour: thinner, and as pale as can still be seen there. It
/// covers: what is drawn in pieces has no seams.
QPen aheadPen(const PlotCurve& curve, const QColor& ground);

/// The grounds on which half and most of all runs lie, on a ground of that colour.
struct ExpectedColours {
    QColor half, most;
};
ExpectedColours expectedColours(const PlotCurve& curve, const QColor& ground);
/// Curves with such grounds that are named in a legend: one of each unit, or of each colour.
std::vector<const PlotCurve*> shadedOf(const std::vector<PlotCurve>& curves, bool byUnit);
/// The like of it in a legend.
QPen expectedPen(const PlotCurve& curve, const QColor& ground);

/// What curves of a unit are held against: a dashed line through (tick, number), whose last number goes on.
struct PlotLevel {
    QString unit;
    QVector<QPointF> points;
    bool operator==(const PlotLevel& other) const { return unit == other.unit && points == other.points; }
};
/// Where its line is at a tick; NaN before it begins.
double levelAt(const PlotLevel& level, double tick);

}  // namespace mrose
