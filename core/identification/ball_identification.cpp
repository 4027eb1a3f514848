#include "identification/ball_identification.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/nearest_point.h"
#include "identification/robust_statistics.h"
#include "io/format.h"
#include "logs/pose_grid.h"

namespace mrose {
namespace {

constexpr std::size_t fewestEvents = 3;
constexpr double ownGravity = 9.81;    // m/s2
constexpr double slowestTouch = 0.15;  // m/s, of approach: slower ones say little
constexpr double largestDoubt = 0.25;  // of a touch: standard errors over its approach

struct EventSample {
    std::vector<double> values, errors;
    void add(double value, double error) {
        values.push_back(value);
        errors.push_back(error);
    }
    BallEstimate mean() const { return meanOfEvents(values, errors, fewestEvents); }
};

/// A surface that a ball has touched.
struct TouchedSurface {
    bool robot = false;
    Point velocity;               ///< m/s, of the surface
    std::optional<Point> normal;  ///< away from it; nullopt: not known
};

class BallSamples {
public:
    BallSamples(const Log& log, const BallIdentificationOptions& options) : log_(log), options_(options) {}

    void add(const Trajectory& trajectory) {
        const BallAnalysis track = analyseBallTrack(trajectory.ball);
        found.noise += track.noise * static_cast<double>(trajectory.ball.size());
        found.positions += trajectory.ball.size();
        found.moved += track.moved;
        found.misfits += track.misfits;
        found.kicks += trajectory.kicks.size();
        ++found.tracks;
        for (const BallRoll& roll : track.rolls) {
            rolling_.add(roll.deceleration, roll.error);
            speeds_ += roll.speed;
        }
        for (const BallSlide& slide : track.slides) addSlide(slide, track.events[slide.event], trajectory);
        for (const BallEvent& event : track.events)
            if (!event.rested) addTouch(event);
    }

    BallIdentification finish() {
        found.noise /= static_cast<double>(std::max<std::size_t>(found.positions, 1));
        found.rollingDeceleration = rolling_.mean();
        if (!rolling_.values.empty()) found.rollingSpeed = speeds_ / static_cast<double>(rolling_.values.size());
        found.slidingFriction = sliding_.mean();
        found.kept = kept_.mean();
        found.untilRolling = times_.mean();
        found.wallRestitution = walls_.mean();
        found.robotRestitution = robots_.mean();
        found.inertia = found.kept;
        if (found.kept.identified) {
            found.inertia.value = 1 / found.kept.value - 1;
            const double slope = 1 / (found.kept.value * found.kept.value);
            found.inertia.error = slope * found.kept.error;
            found.inertia.spread = slope * found.kept.spread;
        } else if (found.kicks == 0) {
            for (BallEstimate* of : {&found.kept, &found.untilRolling, &found.inertia})
                of->reason = "the log has no kicks: only of a kicked ball is it known that it did not roll before";
        }
        return std::move(found);
    }

    BallIdentification found;

private:
    bool kicked(const BallEvent& event, const Trajectory& trajectory) const {
        return std::ranges::any_of(trajectory.kicks, [&](const StampedKick& kick) {
            const double since = toSeconds(event.time - kick.time);
            return since >= 0 && since <= options_.longestDelay;
        });
    }

    void addSlide(const BallSlide& slide, const BallEvent& event, const Trajectory& trajectory) {
        sliding_.add(slide.deceleration / ownGravity, slide.decelerationError / ownGravity);
        if (!event.rested || !kicked(event, trajectory)) return;
        kept_.add(slide.kept, slide.keptError);
        const double speed = length(event.after);
        times_.add(slide.duration / speed, slide.durationError / speed);
    }

    void addTouch(const BallEvent& event) {
        ++found.touches;
        std::optional<TouchedSurface> surface = robotAt(event);
        if (!surface) surface = obstacleAt(event.place);
        if (!surface) return void(++found.unexplained);
        const Point in = event.before - surface->velocity, out = event.after - surface->velocity;
        const Point normal = surface->normal.value_or((1 / distance(in, out)) * (out - in));
        if (!surface->normal && std::abs(wrapAngle(direction(out) - direction(-1 * in))) > options_.headOn)
            return void(++found.oblique);
        const double approach = -dot(in, normal), parting = dot(out, normal);
        if (approach < slowestTouch) return;
        const double ratio = parting / approach;
        const double error = length(Point{event.afterError, ratio * event.beforeError}) / approach;
        if (error > largestDoubt) return;
        (surface->robot ? robots_ : walls_).add(ratio, error);
    }

    /// Of the nearest robot, where one is near enough.
    std::optional<TouchedSurface> robotAt(const BallEvent& event) const {
        std::optional<TouchedSurface> nearest;
        double least = options_.robotReach;
        for (const RobotLog& robot : log_.robots)
            for (const Trajectory& trajectory : robot.trajectories) {
                if (trajectory.poses.empty() || !truthIsKnown(trajectory.poses, event.time)) continue;
                const Pose pose = truthAt(trajectory.poses, event.time);
                const Point lever = event.place - position(pose);
                if (length(lever) >= least) continue;
                least = length(lever);
                const Velocity v = velocityAt(trajectory.poses, event.time).value_or(Velocity{});
                nearest =
                    TouchedSurface{true, v.v * towards(pose.heading) + v.w * Point{-lever.y, lever.x}, std::nullopt};
            }
        return nearest;
    }

    std::optional<TouchedSurface> obstacleAt(const Point& place) const {
        if (options_.obstacles.empty()) return TouchedSurface{};
        std::optional<TouchedSurface> nearest;
        double least = options_.obstacleReach;
        for (const ConvexPiece& piece : options_.obstacles) {
            const NearestPoint at = nearestPoint(piece, place);
            if (at.distance >= least) continue;
            least = at.distance;
            nearest = TouchedSurface{false, {}, at.away};
        }
        return nearest;
    }

    const Log& log_;
    const BallIdentificationOptions& options_;
    EventSample rolling_, sliding_, kept_, times_, walls_, robots_;
    double speeds_ = 0;
};

}  // namespace

BallEstimate meanOfEvents(std::span<const double> values, std::span<const double> errors, std::size_t fewest) {
    BallEstimate estimate;
    std::vector<double> finite;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (std::isfinite(values[i]) && std::isfinite(errors[i]) && errors[i] > 0) finite.push_back(values[i]);
    const double middle = medianOf(finite), wide = robustSpread(finite, middle);
    std::vector<std::pair<double, double>> kept;  // with their variances
    for (std::size_t i = 0; i < values.size(); ++i)
        if (std::isfinite(values[i]) && std::isfinite(errors[i]) && errors[i] > 0 &&
            std::abs(values[i] - middle) <= 5 * std::max(wide, errors[i]))
            kept.emplace_back(values[i], errors[i] * errors[i]);
    estimate.events = kept.size();
    if (kept.size() < fewest) {
        estimate.reason = "only " + counted(kept.size(), "event") + "; it needs " + std::to_string(fewest);
        return estimate;
    }
    const auto weighted = [&](double between) {
        double sum = 0, weights = 0;
        for (const auto& [value, variance] : kept) {
            sum += value / (variance + between);
            weights += 1 / (variance + between);
        }
        return std::pair{sum / weights, weights};
    };
    const auto [fixedMean, fixedWeights] = weighted(0);
    double chiSquare = 0, squares = 0;
    for (const auto& [value, variance] : kept) {
        chiSquare += (value - fixedMean) * (value - fixedMean) / variance;
        squares += 1 / (variance * variance);
    }
    const double freedom = static_cast<double>(kept.size()) - 1;
    const double scale = fixedWeights - squares / fixedWeights;
    const double between = scale > 0 ? std::max(0.0, (chiSquare - freedom) / scale) : 0;
    const auto [mean, weights] = weighted(between);
    estimate.identified = true;
    estimate.value = mean;
    estimate.error = 1 / std::sqrt(weights);
    estimate.spread = std::sqrt(between);
    return estimate;
}

Expected<BallIdentification> identifyBall(const Log& log, const BallIdentificationOptions& options) {
    BallSamples samples(log, options);
    std::size_t positions = 0;
    for (const RobotLog& robot : log.robots)
        for (const Trajectory& trajectory : robot.trajectories) {
            positions += trajectory.ball.size();
            if (!trajectory.ball.empty()) samples.add(trajectory);
        }
    if (positions == 0) return fail(log.source, "holds no ball (columns ball_x and ball_y)");
    BallIdentification found = samples.finish();
    found.obstacles = !options.obstacles.empty();
    found.synthetic = log.synthetic;
    if (found.moved == 0)
        return fail(log.source, "holds " + std::to_string(positions) +
                                    " positions of a ball, but no stretch in which it moves for long enough");
    return found;
}

}  // namespace mrose
