#pragma once

#include <QMarginsF>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "debug/field_frame.h"
#include "widgets/view_transform.h"

namespace mrose {

/// What is seen of the field: all of the place, or a part of it, fitted into a picture until the user looks elsewhere;
/// or what lies about a body that is followed.
class FieldViewport {
public:
    /// `changed` is called when something else may be seen; `fits`: since it was fitted.
    explicit FieldViewport(std::function<void(bool fits)> changed = [](bool) {}) : changed_(std::move(changed)) {}

    const ViewTransform& transform() const { return view_; }
    bool showsPart() const { return fitted_ && part_; }  ///< of fit(area), still
    bool showsAll() const { return fitted_ && !part_; }  ///< as fit() left it
    std::optional<Area> fitted() const;                  ///< what is fitted, if anything is
    bool following() const { return following_; }
    const QMarginsF& margins() const { return margins_; }  ///< about it, pixels
    const QRectF& covered() const { return covered_; }
    /// Where all of the place lies in the view when it is fitted, pixels; empty: nothing is shown.
    QRectF fittedPlace() const;
    /// Of all of the place when it is fitted into a view of that size, pixels per metre; 0: nothing is shown.
    double fittedScale(const QSizeF& size) const;

    void setFrame(std::shared_ptr<const FieldFrame> frame);
    void setSize(const QSizeF& pixels);
    void setRulers(bool shown);  ///< they take room of what is fitted
    /// What lies over a corner: labels, the legend and what is fitted stay clear of it, but no smaller. Empty: nothing.
    void setCovered(const QRectF& covered);
    void setSelected(std::optional<std::size_t> body);
    /// The view goes along with the selected body.
    void setFollowing(bool following);

    /// All of the place, turned by a quarter where it is much larger then.
    void fit();
    void setTurned(bool turned);  ///< by a quarter, until another place is shown or all of it is fitted
    void fit(const Area& part) { fitPart(part); }
    /// Some bodies, so near that it is seen what they do, unless they are seen well already.
    void showNear(const std::vector<std::size_t>& bodies);
    bool showLike(const ViewTransform& other);  ///< the same part of the field; false: it does already
    void zoom(double factor);                   ///< about the middle
    void zoom(double factor, const QPointF& about);
    /// What lies at `from` comes to lie at `to`, pixels.
    void pan(const QPointF& from, const QPointF& to);
    void pan(const QPointF& pixels) { pan({0, 0}, pixels); }

private:
    static constexpr double fitMargin = 16, scaleBarHeight = 26;  ///< pixels
    Area whole() const;
    void turnAsSuits();
    void fitInto(ViewTransform& view, const Area& area) const;
    void fitPart(const std::optional<Area>& part);
    void refit();
    void followSelected();

    std::function<void(bool fits)> changed_;
    std::shared_ptr<const FieldFrame> frame_;
    ViewTransform view_;
    std::optional<Area> place_;  ///< that was fitted last
    std::optional<Area> part_;   ///< that is fitted; nullopt: all of the place
    std::optional<std::size_t> selected_;
    QMarginsF margins_{fitMargin, fitMargin, fitMargin, scaleBarHeight};
    QRectF covered_;
    bool fitted_ = true, following_ = false;
    bool chosen_ = false;  ///< by the user, whether it is turned
};

}  // namespace mrose
