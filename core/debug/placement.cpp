#include "debug/placement.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "geometry/point.h"
#include "scenario/start_check.h"

namespace mrose {
namespace {

bool overlap(const Shape& a, const Placement& ofA, const Shape& b, const Placement& ofB) {
    for (const ConvexPiece& piece : a.pieces) {
        const ConvexPiece here = placed(piece, ofA);
        for (const ConvexPiece& other : b.pieces)
            if (mrose::distance(here, placed(other, ofB)) < 0) return true;
    }
    return false;
}

/// What a body may meet within some distance of a place.
class Surroundings {
public:
    Surroundings(const FieldFrame& frame, std::size_t body, const Point& about, double reach)
        : shape_(frame.scene().shapeOf(body)), span_(spanOf(frame.scene())) {
        const Scene& scene = frame.scene();
        const double near = shape_.reach + reach;
        for (std::size_t other = 0; other < scene.bodyCount(); ++other) {
            const Shape& its = scene.shapeOf(other);
            const Pose& at = frame.poseOf(other);
            if (other != body && distance(about, position(at)) <= near + its.reach)
                others_.push_back({its, Placement(at), frame.nameOf(other)});
        }
        for (const Obstacle& obstacle : scene.environment.obstacles)
            others_.push_back({obstacle.shape, {}, obstacle.name});
    }

    std::string hindranceAt(const Pose& pose) const {
        if (span_ && !span_->contains(position(pose))) return "outside the field";
        const Placement there(pose);
        for (const Other& other : others_)
            if (overlap(shape_, there, other.shape, other.placement)) return "on " + other.name;
        return {};
    }
    bool isFree(const Pose& pose) const { return hindranceAt(pose).empty(); }

private:
    struct Other {
        const Shape& shape;
        Placement placement;
        const std::string& name;
    };
    const Shape& shape_;
    std::optional<SceneSpan> span_;
    std::vector<Other> others_;
};

}  // namespace

std::string hindranceAt(const FieldFrame& frame, std::size_t body, const Pose& pose) {
    return Surroundings(frame, body, position(pose), 0).hindranceAt(pose);
}

std::optional<Pose> freePlaceNear(const FieldFrame& frame, std::size_t body, const Pose& pose, double reach) {
    constexpr double ring = 0.02;  // m between rings, and between the places that are tried on one
    constexpr int mostOnRing = 90, halvings = 8;
    const Surroundings surroundings(frame, body, position(pose), reach);
    if (surroundings.isFree(pose)) return pose;
    const auto away = [&](double radius, double angle) {
        const Point place = position(pose) + radius * towards(angle);
        return Pose{place.x, place.y, pose.heading};
    };
    for (int k = 1; k * ring <= reach; ++k) {
        const double radius = k * ring;
        const double turn = 2 * std::numbers::pi;
        const int places = std::clamp(static_cast<int>(turn * radius / ring), 8, mostOnRing);
        for (int i = 0; i < places; ++i) {
            const double angle = turn * i / places;
            if (!surroundings.isFree(away(radius, angle))) continue;
            double blocked = radius - ring, free = radius;
            for (int half = 0; half < halvings; ++half) {
                const double middle = (blocked + free) / 2;
                (surroundings.isFree(away(middle, angle)) ? free : blocked) = middle;
            }
            return away(free, angle);
        }
    }
    return {};
}

}  // namespace mrose
