#pragma once

#include <QString>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <qcustomplot.h>

#include "widgets/plot_axis.h"
#include "widgets/plot_curve.h"
#include "widgets/theme.h"

namespace mrose {

/// The curves of one unit in a plot, over the time that bands above and below share: their axis, its title, the levels
/// that they are held against, and upright lines at instants. The plot owns what is drawn.
class PlotBand {
public:
    static constexpr int leftMargin = 46, rightMargin = 12;  ///< pixels beside the axes
    static constexpr int least = 84, timeRoom = 30;  ///< pixels: of one with its title, for the time below the last

    PlotBand(QCustomPlot& plot, const QString& unit, int row);

    // They outlive the band.
    void addCurve(const PlotCurve& curve);
    void addLevel(const PlotLevel& level);
    /// When all curves are there: with the time below it, or above another one.
    void finish(const QFont& font, bool last);
    void setTheme(const Theme& theme, const QFont& font);

    const QString& unit() const { return unit_; }
    const QString& title() const { return called_; }
    std::pair<double, double> range() const;  ///< least and greatest number that is seen
    bool has(const QString& curve) const;
    QPointF placeOf(double second, double number) const;
    /// How many points of the curves lie there, of which each has one in every fourth pixel.
    int coveredBy(const QRect& place, const std::function<std::int64_t(double)>& tickAt,
                  const PlotAxis::Time& time) const;

    /// Takes from the curves what is seen of them, on one of so many bands.
    void fill(const PlotAxis& axis, int bands);
    void moveCursors(const PlotAxis& axis, std::optional<std::int64_t> instant);
    void setMouse(std::optional<double> second);
    void hideCursors();

private:
    QCPAxis* time() const { return rect_->axis(QCPAxis::atBottom); }
    QCPAxis* value() const { return rect_->axis(QCPAxis::atLeft); }
    struct Extent;
    void fillCurves(const PlotAxis& axis, Extent& extent);
    void fillExpected(const PlotAxis& axis, Extent& extent);
    void fillAhead(const PlotAxis& axis, Extent& extent);
    void fillLevels(const PlotAxis& axis, Extent& extent);
    void fitRange(const Extent& extent);

    QString unit_;
    QString called_;  ///< all of its title
    QColor known_;    ///< the ground where something has happened
    QCustomPlot& plot_;
    QCPAxisRect* rect_;
    QCPItemLine *now_, *mouse_, *instant_;
    QCPItemRect* unknown_;  ///< the ground where nothing has happened yet
    QCPItemText* title_;
    std::vector<std::pair<const PlotCurve*, QCPGraph*>> graphs_;
    std::vector<std::pair<const PlotCurve*, QCPGraph*>> ahead_;  ///< of what has not happened yet
    std::vector<std::pair<const PlotLevel*, QCPGraph*>> levels_;
    /// The edges of what is shaded: of most runs, of half of them, each the lower one and the upper.
    struct Shaded {
        const PlotCurve* curve;
        std::array<QCPGraph*, 4> edges;
    };
    std::vector<Shaded> shaded_;
};

}  // namespace mrose
