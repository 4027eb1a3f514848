#pragma once

#include <bitset>
#include <memory>
#include <optional>

#include "widgets/field_drawing.h"

namespace mrose {

/// What the lines and signs of the shown layers stand for, in a corner of the picture: of layers that draw something.
/// It stays where it is, and what has been in it does, from picture to picture of a run that plays.
class FieldLegend {
public:
    /// For the next picture: in the corner where it hides least, clear of what else is covered.
    void arrange(const FieldCanvas& canvas, const FieldFrame& frame, const FieldLayers& layers,
                 const FieldFocus& focus);
    /// Pixels; empty: there is nothing to explain.
    const QRectF& box() const { return box_; }
    bool lists(FieldLayer layer) const { return drawn_.test(static_cast<std::size_t>(layer)); }
    void draw(const FieldCanvas& canvas, const FieldFrame& frame) const;

private:
    /// Another one: what was listed and where it stood counts no more.
    struct View {
        FieldLayers layers;
        QSizeF size;
        double scale = 0;
        std::optional<std::size_t> selected;
        QRectF covered;
        bool operator==(const View&) const = default;
    };
    using Drawn = std::bitset<static_cast<std::size_t>(FieldLayer::count)>;

    std::optional<View> view_;
    std::weak_ptr<const Scenario> of_;
    std::int64_t tick_ = 0;
    Drawn drawn_;
    QSizeF size_;
    int corner_ = 0;
    QRectF box_;
};

}  // namespace mrose
