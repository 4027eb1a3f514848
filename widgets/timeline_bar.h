#pragma once

#include <QWidget>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "widgets/theme.h"
#include "widgets/timeline_content.h"
#include "widgets/timeline_glyphs.h"
#include "widgets/timeline_signs.h"

namespace mrose {

/// A branch's ticks from left to right, what happened in them, and now. Press: asks for that tick, or for the mark
/// beside it; drag: for each. Page Up and Down: a tenth of what is seen back and on. Wheel: zooms at the cursor, with
/// Shift along the time. Resting the mouse: shows what happened there.
class TimelineBar final : public QWidget {
    Q_OBJECT

public:
    using Content = TimelineContent;
    explicit TimelineBar(QWidget* parent = nullptr);

    void setContent(Content content);
    const Content& content() const { return content_; }
    void setTheme(const Theme& theme);

    double pixelOf(std::int64_t tick) const;
    std::int64_t tickAt(double pixel) const;  ///< the nearest one
    /// So many times as long; what lies at `pixel` stays there. Never shorter than the bar.
    void zoom(double factor, double pixel);
    void zoom(double factor) { zoom(factor, pixelOf(content_.now)); }
    void pan(double pixels);
    double zoomed() const { return zoom_; }  ///< 1: all is shown

    /// What happened near a pixel, in rich text.
    QString textAt(double pixel) const;

    QSize sizeHint() const override { return {600, timeline::height}; }
    QSize minimumSizeHint() const override { return {200, timeline::height}; }

signals:
    void tickRequested(std::int64_t tick);

protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void leaveEvent(QEvent* event) override;
    bool event(QEvent* event) override;

private:
    /// Pixels: marks so near to the cursor are described, and a click goes to the nearest of them.
    static constexpr double tipReach = 4;

    std::int64_t tickOf(const QPointF& pixel) const;
    std::vector<TimelineSign> signs() const;
    std::array<std::pair<double, double>, markKinds> tipRanges(double pixel) const;
    void showToolTip(double pixel);
    double length() const;  ///< pixels, of all ticks
    double room() const;    ///< pixels, of what is seen of them
    void setOffset(double offset);
    void paintTrack(QPainter& painter) const;
    void paintScale(QPainter& painter) const;
    void paintContacts(QPainter& painter) const;
    void paintSign(QPainter& painter, double x, TimelineMark::Kind kind) const;
    void paintMarks(QPainter& painter) const;
    void paintNoted(QPainter& painter) const;
    double roomBeside(const Content::Noted& noted) const;
    void paintUnknown(QPainter& painter) const;
    void paintBranches(QPainter& painter) const;
    void paintFlag(QPainter& painter, std::int64_t tick, bool now) const;

    Content content_;
    Theme theme_ = Theme::light();
    bool dragging_ = false;
    std::optional<QPointF> hovered_;
    std::optional<double> pressedAt_;  ///< until it is dragged
    double zoom_ = 1, offset_ = 0;     ///< pixels of all ticks that lie left of what is seen
};

}  // namespace mrose
