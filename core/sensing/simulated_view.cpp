#include "sensing/simulated_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "geometry/elementary.h"
#include "sensing/sector_box.h"
#include "sensing/sensor_view.h"

namespace mrose {
namespace {

constexpr double clear = SensedState::clear;
constexpr double wide = 0.3;  // m: obstacles that wide hide all that is behind them

// So many are looked at one by one.
constexpr std::size_t few = 64;

constexpr double rounding = 1e-9;

}  // namespace

/// The line to a subject, and what has been found on it.
struct SimulatedView::SightLine {
    Point to, along;
    double range, inverse;
    std::uint32_t owner;
    bool ofObstacle;
    double clearance = clear;
    bool hidden = false;

    SightLine(const Subject& subject, std::uint32_t its)
        : to(subject.offset),
          range(subject.range),
          inverse(subject.range > 0 ? 1 / subject.range : 0),
          owner(its),
          ofObstacle(subject.kind == SubjectKind::landmark) {
        along = inverse * to;
    }

    bool own(const Obstruction& by) const { return by.owner == owner && by.obstacle == ofObstacle; }

    void passCircle(const Obstruction& by) {
        const double ahead = dot(by.centre, along), aside = std::abs(cross(by.centre, along)) - by.reach;
        if (!(aside < clear) || own(by)) return;
        if (by.obstacle && aside < 0 && (by.wall || 2 * by.reach > wide))
            hidden = hidden || distanceToSegment(by.centre, {}, to) < by.reach;
        if (ahead > 0 && dot(by.centre, by.centre) < range * range) note(aside);
    }

    /// By how far to the right and to the left of the line the piece reaches, where it is nearer than the subject.
    void passPolygon(const Outline& by) {
        const double middle = dot(by.centre, along), across = std::abs(cross(by.centre, along));
        if (middle + by.reach <= 0 || middle - by.reach >= range || across - by.reach >= std::max(clearance, 0.0))
            return;
        if (own(by)) return;
        const Point ahead = by.frame.rotateBack(along);
        const ConvexPiece& piece = *by.piece;
        double least = std::numeric_limits<double>::infinity(), most = -least;
        const auto hold = [&](double lateral) {
            least = std::min(least, lateral);
            most = std::max(most, lateral);
        };
        const auto seen = [&](std::size_t corner) {
            const Point from = piece.corners[corner] - by.frame.origin;
            return Point{dot(ahead, from), cross(ahead, from)};
        };
        Point before = seen(piece.count - 1);
        for (std::size_t i = 0; i < piece.count; ++i) {
            const Point corner = seen(i);
            if (corner.x > 0 && corner.x < range) hold(corner.y);
            for (const double bound : {0.0, range})
                if ((before.x < bound) != (corner.x < bound))
                    hold(before.y + (bound - before.x) / (corner.x - before.x) * (corner.y - before.y));
            before = corner;
        }
        if (!(least <= most)) return;
        hidden = hidden || (by.obstacle && least < 0 && most > 0 && (by.wall || most - least > wide));
        note(std::max(least, -most));
    }

private:
    void note(double aside) { clearance = clearancePast(clearance, aside); }
};

void SimulatedView::add(SubjectKind kind, std::uint32_t index, const Point& place) {
    const Point offset = place - eye_.origin;
    const double range = length(offset);
    const double bearing = direction(eye_.rotateBack(offset));
    if (margin_.holds(range, bearing))
        subjects_.push_back({kind, index, offset, range, bearing, limits_.holds(range, bearing)});
}

void SimulatedView::look(const SensorView& view, const View& limits) {
    subjects_.clear();
    if (halfCosine_ <= -1 || !(limits == limits_)) {  // all round, or not known yet
        limits_ = limits;
        margin_ = limits.margin();
        const bool allRound = margin_.fieldOfView >= 2 * std::numbers::pi;
        const auto [s, c] = allRound ? SineCosine{0, -1} : sineCosine(0.5 * margin_.fieldOfView);
        halfCosine_ = c;
        halfSine_ = s;
    }
    eye_ = Placement(view.poseAt(view.robot, view.measured));
    // What is outside for certain costs little; who stands at the very place is in view.
    const auto outside = [eye = eye_, farthest = margin_.range * margin_.range * (1 + rounding),
                          edge = halfCosine_ * halfCosine_ * (1 - 1e-6),
                          narrow = halfCosine_ > 0.01](const Point& place) {
        const Point offset = place - eye.origin;
        const double squared = dot(offset, offset), ahead = eye.cosine * offset.x + eye.sine * offset.y;
        return squared > farthest || (narrow && squared > 0 && (ahead <= 0 || ahead * ahead < edge * squared));
    };
    const auto find = [&](const PointGrid* grid, std::size_t count, SubjectKind kind, auto placeOf, auto asked) {
        const std::size_t first = subjects_.size();
        const auto tryOne = [&](std::uint32_t i, const Point& place) {
            if (asked(i) && !outside(place)) add(kind, i, place);
        };
        if (count <= few) {
            for (std::uint32_t i = 0; i < count; ++i) tryOne(i, placeOf(i));
            return;
        }
        const auto [least, most] = boxOfSector(eye_, halfCosine_, halfSine_, margin_.range, 0);
        grid->visitBox(least, most, [&](std::span<const PointGrid::Entry> entries) {
            for (const PointGrid::Entry& entry : entries) tryOne(entry.number, entry.point);
        });
        std::sort(subjects_.begin() + static_cast<std::ptrdiff_t>(first), subjects_.end(),
                  [](const Subject& a, const Subject& b) { return a.index < b.index; });
    };
    const std::span<const Landmark> landmarks = view.obstacles.landmarks();
    find(
        &view.obstacles.landmarkGrid(), landmarks.size(), SubjectKind::landmark,
        [&](std::uint32_t i) { return landmarks[i].position; }, [](std::uint32_t) { return true; });
    const std::size_t robots = view.state.robots.size();
    placeBodies(view);
    find(
        map_ != nullptr ? &map_->grid : nullptr, robots, SubjectKind::robot,
        [&](std::uint32_t i) { return places_[i]; }, [&](std::uint32_t i) { return i < robots && i != view.robot; });
}

/// A grid of few is dearer than the few.
void SimulatedView::placeBodies(const SensorView& view) {
    const std::size_t bodies = view.scene.bodyCount();
    map_ = bodies > few ? &view.bodiesAt(view.measured) : nullptr;
    if (map_ != nullptr) {
        places_ = map_->positions;
        return;
    }
    ownPlaces_.clear();
    const auto moment = view.momentOf(view.measured);
    const std::int64_t lag = moment.lag;
    const double earlier = moment.earlier;
    const auto placesBefore = [&](std::int64_t ticks, auto take) {
        if (ticks == 0)
            for (std::size_t body = 0; body < bodies; ++body) take(body, poseOf(view.state, body));
        else
            for (std::size_t body = 0; const Pose& pose : view.past.posesBefore(view.state, ticks)) take(body++, pose);
    };
    placesBefore(lag, [&](std::size_t, const Pose& pose) { ownPlaces_.push_back(position(pose)); });
    if (earlier > 0)
        placesBefore(lag + 1, [&](std::size_t body, const Pose& before) {
            Point& place = ownPlaces_[body];
            place = {place.x + earlier * (before.x - place.x), place.y + earlier * (before.y - place.y)};
        });
    places_ = ownPlaces_;
}

/// Whether it is neither beyond all subjects, nor beside the whole view or behind.
bool SimulatedView::mayHide(const Point& centre, double reach) const {
    const double far = farthest_ + reach;
    if (dot(centre, centre) >= far * far) return false;
    const Point ahead = eye_.rotateBack(centre);
    return halfCosine_ < 0 ||
           std::abs(ahead.y) * halfCosine_ - ahead.x * halfSine_ <= reach + SensedState::clear + rounding;
}

void SimulatedView::addBody(const SensorView& view, std::uint32_t body, const Point& place) {
    const Shape& shape = view.scene.shapeOf(body);
    const Point offset = place - eye_.origin;
    if (body == view.robot || !mayHide(offset, shape.reach)) return;
    const ConvexPiece& first = shape.pieces[0];
    if (shape.pieces.size() == 1 && first.isCircle() && first.centre == Point{}) {
        circles_.push_back({body, false, false, offset, first.radius});
        return;
    }
    Placement frame(view.poseAt(body, view.measured));
    const Placement placed = frame;
    frame.origin = frame.placeBack(eye_.origin);
    for (const ConvexPiece& piece : shape.pieces) {
        const Obstruction obstruction{body, false, false, placed.place(piece.centre) - eye_.origin, piece.reach};
        if (!mayHide(obstruction.centre, obstruction.reach)) continue;
        if (piece.isCircle())
            circles_.push_back(obstruction);
        else
            outlines_.push_back({obstruction, &piece, frame});
    }
}

void SimulatedView::findObstructions(const SensorView& view) {
    circles_.clear();
    outlines_.clear();
    farthest_ = 0;
    for (const Subject& subject : subjects_) farthest_ = std::max(farthest_, subject.range);
    if (subjects_.empty()) return;
    const ObstacleIndex& obstacles = view.obstacles;
    walkObstacles_ = obstacles.pieces().size() > few;
    for (std::uint32_t i = 0; i < obstacles.pieces().size() && !walkObstacles_; ++i) {
        const ConvexPiece& piece = obstacles.pieces()[i];
        const Point centre = piece.centre - eye_.origin;
        if (!mayHide(centre, piece.reach)) continue;
        const Obstruction obstruction{obstacles.obstacleOf(i), true, obstacles.ofWall(i), centre, piece.reach};
        if (piece.isCircle())
            circles_.push_back(obstruction);
        else
            outlines_.push_back({obstruction, &piece, frameOfObstacles()});
    }
    if (map_ == nullptr) {
        for (std::uint32_t body = 0; body < places_.size(); ++body) addBody(view, body, places_[body]);
        return;
    }
    const double pad = view.scene.widestReach() + SensedState::clear;
    const auto [least, most] = boxOfSector(eye_, halfCosine_, halfSine_, farthest_, pad);
    map_->grid.visitBox(least, most, [&](std::span<const PointGrid::Entry> entries) {
        for (const PointGrid::Entry& entry : entries) addBody(view, entry.number, entry.point);
    });
}

Placement SimulatedView::frameOfObstacles() const {
    Placement frame;
    frame.origin = eye_.origin;
    return frame;
}

void SimulatedView::passObstacle(const SensorView& view, std::uint32_t index, SightLine& line) const {
    const ConvexPiece& piece = view.obstacles.pieces()[index];
    const Obstruction obstruction{view.obstacles.obstacleOf(index), true, view.obstacles.ofWall(index),
                                  piece.centre - eye_.origin, piece.reach};
    if (piece.isCircle())
        line.passCircle(obstruction);
    else
        line.passPolygon({obstruction, &piece, frameOfObstacles()});
}

void SimulatedView::alongObstacles(const SensorView& view, SightLine& line) const {
    const ObstacleIndex& obstacles = view.obstacles;
    const double margin = 0.99 * obstacles.margin();
    if (margin <= 1.1 * clear) {
        for (std::uint32_t piece = 0; piece < obstacles.pieces().size(); ++piece) passObstacle(view, piece, line);
        return;
    }
    // All within `clear` of the line are within the index's margin of one of these.
    const int parts = 1 + static_cast<int>(line.range / (2 * std::sqrt(margin * margin - clear * clear)));
    for (int i = 0; i < parts; ++i)
        for (const std::uint32_t piece : obstacles.near(eye_.origin + ((i + 0.5) / parts) * line.to))
            passObstacle(view, piece, line);
}

void SimulatedView::countOthers(std::size_t subject, SensedState& state) const {
    for (std::size_t i = 0; i < subjects_.size(); ++i) {
        const Subject& other = subjects_[i];
        if (i != subject && other.counts) countOther(state, other.range, other.bearing);
    }
}

bool SimulatedView::describe(const SensorView& view, std::size_t index, SensedState& state) const {
    const Subject& subject = subjects_[index];
    const bool landmark = subject.kind == SubjectKind::landmark;
    SightLine line(subject, landmark ? view.obstacles.landmarks()[subject.index].obstacle : subject.index);
    for (const Obstruction& circle : circles_) line.passCircle(circle);
    for (const Outline& outline : outlines_) line.passPolygon(outline);
    if (walkObstacles_) alongObstacles(view, line);
    if (line.hidden) return false;
    state.subject = subject.kind;
    state.range = subject.range;
    state.bearing = subject.bearing;
    findEdges(state, limits_);
    state.clearance = line.clearance;
    countOthers(index, state);
    return true;
}

}  // namespace mrose
