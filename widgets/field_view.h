#pragma once

#include <QPixmap>
#include <QWidget>
#include <memory>
#include <optional>

#include "debug/field_frame.h"
#include "widgets/field_drag.h"
#include "widgets/field_picture.h"
#include "widgets/field_viewport.h"

namespace mrose {

/// The field from above, and all that happens on it at the shown tick. Draws the values it is given; what the user does
/// to them it asks for by signals.
///
/// Wheel: zoom at the cursor. Left drag: of a body while editing is allowed, moves it; elsewhere, moves the view; with
/// Shift, measures. Drag of the selected robot's knob, or right drag of a body: turns it. With Ctrl both go by round
/// numbers; Escape takes them back. Click: selects. Double click on a body: follows it. Resting on something: shows
/// what it is.
class FieldView final : public QWidget {
    Q_OBJECT

public:
    explicit FieldView(QWidget* parent = nullptr);

    void setFrame(std::shared_ptr<const FieldFrame> frame);
    void setTheme(const Theme& theme);
    void setLayers(const FieldLayers& layers);
    /// What is said where there is no frame.
    void setEmptyText(const QString& text);
    /// Whether bodies can be dragged: while the run stands.
    void setEditable(bool editable);
    void setSelected(std::optional<std::size_t> body);
    /// Shows the same part of the field as another view.
    void setView(const ViewTransform& view);

    /// A button of the mouse is down that was pressed there.
    bool held() const { return drag_.kind != FieldDrag::Kind::none; }

    const FieldLayers& layers() const { return layers_; }
    /// What is seen; changed there, it is drawn so.
    FieldViewport& viewport() { return viewport_; }
    const FieldViewport& viewport() const { return viewport_; }
    const ViewTransform& transform() const { return viewport_.transform(); }
    std::optional<std::size_t> selected() const { return focus_.selected; }
    /// Shows some bodies, near enough to see what they do, and all others quietly, until another one is selected, all
    /// of the place is shown or the run goes on.
    void lightUp(const std::vector<std::size_t>& bodies);
    /// Of each body where it is in another branch; nullopt: at the same place.
    void setElsewhere(std::vector<std::optional<Point>> elsewhere);
    /// Drawn where that layer is shown, until others are given.
    void setBands(const RobotBands& bands);
    const RobotBands& bands() const { return focus_.bands; }
    /// Labels stand where those of another view do, where they can.
    void followLabels(const LabelPlacer& labels);
    /// Moves the selected body by metres and radians, if that is allowed. While the Alt key is held the moves add up,
    /// and are asked for when it is released.
    void nudge(const Pose& by);
    /// What the tool tip says of a place in pixels; empty: there is nothing.
    QString readoutAt(const QPointF& pixels) const;
    /// The same picture for a file of another size.
    void paint(QPainter& painter, const QSizeF& size) const;
    /// How it draws, for pictures of other ticks; without what the mouse does.
    FieldPicture picture() const;

    QSize sizeHint() const override { return {900, 560}; }
    QSize minimumSizeHint() const override { return {240, 180}; }

signals:
    void bodySelected(std::optional<std::size_t> body);
    void bodyMoved(std::size_t body, const Pose& pose);  ///< it is to be put there
    void cursorMoved(std::optional<Point> metres);
    void followRequested();
    void dragRefused();  ///< of a body, while bodies cannot be moved
    void viewChanged(const ViewTransform& view);
    void labelsMoved(const LabelPlacer& labels);
    void layersChanged(const FieldLayers& layers);

protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    bool event(QEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    /// Of the mouse or of nudges; `keep`: it is asked to put the selected body where they brought it.
    void endDrag(bool keep);

    std::shared_ptr<const FieldFrame> frame_;
    Theme theme_ = Theme::light();
    FieldLayers layers_;
    FieldViewport viewport_;
    FieldFocus focus_;
    FieldLegend legend_;
    mutable LabelPlacer labels_;  ///< where they stood in the last picture
    LabelPlacer reportedLabels_;
    std::optional<LabelPlacer> likeLabels_;  ///< those of another view
    QString emptyText_;
    FieldDrag drag_;
    bool nudging_ = false;

    QPixmap place_;  ///< what does not change from tick to tick, for placeView_
    ViewTransform placeView_, reportedView_;
    const Scenario* placeOf_ = nullptr;
};

}  // namespace mrose
