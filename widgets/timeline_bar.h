#pragma once

#include <QWidget>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "debug/timeline_mark.h"
#include "scenario/scenario.h"
#include "widgets/theme.h"
#include "widgets/timeline_glyphs.h"
#include "widgets/timeline_signs.h"
#include "world/time.h"

namespace mrose {

/// A branch's ticks from left to right, what happened in them, and now. Press: asks for that tick, or for the mark
/// beside it; drag: for each. Page Up and Down: a tenth of what is seen back and on. Wheel: zooms at the cursor, with
/// Shift along the time. Resting the mouse: shows what happened there.
class TimelineBar final : public QWidget {
    Q_OBJECT

public:
    struct Content {
        std::int64_t first = 0, last = 0, now = 0;
        std::int64_t end = 0;        ///< how far the bar reaches: what has not happened yet can be asked for as well
        std::int64_t departed = -1;  ///< tick at which the branch began; -1: it is the run itself
        Nanoseconds tickLength = 20'000'000;
        std::shared_ptr<const std::vector<TimelineMark>> marks;  ///< in the order of their ticks
        /// Marks of others than the run itself, in the order of their ticks, each with what is said of it.
        struct Noted {
            TimelineMark mark;
            QString text;
            QString name = {};   ///< beside the mark, where there is room
            bool faint = false;  ///< of a robot that is not asked about
        };
        std::vector<Noted> noted;
        /// From one tick to another: there is no ground truth.
        std::vector<std::pair<std::int64_t, std::int64_t>> unknown;
        std::vector<std::int64_t> branches;            ///< ticks at which others departed from it
        std::shared_ptr<const Scenario> scenario;      ///< for names; may be null
        std::map<std::uint32_t, QString> breakpoints;  ///< what they wait for, by their numbers
    };
    explicit TimelineBar(QWidget* parent = nullptr);

    void setContent(Content content);
    void setTheme(const Theme& theme);

    double pixelOf(std::int64_t tick) const;
    std::int64_t tickAt(double pixel) const;  ///< the nearest one
    /// So many times as long; what lies at `pixel` stays there. Never shorter than the bar.
    void zoom(double factor, double pixel);
    void zoom(double factor) { zoom(factor, pixelOf(content_.now)); }
    void pan(double pixels);
    double zoomed() const { return zoom_; }  ///< 1: all is shown

    /// The next mark after now, or the one before: of all kinds, or without contacts. nullopt: there is none.
    std::optional<std::int64_t> nextMark(bool contacts) const;
    std::optional<std::int64_t> previousMark(bool contacts) const;
    /// What happened near a pixel, in rich text.
    QString textAt(double pixel) const;

    static QColor colourOf(TimelineMark::Kind kind, const Theme& theme);

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
    std::span<const TimelineMark> marksBetween(std::int64_t from, std::int64_t to) const;
    QString nameOf(const TimelineMark& mark) const;

    Content content_;
    Theme theme_ = Theme::light();
    bool dragging_ = false;
    std::optional<QPointF> hovered_;
    std::optional<double> pressedAt_;  ///< until it is dragged
    double zoom_ = 1, offset_ = 0;     ///< pixels of all ticks that lie left of what is seen
};

/// "12.40 s", "1:02.40", "1:00:02.40": an instant of a run.
QString clockText(Nanoseconds time);

}  // namespace mrose
