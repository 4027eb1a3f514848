#pragma once

#include <limits>

#include "geometry/gap.h"
#include "physics/moving_body.h"

namespace mrose {

constexpr double never = std::numeric_limits<double>::infinity();

/// A piece of a moving body, or (body null) one that stands still in the world.
struct MovingPiece {
    const MovingBody* body = nullptr;
    const CollisionShape::Piece* piece = nullptr;
};

/// When two pieces that move evenly first come as near as touching while they approach each other: s within the tick,
/// from `from` to `until`, or never. `now`: how they lie at `from`.
///
/// Conservative advancement along separating axes (Mirtich 1996): as long as a gap is open along an axis they do not
/// touch. The axis turns with the edge that it is a normal of, and a stretch of time in which the gap is open at both
/// ends is so short that between them no turning bends it by more than a third of a millimetre.
double timeOfTouch(const MovingPiece& a, const MovingPiece& b, const Gap& now, double from, double until);

/// How far two that press on each other are from each other later, m; `now` is how they lie at `from`. Where that is at
/// least `enough` it may be up to what it says, and farther.
double distanceLater(const MovingPiece& a, const MovingPiece& b, const Gap& now, double from, double later,
                     double enough);

/// Whether they are too far from each other to touch before `until`, by circles about them: never wrongly yes.
bool tooFar(const MovingPiece& a, const MovingPiece& b, double from, double until);

/// Where it is at a time.
ConvexPiece placedAt(const MovingPiece& piece, double time);
/// How they lie at a time.
Gap gapAt(const MovingPiece& a, const MovingPiece& b, double time);

}  // namespace mrose
