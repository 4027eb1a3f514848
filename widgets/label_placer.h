#pragma once

#include <QRectF>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace mrose {

/// Finds places for the labels of a moving picture: never on one another, inside the picture, off bodies where that can
/// be, and beside the same side of what they name as in the picture before, so that they do not jump about. Labels that
/// are asked for first choose first.
class LabelPlacer {
public:
    struct Wanted {
        std::uint64_t key = 0;  ///< the same from picture to picture
        QPointF at;             ///< the middle of what it names, pixels
        double clearance = 0;   ///< from there to its edge
        QSizeF size;
    };
    struct Placed {
        QRectF box;
        bool far = false;  ///< a line should lead there
    };

    /// The next picture's labels stand beside the same sides as those of another placer's last one, where they can.
    void followOther(const LabelPlacer& other) { slots_ = other.slots_; }
    bool standsLike(const LabelPlacer& other) const { return slots_ == other.slots_; }

    /// Another picture: `frame` holds all labels.
    void begin(const QRectF& frame);
    void avoid(const QRectF& body) { bodies_.push_back(body); }
    void keepFree(const QRectF& box) { taken_.push_back(box); }  ///< no label stands there
    /// nullopt: there is no room.
    std::optional<Placed> place(const Wanted& wanted);

private:
    QRectF boxOf(const Wanted& wanted, int slot) const;
    bool fits(const QRectF& box) const;
    double cost(const QRectF& box, int slot) const;

    QRectF frame_;
    std::vector<QRectF> bodies_, taken_;
    std::map<std::uint64_t, int> slots_, before_;
};

}  // namespace mrose
