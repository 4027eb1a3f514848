#pragma once

#include <QFont>
#include <QRectF>
#include <QString>
#include <QWidget>
#include <optional>
#include <vector>

#include "widgets/theme.h"
#include "world/time.h"

namespace mrose {

/// All of a log from left to right: its rollouts as cells in the colour of their errors, stretches without ground truth
/// hatched, the shown rollout framed. A click asks for the rollout there.
class RolloutStrip final : public QWidget {
    Q_OBJECT

public:
    struct Cell {
        std::size_t rollout = 0;  ///< the caller's number for it
        Nanoseconds from = 0, to = 0;
        double error = 0;                                    ///< m; not a number: unknown
        std::optional<Nanoseconds> diverges = std::nullopt;  ///< on the strip's clock
    };
    struct Span {
        Nanoseconds from = 0, to = 0;
    };
    struct Content {
        QString title;           ///< whose errors they are
        Nanoseconds length = 0;  ///< of the log
        std::vector<Cell> cells;
        std::vector<Span> unknown;  ///< no ground truth
        std::optional<std::size_t> shown;
        Nanoseconds now = 0;
    };
    explicit RolloutStrip(QWidget* parent = nullptr);

    void setContent(Content content);
    void setNow(Nanoseconds now);
    void setTheme(const Theme& theme);

    /// The middle of a rollout's cell; its height is that of the strip.
    double pixelOf(std::size_t rollout) const;
    QString textAt(double pixel) const;
    double worst() const { return worst_; }  ///< m: what the last colour stands for
    QString worstText() const;               ///< of the legend: "2.3 cm"; with a sign where some are off by more
    QString shownTitle() const;              ///< what there is room for
    QRectF legendRoom() const;               ///< beside it, of the colours; empty: there are none

    /// From 0 to 1, told apart by lightness alone as well: cividis (Nunez, Anderton and Renslow 2018).
    static QColor rampColour(double share);

    QSize sizeHint() const override { return {600, 40}; }
    QSize minimumSizeHint() const override { return {200, 40}; }

signals:
    void rolloutRequested(std::size_t rollout);

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    bool event(QEvent* event) override;

private:
    double pixelAt(Nanoseconds time) const;
    const Cell* cellAt(double pixel) const;
    double trackWidth() const;
    QFont smallFont() const;
    void paintCells(QPainter& painter) const;
    void paintLegend(QPainter& painter) const;

    Content content_;
    double worst_ = 0;
    Theme theme_ = Theme::light();
};

}  // namespace mrose
