#pragma once

#include <QColor>
#include <QPen>
#include <QPointF>
#include <QString>
#include <QVector>
#include <QWidget>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "widgets/plot_curve.h"
#include "widgets/theme.h"
#include "world/time.h"

class QCustomPlot;
class QLabel;
class QTimer;

namespace mrose {

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
    struct Time {
        std::int64_t first = 0, last = 0;  ///< ticks that are known
        std::int64_t now = 0;
        Nanoseconds tickLength = 20'000'000;
        std::int64_t end = 0;  ///< how far the axis reaches at the least, where all is shown
        bool operator==(const Time&) const = default;
    };
    void setTime(const Time& time);
    const Time& time() const { return time_; }
    void refresh();
    void draw();  ///< at once
    /// The curves have grown: before long.
    void refreshSoon();
    void setTheme(const Theme& theme);

    void showAll();                               ///< all that is known, also as it grows
    void showRange(double from, double to);       ///< ticks
    void zoom(double factor, double aboutPixel);  ///< larger than 1: closer
    bool showsAll() const { return all_; }
    /// What is seen of the time, in ticks.
    double from() const { return from_; }
    double to() const { return to_; }
    double pixelOf(double tick) const;  ///< from the left of this widget
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
    struct Band;  ///< of one unit
    void layOut();
    QFont titleFont() const;
    void addBand(const QString& unit, int row);
    void paintTheme();
    void fill();
    void fillBand(Band& band);
    void addReferences(Band& band);
    void fillAhead(Band& band, double& least, double& most);
    void moveCursor();
    double reach() const;
    void setRange(double from, double to);
    void keepNowInView();
    void hover(std::optional<double> pixel, const QPoint& place);
    void placeReadOut(const QPoint& mouse);
    int coveredBy(const QRect& place) const;
    bool press(const QMouseEvent& event);
    bool move(const QMouseEvent& event);
    double numberAt(const PlotCurve& curve, std::int64_t tick) const;
    double seconds(double tick) const;

    QCustomPlot* plot_;
    QLabel* readOut_;
    std::size_t readOutPlace_ = 0;  ///< among those that it may have
    QTimer* soon_;
    std::vector<PlotCurve> curves_;
    QString ghostName_;
    std::vector<PlotLevel> levels_;
    std::optional<std::int64_t> instant_;
    std::vector<std::unique_ptr<Band>> bands_;
    Time time_;
    Theme theme_ = Theme::light();
    double from_ = 0, to_ = 1;
    bool all_ = true, dirty_ = false;
    bool seeking_ = false;
    std::optional<double> panFrom_;  ///< pixel
};

}  // namespace mrose
