#include "widgets/label_placer.h"

#include <algorithm>
#include <array>
#include <limits>

namespace mrose {
namespace {

/// Sides in the order in which they are liked: below, above, right, left, then between them.
constexpr std::array sides{QPointF(0, 1),      QPointF(0, -1),      QPointF(1, 0),       QPointF(-1, 0),
                           QPointF(0.8, 0.8),  QPointF(-0.8, 0.8),  QPointF(0.8, -0.8),  QPointF(-0.8, -0.8),
                           QPointF(0.45, 0.9), QPointF(-0.45, 0.9), QPointF(0.45, -0.9), QPointF(-0.45, -0.9),
                           QPointF(0.95, 0.4), QPointF(-0.95, 0.4), QPointF(0.95, -0.4), QPointF(-0.95, -0.4)};
constexpr std::array gaps{4.0, 18.0, 36.0, 58.0};  // pixels
constexpr int sideCount = sides.size(), slotCount = sideCount * static_cast<int>(gaps.size());

/// What covering a body wholly costs, in pixels of distance; and how much better another place must be to move there.
constexpr double bodyCost = 400, patience = 45;

/// Of a place that covers nothing; ascends with the slot.
double baseCost(int slot) { return gaps[static_cast<std::size_t>(slot / sideCount)] + 0.8 * (slot % sideCount); }

double covered(const QRectF& box, const QRectF& other) {
    const QRectF both = box & other;
    return both.width() > 0 && both.height() > 0 ? both.width() * both.height() : 0;
}

}  // namespace

void LabelPlacer::begin(const QRectF& frame) {
    frame_ = frame;
    bodies_.clear();
    taken_.clear();
    before_ = std::move(slots_);
    slots_.clear();
}

QRectF LabelPlacer::boxOf(const Wanted& wanted, int slot) const {
    const QPointF side = sides[static_cast<std::size_t>(slot % sideCount)];
    const double away = wanted.clearance + gaps[static_cast<std::size_t>(slot / sideCount)];
    const QPointF middle =
        wanted.at + QPointF(side.x() * (away + wanted.size.width() / 2), side.y() * (away + wanted.size.height() / 2));
    return {middle - QPointF(wanted.size.width() / 2, wanted.size.height() / 2), wanted.size};
}

bool LabelPlacer::fits(const QRectF& box) const {
    return frame_.contains(box) &&
           std::none_of(taken_.begin(), taken_.end(), [&](const QRectF& other) { return other.intersects(box); });
}

double LabelPlacer::cost(const QRectF& box, int slot) const {
    double sum = baseCost(slot);
    for (const QRectF& body : bodies_)
        sum += bodyCost * covered(box, body) / std::min(box.width() * box.height(), body.width() * body.height());
    return sum;
}

std::optional<LabelPlacer::Placed> LabelPlacer::place(const Wanted& wanted) {
    const auto known = before_.find(wanted.key);
    const int before = known == before_.end() ? -1 : known->second;
    int best = -1;
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](int slot, double bonus) {
        const QRectF box = boxOf(wanted, slot);
        if (!fits(box)) return;
        const double now = cost(box, slot) - bonus;
        if (now >= least) return;
        best = slot;
        least = now;
    };
    if (before >= 0) consider(before, patience);
    for (int slot = 0; slot < slotCount && baseCost(slot) < least; ++slot) consider(slot, 0);
    if (best < 0) return std::nullopt;
    const QRectF box = boxOf(wanted, best);
    taken_.push_back(box);
    slots_[wanted.key] = best;
    return Placed{box, best >= sideCount};
}

}  // namespace mrose
