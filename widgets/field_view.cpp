#include "widgets/field_view.h"

#include <QMouseEvent>
#include <QPaintEvent>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <utility>

namespace mrose {
namespace {

constexpr double fitMargin = 16, grabPixels = 6, dragPixels = 4;

}  // namespace

FieldView::FieldView(QWidget* parent) : QWidget(parent) {
    setMouseTracking(true);
    setAttribute(Qt::WA_OpaquePaintEvent);
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("Field"));
}

void FieldView::setFrame(std::shared_ptr<const FieldFrame> frame) {
    const bool other = !frame_ || !frame || frame_->scenario != frame->scenario;
    frame_ = std::move(frame);
    if (other) {
        const std::size_t bodies = frame_ ? frame_->scene().bodyCount() : 0;
        if (focus_.selected && *focus_.selected >= bodies) setSelected(std::nullopt);
        focus_.hovered.reset();
        drag_ = Drag::none;
        focus_.moved.reset();
        fit();
    }
    followSelected();
    update();
}

void FieldView::setTheme(const Theme& theme) {
    theme_ = theme;
    place_ = {};
    update();
}

void FieldView::setLayers(const FieldLayers& layers) {
    layers_ = layers;
    place_ = {};
    update();
    emit layersChanged(layers);
}

void FieldView::setSelected(std::optional<std::size_t> body) {
    if (body == focus_.selected) return;
    focus_.selected = body;
    emit bodySelected(body);
    followSelected();
    update();
}

void FieldView::setFollowing(bool following) {
    following_ = following;
    followSelected();
    update();
}

void FieldView::followSelected() {
    if (!following_ || !frame_ || !focus_.selected) return;
    view_.setCentre(position(frame_->poseOf(*focus_.selected)));
    fitted_ = false;
}

FieldArea FieldView::wholeArea() const {
    const FieldArea place = areaOf(frame_->scene().environment);
    return place.empty() ? areaOf(*frame_) : place;
}

void FieldView::fit() {
    if (!frame_) return;
    view_.fit(wholeArea(), fitMargin);
    fitted_ = true;
    update();
}

void FieldView::setView(const ViewTransform& view) {
    ViewTransform like = view_;
    like.showLike(view);
    if (like == view_) return;
    view_ = toldView_ = like;
    fitted_ = false;
    update();
}

void FieldView::zoom(double factor) {
    view_.zoom(factor, QPointF(width() / 2.0, height() / 2.0));
    fitted_ = false;
    update();
}

void FieldView::panBy(const QPointF& pixels) {
    view_.pan({0, 0}, pixels);
    fitted_ = false;
    update();
}

std::optional<std::size_t> FieldView::bodyAt(const QPointF& pixels) const {
    if (!frame_) return std::nullopt;
    const Point at = view_.toMetres(pixels);
    const double slack = grabPixels / view_.scale();
    const ConvexPiece finger = ConvexPiece::circle(at, slack);
    for (std::size_t i = frame_->scene().bodyCount(); i-- > 0;) {
        const Shape& shape = frame_->scene().shapeOf(i);
        const Pose& pose = frame_->poseOf(i);
        if (distance(position(pose), at) > shape.reach + slack) continue;
        const Placement placement(pose);
        for (const ConvexPiece& piece : shape.pieces)
            if (mrose::distance(placed(piece, placement), finger) <= 0) return i;
    }
    return std::nullopt;
}

void FieldView::drawPlace() {
    const double ratio = devicePixelRatioF();
    place_ = QPixmap(size() * ratio);
    place_.setDevicePixelRatio(ratio);
    placeView_ = view_;
    placeOf_ = frame_->scenario.get();
    QPainter painter(&place_);
    painter.setFont(font());
    FieldPainter(painter, view_, theme_, layers_).place(frame_->scene().environment);
}

void FieldView::paintEvent(QPaintEvent* /*event*/) {
    QPainter painter(this);
    if (!frame_) {
        painter.fillRect(rect(), theme_.surround);
        return;
    }
    if (place_.isNull() || !(placeView_ == view_) || placeOf_ != frame_->scenario.get() ||
        place_.devicePixelRatio() != devicePixelRatioF())
        drawPlace();
    painter.drawPixmap(0, 0, place_);
    FieldPainter field(painter, view_, theme_, layers_);
    field.frame(*frame_, focus_);
    field.ruler();
    if (!(toldView_ == view_)) emit viewChanged(toldView_ = view_);
    if (drag_ == Drag::measure) field.measure(view_.toMetres(pressedAt_), view_.toMetres(draggedTo_));
}

void FieldView::paint(QPainter& painter, const QSizeF& size) const {
    if (!frame_) return;
    ViewTransform view = view_;
    view.setSize(size);
    view.fit(view_.shown(), 0);  // as much as the window shows
    FieldPainter field(painter, view, theme_, layers_);
    field.place(frame_->scene().environment);
    field.frame(*frame_, focus_);
    field.ruler();
}

void FieldView::resizeEvent(QResizeEvent* event) {
    view_.setSize(event->size());
    if (fitted_) fit();
}

void FieldView::wheelEvent(QWheelEvent* event) {
    view_.zoom(std::pow(1.0015, event->angleDelta().y()), event->position());
    fitted_ = false;
    followSelected();
    update();
    event->accept();
}

void FieldView::mousePressEvent(QMouseEvent* event) {
    setFocus();
    if (drag_ != Drag::none || !frame_) return;
    button_ = event->button();
    pressedAt_ = draggedTo_ = event->localPos();
    const std::optional<std::size_t> body = bodyAt(pressedAt_);
    const bool measuring = button_ == Qt::LeftButton && event->modifiers().testFlag(Qt::ShiftModifier);
    drag_ = measuring ? Drag::measure : Drag::pressed;
    if (!measuring && body) setSelected(body);
}

void FieldView::mouseMoveEvent(QMouseEvent* event) {
    const QPointF at = event->localPos();
    emit cursorMoved(view_.toMetres(at));
    if (drag_ != Drag::none) {
        drag(at);
        return;
    }
    const std::optional<std::size_t> body = bodyAt(at);
    if (body == focus_.hovered) return;
    focus_.hovered = body;
    setCursor(body ? (editable_ ? Qt::SizeAllCursor : Qt::PointingHandCursor) : Qt::ArrowCursor);
    update();
}

void FieldView::drag(const QPointF& at) {
    if (drag_ == Drag::pressed) {
        if ((at - pressedAt_).manhattanLength() < dragPixels) return;
        const bool onBody = focus_.selected && bodyAt(pressedAt_) == focus_.selected;
        drag_ = Drag::pan;
        if (onBody && editable_ && button_ != Qt::MiddleButton)
            drag_ = button_ == Qt::RightButton ? Drag::turn : Drag::move;
        else if (button_ == Qt::RightButton)
            drag_ = Drag::none;
    }
    if (drag_ == Drag::pan) {
        view_.pan(draggedTo_, at);
        fitted_ = false;
    } else if (drag_ == Drag::move && focus_.selected) {
        Pose pose = frame_->poseOf(*focus_.selected);
        const Point by = view_.toMetres(at) - view_.toMetres(pressedAt_);
        pose.x += by.x;
        pose.y += by.y;
        focus_.moved = pose;
    } else if (drag_ == Drag::turn && focus_.selected) {
        Pose pose = frame_->poseOf(*focus_.selected);
        const Point to = view_.toMetres(at) - position(pose), from = view_.toMetres(pressedAt_) - position(pose);
        // From near its middle a body is turned to face the cursor, otherwise along with where it was taken.
        const double turned =
            std::atan2(to.y, to.x) -
            (length(from) * view_.scale() < 2 * grabPixels ? pose.heading : std::atan2(from.y, from.x));
        pose.heading = wrapAngle(pose.heading + turned);
        focus_.moved = pose;
    }
    draggedTo_ = at;
    update();
}

void FieldView::mouseReleaseEvent(QMouseEvent* event) {
    if (drag_ == Drag::none || event->button() != button_) return;
    const Drag done = std::exchange(drag_, Drag::none);
    if (done == Drag::pressed && button_ == Qt::LeftButton && !bodyAt(pressedAt_)) setSelected(std::nullopt);
    const std::optional<Pose> moved = std::exchange(focus_.moved, std::nullopt);
    if (moved && focus_.selected) emit bodyMoved(*focus_.selected, *moved);
    update();
}

void FieldView::leaveEvent(QEvent* /*event*/) {
    focus_.hovered.reset();
    emit cursorMoved(std::nullopt);
    update();
}

}  // namespace mrose
