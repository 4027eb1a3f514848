#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <QWidget>

#include "widgets/theme.h"
#include "widgets/timeline_mark.h"
#include "world/time.h"

namespace mrose {

/// A branch's ticks from left to right, what happened in them, and now. Press or drag: asks for that tick.
class TimelineBar final : public QWidget {
    Q_OBJECT

public:
    struct Content {
        std::int64_t first = 0, last = 0, now = 0;
        std::int64_t end = 0;        ///< how far the bar reaches: what has not happened yet can be asked for as well
        std::int64_t departed = -1;  ///< tick at which the branch began; -1: it is the run itself
        Nanoseconds tickLength = 20'000'000;
        std::shared_ptr<const std::vector<TimelineMark>> marks;
        std::vector<std::int64_t> branches;  ///< ticks at which others departed from it
    };
    explicit TimelineBar(QWidget* parent = nullptr);

    void setContent(Content content);
    void setTheme(const Theme& theme);

    double pixelOf(std::int64_t tick) const;
    std::int64_t tickAt(double pixel) const;  ///< the nearest one
    static QColor colourOf(TimelineMark::Kind kind, const Theme& theme);

    QSize sizeHint() const override { return {600, 58}; }
    QSize minimumSizeHint() const override { return {200, 58}; }

signals:
    void tickRequested(std::int64_t tick);

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    bool event(QEvent* event) override;

private:
    void ask(double pixel);
    void paintScale(QPainter& painter);
    void paintMarks(QPainter& painter);
    QString textAt(double pixel) const;

    Content content_;
    Theme theme_ = Theme::light();
    bool dragging_ = false;
};

/// "12.40 s", "1:02.40", "1:00:02.40": an instant of a run.
QString clockText(Nanoseconds time);

}  // namespace mrose
