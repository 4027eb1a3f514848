#include "identification/rollout_loss.h"

#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "geometry/elementary.h"

namespace mrose {

double RolloutLoss::operator()(std::span<const Pose> predicted, std::span<const Pose> truth,
                               std::span<Pose> gradient) const {
    const std::size_t length = predicted.size();
    assert(truth.size() == length && gradient.size() == length);
    struct Instant {
        double cosine, sine;         // of the heading at the period's start
        double byX, byY, byHeading;  // derivative of the loss by the pose at its end
    };
    std::vector<Instant> instants(length);
    Pose p, q;
    double loss = 0;
    for (std::size_t k = 0; k < length; ++k) {
        Instant& instant = instants[k];
        const SineCosine turned = sineCosine(p.heading);
        instant.cosine = turned.cosine;
        instant.sine = turned.sine;
        const Pose& d = predicted[k];
        p = {p.x + instant.cosine * d.x - instant.sine * d.y, p.y + instant.sine * d.x + instant.cosine * d.y,
             p.heading + d.heading};
        q = q * truth[k];
        const double ex = p.x - q.x, ey = p.y - q.y, eh = p.heading - q.heading;
        const double distance = std::sqrt(ex * ex + ey * ey + positionRounding * positionRounding);
        const double angle = std::sqrt(eh * eh + headingRounding * headingRounding);
        loss += distance + headingWeight * angle;
        instant.byX = ex / distance;
        instant.byY = ey / distance;
        instant.byHeading = headingWeight * eh / angle;
    }
    const double share = 1 / static_cast<double>(length);
    double byX = 0, byY = 0, byHeading = 0;
    for (std::size_t k = length; k-- > 0;) {
        const Instant& i = instants[k];
        byX += i.byX;
        byY += i.byY;
        byHeading += i.byHeading;
        gradient[k].x += share * (i.cosine * byX + i.sine * byY);
        gradient[k].y += share * (i.cosine * byY - i.sine * byX);
        gradient[k].heading += share * byHeading;
        // The heading at the period's start turned this increment: it is part of what earlier rotations did.
        const Pose& d = predicted[k];
        byHeading += byX * (-i.sine * d.x - i.cosine * d.y) + byY * (i.cosine * d.x - i.sine * d.y);
    }
    return loss * share;
}

}  // namespace mrose
