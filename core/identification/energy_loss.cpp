#include "identification/energy_loss.h"

#include <array>
#include <cassert>
#include <cmath>

#include "geometry/elementary.h"
#include "geometry/point.h"
#include "learning/sample_scores.h"

namespace mrose {
namespace {

/// Poses after 0, 1, ... periods.
void compose(std::span<const Pose> increments, std::span<Pose> poses) {
    poses[0] = {};
    for (std::size_t k = 0; k < increments.size(); ++k) {
        const SineCosine turned = sineCosine(poses[k].heading);
        const Pose& d = increments[k];
        poses[k + 1] = {poses[k].x + turned.cosine * d.x - turned.sine * d.y,
                        poses[k].y + turned.sine * d.x + turned.cosine * d.y, poses[k].heading + d.heading};
    }
}

Point seenFrom(const Pose& frame, const Pose& pose) {
    const SineCosine turned = sineCosine(frame.heading);
    const double x = pose.x - frame.x, y = pose.y - frame.y;
    return {turned.cosine * x + turned.sine * y, turned.cosine * y - turned.sine * x};
}

/// Takes derivatives by poses back to the increments between them. `byPoses[k]`: by the pose after increment k, in the
/// frame of `frame`, from which on the increments lead.
void takeBack(std::span<const Pose> increments, std::span<const Pose> poses, const Pose& frame,
              std::span<const Pose> byPoses, std::span<Pose> gradient) {
    double byX = 0, byY = 0, byHeading = 0;
    for (std::size_t k = increments.size(); k-- > 0;) {
        byX += byPoses[k].x;
        byY += byPoses[k].y;
        byHeading += byPoses[k].heading;
        const SineCosine turned = sineCosine(poses[k].heading - frame.heading);
        gradient[k].x += turned.cosine * byX + turned.sine * byY;
        gradient[k].y += turned.cosine * byY - turned.sine * byX;
        gradient[k].heading += byHeading;
        // The heading at the period's start turned this increment: it is part of what earlier rotations did.
        const Pose& d = increments[k];
        byHeading += byX * (-turned.sine * d.x - turned.cosine * d.y) + byY * (turned.cosine * d.x - turned.sine * d.y);
    }
}

}  // namespace

double EnergyLoss::operator()(std::span<const Pose> samples, std::size_t count, std::span<const Pose> mean,
                              std::span<const Pose> truth, std::span<Pose> gradient) const {
    const std::size_t length = truth.size();
    assert(samples.size() == count * length && !instants.empty() && instants.back() <= length);
    assert(weights.size() == instants.size());
    const bool differentiates = !gradient.empty();
    assert(mean.size() == length);
    std::vector<Pose> poses(count * (length + 1)), real(length + 1), expected(length + 1);
    compose(truth, real);
    compose(mean, expected);
    for (std::size_t s = 0; s < count; ++s)
        compose(samples.subspan(s * length, length), std::span(poses).subspan(s * (length + 1), length + 1));
    const auto pose = [&](std::size_t s, std::size_t k) -> const Pose& { return poses[s * (length + 1) + k]; };
    std::vector<Pose> byPoses(differentiates ? count * length : 0), bySegment(differentiates ? length : 0);
    std::vector<Point> places(count), byPlaces(differentiates ? count : 0);
    std::vector<double> values(count), byValues(differentiates ? count : 0);
    double loss = 0;
    for (std::size_t i = 0; i < instants.size(); ++i) {
        const std::size_t k = instants[i];
        const Weights& weight = weights[i];
        const double axisScores = axisWeight * weight.place;
        for (std::size_t s = 0; s < count; ++s) places[s] = {pose(s, k).x, pose(s, k).y};
        const auto by = [&](std::size_t s) -> Pose& { return byPoses[s * length + k - 1]; };
        byPlaces.assign(byPlaces.size(), {});
        loss += weight.place * energyScore(places, {real[k].x, real[k].y}, weight.place, byPlaces, antithetic);
        for (std::size_t s = 0; s < byPlaces.size(); ++s) by(s) = {byPlaces[s].x, byPlaces[s].y, 0};
        for (std::size_t s = 0; s < count; ++s) values[s] = pose(s, k).heading;
        byValues.assign(byValues.size(), 0);
        loss += weight.heading * rankedScore(values, real[k].heading, weight.heading, byValues, antithetic);
        for (std::size_t s = 0; s < byValues.size(); ++s) by(s).heading = byValues[s];
        const Point along = towards(expected[k].heading);
        for (const Point& axis : {along, Point{-along.y, along.x}}) {
            for (std::size_t s = 0; s < count; ++s) values[s] = dot(axis, places[s]);
            byValues.assign(byValues.size(), 0);
            loss += axisScores * rankedScore(values, dot(axis, position(real[k])), axisScores, byValues, antithetic);
            for (std::size_t s = 0; s < byValues.size(); ++s) {
                by(s).x += byValues[s] * axis.x;
                by(s).y += byValues[s] * axis.y;
            }
        }
    }
    for (std::size_t s = 0; differentiates && s < count; ++s)
        takeBack(samples.subspan(s * length, length), std::span(poses).subspan(s * (length + 1), length), {},
                 std::span(byPoses).subspan(s * length, length), gradient.subspan(s * length, length));
    for (std::size_t i = 0; i + 1 < instants.size(); ++i) {
        const std::size_t begin = instants[i], end = instants[i + 1];
        for (std::size_t s = 0; s < count; ++s) places[s] = seenFrom(pose(s, begin), pose(s, end));
        byPlaces.assign(byPlaces.size(), {});
        loss += weights[i].move *
                energyScore(places, seenFrom(real[begin], real[end]), weights[i].move, byPlaces, antithetic);
        for (std::size_t s = 0; differentiates && s < count; ++s) {
            const std::span segment = std::span(bySegment).first(end - begin);
            segment.back() = {byPlaces[s].x, byPlaces[s].y, 0};
            takeBack(samples.subspan(s * length + begin, end - begin),
                     std::span(poses).subspan(s * (length + 1) + begin, end - begin), pose(s, begin), segment,
                     gradient.subspan(s * length + begin, end - begin));
            segment.back() = {};
        }
    }
    return loss;
}

EnergyLoss EnergyLoss::over(std::size_t length) {
    EnergyLoss loss;
    for (const double share : {0.1, 0.2, 0.5, 1.0}) {
        const auto instant = static_cast<std::size_t>(std::lround(share * static_cast<double>(length)));
        if (instant > (loss.instants.empty() ? 0 : loss.instants.back())) loss.instants.push_back(instant);
    }
    loss.weights.resize(loss.instants.size());
    return loss;
}

}  // namespace mrose
