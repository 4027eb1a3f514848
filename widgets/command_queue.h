#pragma once

#include <QWidget>
#include <optional>
#include <vector>

#include "debug/dead_time_queue.h"
#include "widgets/theme.h"

namespace mrose {

/// The commands of one robot on their way: each travels from where it was issued, at the right, to "now" at the left,
/// where it takes effect. Two lanes over one scale of time, of forward speed and of rotation, since their dead times
/// may differ.
class CommandQueue final : public QWidget {
    Q_OBJECT

public:
    struct Content : DeadTimeQueue {
        QColor colour = {};  ///< the robot's
    };
    explicit CommandQueue(QWidget* parent = nullptr);

    void setContent(Content content);
    void setTheme(const Theme& theme);

    /// What was commanded at one instant, newly or to go on as before.
    struct Instant {
        Nanoseconds issued = 0;
        Command command;
        Nanoseconds untilV = 0, untilW = 0;  ///< takes effect in so long; 0 and less: it has
    };
    /// Oldest first: the one in effect, those on their way.
    const std::vector<Instant>& instants() const { return instants_; }
    /// Where what takes effect in so long lies, from the left.
    double pixelOf(Nanoseconds until) const;
    /// The instant that is on its way at a place; nullopt: none there.
    std::optional<std::size_t> instantAt(const QPointF& place) const;
    QString textOf(const Instant& instant) const;

    QSize sizeHint() const override { return {290, 133}; }
    QSize minimumSizeHint() const override { return {160, 133}; }

signals:
    /// Asked for by a double click or Enter: the command issued at this instant.
    void commandActivated(qint64 issued);

protected:
    void paintEvent(QPaintEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool event(QEvent* event) override;

private:
    struct Lane;
    Nanoseconds scaleEnd() const;
    QRectF laneBox(bool rotation) const;
    void paintLane(QPainter& painter, bool rotation) const;
    void paintScale(QPainter& painter) const;
    double highest(bool rotation) const;
    void mark(std::optional<std::size_t> instant);

    Content content_;
    std::vector<Instant> instants_;
    std::optional<Nanoseconds> marked_;  ///< the issue time of the instant under the mouse, or chosen by keys
    Theme theme_ = Theme::light();
};

}  // namespace mrose
