#pragma once

#include <QPointF>
#include <QString>
#include <QWidget>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "widgets/plot_axis.h"
#include "widgets/plot_curve.h"
#include "widgets/theme.h"

class QCustomPlot;
class QTimer;

namespace mrose {

class PlotBand;
class PlotReadOut;

/// Curves over one axis of time, a stack of axes for the units. It shows the tick of the timeline; press or drag asks
/// for another. The wheel zooms the time at the mouse, the right or middle button drags it, a double click shows all.
class PlotView final : public QWidget {
    Q_OBJECT

public:
    explicit PlotView(QWidget* parent = nullptr);
    ~PlotView() override;

    /// `ghostName` is that of the other branch, for the read-out.
    void setCurves(std::vector<PlotCurve> curves, const QString& ghostName = {});
    const std::vector<PlotCurve>& curves() const { return curves_; }
    /// Levels that are not to be exceeded, and the instant at which they were: a thin upright line.
    void setReferences(std::vector<PlotLevel> levels, std::optional<std::int64_t> instant);
    const std::vector<PlotLevel>& levels() const { return levels_; }
    std::optional<std::int64_t> instant() const { return instant_; }
    using Time = PlotAxis::Time;
    void setTime(const Time& time);
    const PlotAxis& axis() const { return axis_; }
    void refresh();
    void draw();  ///< at once
    /// The curves have grown: before long.
    void refreshSoon();
    void setTheme(const Theme& theme);

    void showAll();                               ///< all that is known, also as it grows
    void showRange(double from, double to);       ///< ticks
    void zoom(double factor, double aboutPixel);  ///< larger than 1: closer
    double pixelOf(double tick) const;            ///< from the left of this widget
    std::int64_t tickAt(double pixel) const;
    QStringList titles() const;                         ///< of the axes, from above: "speed (m/s)"
    std::pair<double, double> rangeOf(int axis) const;  ///< least and greatest number that is seen
    /// Where a number of a curve is drawn; nullopt: there is no such curve.
    std::optional<QPointF> placeOf(const QString& curve, double tick, double number) const;
    /// The curves and their axes without cursor and mouse, for a picture of this size; of a view that is not shown.
    void paint(QPainter& painter, const QSize& size);
    /// What the read-out says of a tick.
    QString textAt(std::int64_t tick) const;

    QSize sizeHint() const override { return {900, 200}; }
    QSize minimumSizeHint() const override;

signals:
    void tickRequested(std::int64_t tick);
    void hovered(std::optional<std::int64_t> tick);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;
    void showEvent(QShowEvent* event) override;

private:
    void layOut();
    QFont titleFont() const;
    void paintTheme();
    void moveCursors();
    double axisWidth() const;  ///< pixels
    void hover(std::optional<QPointF> mouse);
    void press(const QMouseEvent& event);
    void move(const QMouseEvent& event);

    QCustomPlot* plot_;
    PlotReadOut* readOut_;
    QTimer* soon_;
    std::vector<PlotCurve> curves_;
    QString ghostName_;
    std::vector<PlotLevel> levels_;
    std::optional<std::int64_t> instant_;
    std::vector<std::unique_ptr<PlotBand>> bands_;
    PlotAxis axis_;
    Theme theme_ = Theme::light();
    bool dirty_ = false, seeking_ = false;
    std::optional<double> panFrom_;  ///< pixel
};

}  // namespace mrose
