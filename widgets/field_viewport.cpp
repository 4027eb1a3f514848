#include "widgets/field_viewport.h"

#include <algorithm>

#include "debug/real_robot.h"
#include "widgets/field_painter.h"

namespace mrose {
namespace {

/// About bodies that are to be seen well, m, and how large the largest of them is then, pixels from its middle.
constexpr double nearMargin = 2, leastNear = 24;
/// A place is turned where it is so many times as large then.
constexpr double worthATurn = 1.3;

QRectF within(const QSizeF& size, const QMarginsF& margins) { return QRectF({0, 0}, size).marginsRemoved(margins); }

}  // namespace

Area FieldViewport::whole() const {
    if (!frame_) return {{0, 0}, {-1, -1}};
    Area place = areaOf(frame_->scene().environment);
    if (place.empty()) return areaOf(*frame_);
    if (frame_->reality) place.include(areaOf(*frame_->reality));
    return place;
}

std::optional<Area> FieldViewport::fitted() const {
    return fitted_ ? std::optional(part_.value_or(whole())) : std::nullopt;
}

/// In the middle, or above or beside what is covered where it need not be smaller for that.
void FieldViewport::fitInto(ViewTransform& view, const Area& area) const {
    const QRectF into = within(view.size(), margins_);
    view.fit(area, into);
    const QRectF place = view.box(area);
    if (!place.intersects(covered_)) return;
    const double up = place.bottom() + fitMargin - covered_.top();
    const double left = place.right() + fitMargin - covered_.left();
    if (up <= place.top() - into.top())
        view.pan({0, up}, {0, 0});
    else if (left <= place.left() - into.left())
        view.pan({left, 0}, {0, 0});
}

QRectF FieldViewport::fittedPlace() const {
    const Area area = whole();
    if (area.empty()) return {};
    ViewTransform fitted = view_;
    fitInto(fitted, area);
    return fitted.box(area);
}

double FieldViewport::fittedScale(const QSizeF& size) const {
    const Area area = whole();
    if (area.empty()) return 0;
    ViewTransform fitted = view_;
    fitted.fit(area, within(size, margins_));
    return fitted.scale();
}

/// As it is, unless all of the place is much larger the other way. What the user chose counts.
void FieldViewport::turnAsSuits() {
    const Area area = whole();
    if (part_ || area.empty()) return;
    if (!place_ || place_->least != area.least || place_->most != area.most) chosen_ = false;
    place_ = area;
    if (chosen_) return;
    ViewTransform present = view_, other = view_;
    other.setTurned(!view_.turned());
    for (ViewTransform* view : {&present, &other}) view->fit(area, within(view_.size(), margins_));
    if (other.scale() > worthATurn * present.scale()) view_.setTurned(other.turned());
}

void FieldViewport::fit() {
    chosen_ = false;
    fitPart(std::nullopt);
}

void FieldViewport::setTurned(bool turned) {
    if (turned == view_.turned()) return;
    view_.setTurned(turned);
    chosen_ = true;
    refit();
    changed_(false);
}

void FieldViewport::refit() {
    if (!fitted_ || !frame_) return;
    turnAsSuits();
    fitInto(view_, part_.value_or(whole()));
    changed_(true);
}

void FieldViewport::followSelected() {
    if (!following_ || !frame_ || !selected_) return;
    view_.setCentre(position(frame_->poseOf(*selected_)));
    fitted_ = false;
}

void FieldViewport::setFrame(std::shared_ptr<const FieldFrame> frame) {
    const bool other = !frame_ || !frame || frame_->scenario != frame->scenario || frame_->reality != frame->reality;
    frame_ = std::move(frame);
    if (selected_ && (!frame_ || *selected_ >= frame_->scene().bodyCount())) selected_.reset();
    if (other) refit();
    followSelected();
}

void FieldViewport::setSize(const QSizeF& pixels) {
    view_.setSize(pixels);
    refit();
}

void FieldViewport::setRulers(bool shown) {
    margins_ = {fitMargin, fitMargin, fitMargin, scaleBarHeight};
    if (shown) margins_ += QMarginsF(rulerWidth, rulerHeight, 0, 0);
    refit();
}

void FieldViewport::setCovered(const QRectF& covered) {
    if (std::exchange(covered_, covered) == covered) return;
    if (fitted_ && frame_) fitInto(view_, part_.value_or(whole()));
    changed_(false);
}

void FieldViewport::setSelected(std::optional<std::size_t> body) {
    selected_ = body;
    followSelected();
}

void FieldViewport::setFollowing(bool following) {
    following_ = following;
    followSelected();
    changed_(false);
}

void FieldViewport::fitPart(const std::optional<Area>& part) {
    part_ = part;
    fitted_ = fitted_ || frame_ != nullptr;
    refit();
}

void FieldViewport::showNear(const std::vector<std::size_t>& bodies) {
    if (!frame_ || bodies.empty()) return;
    Area near{{1, 1}, {-1, -1}}, close = near;
    double reach = 0;
    for (const std::size_t body : bodies) {
        const double reaches = frame_->scene().shapeOf(body).reach;
        near.include(position(frame_->poseOf(body)), nearMargin);
        close.include(position(frame_->poseOf(body)), reaches);
        reach = std::max(reach, reaches);
    }
    const Area seen = view_.shown();
    const bool inside = close.least.x >= seen.least.x && close.least.y >= seen.least.y && close.most.x <= seen.most.x &&
                        close.most.y <= seen.most.y;
    // Who has chosen a scale at which they are seen well keeps it.
    if (inside && reach * view_.scale() >= leastNear) return;
    view_.fit(near, within(view_.size(), margins_));
    fitted_ = false;
    changed_(false);
}

bool FieldViewport::showLike(const ViewTransform& other) {
    ViewTransform like = view_;
    like.showLike(other);
    if (like == view_) return false;
    view_ = like;
    fitted_ = false;
    followSelected();
    changed_(false);
    return true;
}

void FieldViewport::zoom(double factor) {
    view_.zoom(factor, QPointF(view_.size().width() / 2, view_.size().height() / 2));
    fitted_ = false;
    changed_(false);
}

void FieldViewport::zoom(double factor, const QPointF& about) {
    view_.zoom(factor, about);
    fitted_ = false;
    followSelected();
    changed_(false);
}

void FieldViewport::pan(const QPointF& from, const QPointF& to) {
    view_.pan(from, to);
    fitted_ = false;
    changed_(false);
}

}  // namespace mrose
