#include "scenario/ball_contact.h"

#include <algorithm>

namespace mrose {

double ballContact(const Shape& shape, double ballRadius) {
    const auto meets = [&](double x) {
        const ConvexPiece ball = ConvexPiece::circle({x, 0}, ballRadius);
        return std::any_of(shape.pieces.begin(), shape.pieces.end(),
                           [&](const ConvexPiece& piece) { return distance(ball, piece) < 0; });
    };
    double clear = shape.reach + ballRadius + 1e-3;
    const double step = std::min(ballRadius, 0.01);
    while (clear > 0 && !meets(clear)) clear -= step;
    double touching = clear;
    clear += step;
    while (clear - touching > 1e-7) {
        const double middle = (touching + clear) / 2;
        (meets(middle) ? touching : clear) = middle;
    }
    return clear - ballRadius;
}

}  // namespace mrose
