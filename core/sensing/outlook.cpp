#include "sensing/outlook.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sensing/sensor_view.h"

namespace mrose {
namespace {

/// The directions within an angle of which `tangent` is the tangent, of a point.
Horizon::Arc within(const Point& point, double tangent) {
    const Point aside = tangent * Point{-point.y, point.x};
    return {Horizon::turnOf(point - aside), Horizon::turnOf(point + aside)};
}

/// All those, and few others, sooner; `away`: the point's distance, `turn`: its direction.
Horizon::Arc around(const Point& point, double away, double turn, double tangent) {
    if (!(tangent < 0.5)) return {};
    // How fast turns grow with angles, r2 / (|x| + |y|)2, changes by a factor of at most e^(2 angle).
    const double share = away / (std::abs(point.x) + std::abs(point.y));
    const double width = tangent * std::min(1.0, share * share * (1 + 2 * tangent + 3 * tangent * tangent));
    const double right = turn - width, left = turn + width;
    return {right < -2 ? right + 4 : right, left > 2 ? left - 4 : left};
}

/// The directions of a box that the origin is not in.
Horizon::Arc arcOfBox(const Point& least, const Point& most) {
    const bool above = least.y > 0, before = least.x > 0;
    const bool below = most.y < 0, behind = most.x < 0;
    const double nearX = before ? least.x : most.x, nearY = above ? least.y : most.y;
    const Point right{above ? most.x : below ? least.x : nearX, before ? least.y : behind ? most.y : nearY};
    const Point left{above ? least.x : below ? most.x : nearX, before ? most.y : behind ? least.y : nearY};
    return {Horizon::turnOf(right), Horizon::turnOf(left)};
}

}  // namespace

/// Notes that a body meets these bundles.
void Outlook::bundle(std::uint32_t body, std::size_t first, std::size_t last) {
    for (std::uint32_t& strand : std::span(bundles_).subspan(first, last + 1 - first)) {
        strands_.push_back({body, strand});
        strand = static_cast<std::uint32_t>(strands_.size() - 1);
    }
}

void Outlook::meet(const PointGrid::Entry& entry) {
    const Point offset = entry.point - field_.eye;
    const double away = length(offset), turn = Horizon::turnOf(offset);
    Horizon::Arc hides{0, 0};
    if (occlusion_) {
        // Tangents touch a disc at an angle whose sine is this; the angle's tangent is a little more.
        const double inverse = 1 / away, sine = widest_ * inverse;
        const Horizon::Arc arc = around(offset, away, turn, sine * (1 + sine * sine));
        if (horizon_.isClosed(arc)) return;
        const std::size_t first = bundleOf(Horizon::firstOf(arc)), last = bundleOf(Horizon::lastOf(arc));
        if (arc.right <= arc.left) {
            bundle(entry.number, first, last);
        } else {
            bundle(entry.number, first, bundles - 1);
            bundle(entry.number, 0, last);
        }
        const double solid = (cores_[entry.number] * (1 - 1e-6) - slack_) * inverse;
        if (solid > 0 && solid < 1) hides = within(offset, solid);
    }
    Body& body = met_.emplace_back();
    body.entry = entry;
    body.away = away;
    body.turn = turn;
    body.core = hides;
}

/// Those not farther than `limit`: nothing that is still to be met is nearer, or hides one of them.
void Outlook::settle(double limit) {
    for (const Body& body : met_)
        if (!(body.away > limit) && !horizon_.isClosed(body.turn)) found_.push_back(body);
    std::erase_if(met_, [&](const Body& body) {
        if (body.away > limit) return false;
        horizon_.close(body.core);
        return true;
    });
}

void Outlook::look(const SensorView& view, const BodyMap& map, const SightField& field, bool occlusion) {
    field_ = field;
    occlusion_ = occlusion;
    slack_ = map.grid.slack();
    cores_ = view.buffers.coresOf(view.scene);
    horizon_.open();
    if (!field.allRound) horizon_.close({Horizon::turnOf(field.leftEdge), Horizon::turnOf(field.rightEdge)});
    bundles_.fill(none);
    strands_.clear();
    found_.clear();
    // Whoever sticks out of a cell may hide something beside it, or something a little nearer than itself.
    widest_ = occlusion ? view.scene.widestReach() * (1 + 1e-6) + slack_ : 0;
    const auto enter = [&](const PointGrid::Box& box, double nearest) {
        if (nearest > field.range * (1 + 1e-6) + widest_) return false;
        const Point least = box.least - field.eye - Point{widest_, widest_};
        const Point most = box.most - field.eye + Point{widest_, widest_};
        const bool inside = least.x <= 0 && least.y <= 0 && most.x >= 0 && most.y >= 0;
        return inside || !std::isfinite(length(most - least)) || !horizon_.isClosed(arcOfBox(least, most));
    };
    const auto visit = [&](std::span<const PointGrid::Entry> entries) {
        for (const PointGrid::Entry& entry : entries)
            if (entry.number != view.robot) meet(entry);
    };
    const auto advance = [&](double nearest) { settle(nearest - widest_); };
    map.grid.spread(field.eye, spreading_, enter, visit, advance);
    settle(std::numeric_limits<double>::infinity());
}

}  // namespace mrose
