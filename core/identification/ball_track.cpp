#include "identification/ball_track.h"

#include <algorithm>
#include <cmath>

#include "identification/path_fit.h"
#include "identification/robust_statistics.h"

namespace mrose {
namespace {

constexpr std::size_t fewestBallPositions = 20;
constexpr Nanoseconds longestBallPause = 100'000'000;
constexpr double leastNoise = 1e-4;      // m
constexpr double stillSpeed = 0.06;      // m/s, with 4 standard errors beside it
constexpr double bendWindow = 0.08;      // s, to either side of a bend ...
constexpr std::size_t windowPoints = 5;  // ... and at least so many positions
constexpr double sharpBend = 0.45;       // m/s: more than friction does within a window
constexpr double slightBend = 0.12;      // m/s, where a stretch does not fit otherwise
constexpr double modelError = 0.004;     // m: what free motion may differ from its fit, beside the noise
constexpr double slideWindow = 1.2, endWindow = 0.25, rollPiece = 1.0, shortestPiece = 0.4;  // s

using Points = std::span<const TrackedPoint>;

/// Velocity of a straight line through some points.
Point slopeOf(Points points) {
    double mean = 0, spread = 0;
    for (const TrackedPoint& p : points) mean += p.time / static_cast<double>(points.size());
    Point slope;
    for (const TrackedPoint& p : points) {
        slope = slope + (p.time - mean) * p.place;
        spread += (p.time - mean) * (p.time - mean);
    }
    return spread > 0 ? (1 / spread) * slope : Point{};
}

double squaresAbout(Points points) {
    const auto fit = fitEvenPath(points, 0);
    if (!fit) return 0;
    const double freedom = std::max(1.0, 2 * static_cast<double>(points.size()) - 6);
    return fit->residual * fit->residual * freedom;
}

/// A pause-free part of a track.
class TrackPart {
public:
    TrackPart(std::vector<TrackedPoint> points, Nanoseconds origin, double noise, BallAnalysis& found)
        : points_(std::move(points)), origin_(origin), noise_(noise), found_(found) {
        const double step = (points_.back().time - points_.front().time) / static_cast<double>(points_.size() - 1);
        width_ = std::max(windowPoints, static_cast<std::size_t>(std::ceil(bendWindow / step)));
        const auto n = static_cast<double>(width_);
        slopeError_ = noise_ / (step * std::sqrt(n * (n * n - 1) / 12));
        limit_ = stillSpeed + 4 * slopeError_;
    }

    void analyse() {
        if (points_.size() < fewestBallPositions) return;
        std::vector<std::size_t> cuts{0};
        for (const std::size_t bend : bendsWithin(0, points_.size(), sharpBend + 5 * slopeError_)) cuts.push_back(bend);
        cuts.push_back(points_.size());
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) addStretches(cuts[i], cuts[i + 1], 3);
        for (std::size_t i = 0; i < stretches_.size(); ++i) {
            if (stretches_[i].moving()) describe(stretches_[i]);
            if (i > 0) addEvent(stretches_[i - 1], stretches_[i]);
        }
    }

private:
    /// Positions between two bends: `first` up to but without `end`; it moves from there to `moves`.
    struct Stretch {
        std::size_t first = 0, end = 0, movesFrom = 0, moves = 0;
        bool misfit = false;
        std::optional<PathFit> start = {}, last = {};  ///< of its beginning and of its end
        bool moving() const { return moves > movesFrom; }
    };

    Points part(std::size_t first, std::size_t end) const { return Points(points_).subspan(first, end - first); }
    double timeOf(std::size_t i) const { return points_[i].time; }

    /// Positions before which a bend of more than `least` lies, ascending: the first positions behind it.
    std::vector<std::size_t> bendsWithin(std::size_t first, std::size_t end, double least) const {
        std::vector<std::size_t> bends;
        if (end - first < 2 * width_) return bends;
        std::vector<double> change(end - first);
        for (std::size_t i = first + width_; i + width_ <= end; ++i)
            change[i - first] = length(slopeOf(part(i, i + width_)) - slopeOf(part(i - width_, i)));
        for (;;) {
            const auto most = std::ranges::max_element(change);
            if (*most <= least) break;
            const std::size_t at = first + static_cast<std::size_t>(most - change.begin());
            bends.push_back(sharpened(at, first, end));
            const std::size_t from = at - first < width_ ? 0 : at - first - width_;
            const std::size_t to = std::min(change.size(), at - first + width_);
            std::fill(change.begin() + static_cast<std::ptrdiff_t>(from),
                      change.begin() + static_cast<std::ptrdiff_t>(to), 0.0);
        }
        std::ranges::sort(bends);
        bends.erase(std::unique(bends.begin(), bends.end()), bends.end());
        return bends;
    }

    /// Where to cut so that both sides are smoothest: of the same positions, wherever that is.
    std::size_t sharpened(std::size_t at, std::size_t first, std::size_t end) const {
        const std::size_t from = at - std::min(at - first, 2 * width_), to = std::min(end, at + 2 * width_);
        std::size_t best = at;
        double least = INFINITY;
        for (std::size_t i = std::max(from + 4, at - std::min(at, width_)); i + 4 <= to && i <= at + width_; ++i) {
            const double squares = squaresAbout(part(from, i)) + squaresAbout(part(i, to));
            if (squares < least) best = i, least = squares;
        }
        return best;
    }

    /// The stretch, cut again where it does not fit.
    void addStretches(std::size_t first, std::size_t end, int depth) {
        Stretch stretch{first, end};
        trim(stretch);
        if (stretch.moving() && stretch.moves - stretch.movesFrom >= 8 && !fits(stretch)) {
            const auto bends = depth > 0 ? bendsWithin(stretch.movesFrom, stretch.moves, slightBend + 5 * slopeError_)
                                         : std::vector<std::size_t>{};
            if (!bends.empty() && bends.front() > first && bends.front() < end) {
                addStretches(first, bends.front(), depth - 1);
                addStretches(bends.front(), end, depth - 1);
                return;
            }
            stretch.misfit = true;
            ++found_.misfits;
        }
        stretches_.push_back(stretch);
    }

    bool moves(std::size_t i, std::size_t first, std::size_t end) const {
        const std::size_t half = std::min(width_, end - first) / 2;
        const std::size_t from = i < first + half ? first : i - half;
        const std::size_t to = std::min(end, from + 2 * half + 1);
        return to - from >= 3 && length(slopeOf(part(from, to))) > limit_;
    }

    /// Without rest at either end.
    void trim(Stretch& stretch) const {
        stretch.movesFrom = stretch.first;
        while (stretch.movesFrom < stretch.end && !moves(stretch.movesFrom, stretch.first, stretch.end))
            ++stretch.movesFrom;
        stretch.moves = stretch.movesFrom;
        while (stretch.moves < stretch.end && moves(stretch.moves, stretch.first, stretch.end)) ++stretch.moves;
        if (stretch.moves < stretch.end) stretch.moves -= std::min(stretch.moves - stretch.movesFrom, width_ / 2);
        if (stretch.moves - stretch.movesFrom < 4) stretch.moves = stretch.movesFrom;
    }

    bool fits(const Stretch& stretch) const {
        const auto points = part(stretch.movesFrom, stretch.moves);
        auto fit = fitChangingPath(points, noise_);
        if (!fit) fit = fitEvenPath(points, noise_);
        const double seconds = points.back().time - points.front().time;
        return fit && fit->residual < 2 * noise_ + modelError * std::max(1.0, seconds * seconds);
    }

    std::size_t within(std::size_t first, std::size_t end, double seconds) const {
        std::size_t i = first;
        while (i < end && timeOf(i) <= timeOf(first) + seconds) ++i;
        return i;
    }

    void describe(Stretch& stretch) {
        found_.moved += timeOf(stretch.moves - 1) - timeOf(stretch.movesFrom);
        if (stretch.misfit) return;
        const std::size_t early = within(stretch.movesFrom, stretch.moves, slideWindow);
        stretch.start = fitChangingPath(part(stretch.movesFrom, early), noise_);
        if (!stretch.start)
            stretch.start = fitEvenPath(part(stretch.movesFrom, within(stretch.movesFrom, stretch.moves, 0.3)), noise_);
        std::size_t late = stretch.moves - 1;
        while (late > stretch.movesFrom && timeOf(late - 1) >= timeOf(stretch.moves - 1) - endWindow) --late;
        stretch.last = fitEvenPath(part(late, stretch.moves), noise_);
        if (stretch.start && slides(*stretch.start))
            addRolls(stretch, stretch.start->begin + stretch.start->parameters[PathFit::change] + 0.03);
        else
            addRolls(stretch, timeOf(stretch.movesFrom));
    }

    /// Whether a change is the end of sliding: less deceleration after it than before.
    static bool slides(const PathFit& fit) {
        if (!fit.changes) return false;
        const PathFit::Parameters& p = fit.parameters;
        return length(Point{p[PathFit::first], p[PathFit::first + 1]}) >
               1.5 * length(Point{p[PathFit::second], p[PathFit::second + 1]});
    }

    void addRolls(const Stretch& stretch, double from) {
        std::size_t i = stretch.movesFrom;
        while (i < stretch.moves && timeOf(i) < from) ++i;
        double weights = 0;
        BallRoll roll;
        while (i < stretch.moves) {
            const std::size_t end = within(i, stretch.moves, rollPiece);
            const auto points = part(i, end);
            i = end;
            if (points.back().time - points.front().time < shortestPiece) continue;
            const auto fit = fitEvenPath(points, noise_);
            if (!fit || fit->residual > 2 * noise_ + modelError) continue;
            const double middle = (points.front().time + points.back().time) / 2;
            const auto along = [&](const PathFit::Parameters& p) {
                const Point v = fit->velocityAt(p, middle);
                return -(p[PathFit::first] * v.x + p[PathFit::first + 1] * v.y) / length(v);
            };
            const double error = fit->errorOf(along), weight = 1 / (error * error);
            roll.deceleration += weight * along(fit->parameters);
            roll.speed += weight * length(fit->velocityAt(middle));
            weights += weight;
        }
        if (weights == 0) return;
        roll.deceleration /= weights;
        roll.speed /= weights;
        roll.error = 1 / std::sqrt(weights);
        found_.rolls.push_back(roll);
    }

    static double velocityError(const PathFit& fit, double time) {
        const double x = fit.errorOf([&](const auto& p) { return fit.velocityAt(p, time).x; });
        const double y = fit.errorOf([&](const auto& p) { return fit.velocityAt(p, time).y; });
        return std::sqrt((x * x + y * y) / 2);
    }

    void addEvent(const Stretch& before, const Stretch& after) {
        if (!after.start || after.movesFrom > after.first + 2) return;
        const bool rested = !before.moving();
        if (!rested && (!before.last || before.moves + 2 < before.end)) return;
        const PathFit& path = *after.start;
        const double bend = (timeOf(before.end - 1) + timeOf(after.first)) / 2;
        const Point rest = meanOf(before);
        const auto placeBefore = [&](double t) { return rested ? rest : before.last->placeAt(t); };
        const auto velocityBefore = [&](double t) { return rested ? Point{} : before.last->velocityAt(t); };
        const Point apart = path.placeAt(bend) - placeBefore(bend);
        const Point change = path.velocityAt(bend) - velocityBefore(bend);
        if (!(length(change) > 0)) return;
        const double step = timeOf(after.first) - timeOf(before.end - 1);
        const double shift = std::clamp(-dot(apart, change) / dot(change, change), -1.5 * step, 1.5 * step);
        const double time = bend + shift;
        BallEvent event{
            origin_ + fromSeconds(time), path.placeAt(time),    rested,
            velocityBefore(time),        path.velocityAt(time), rested ? 0 : velocityError(*before.last, time),
            velocityError(path, time)};
        if (slides(path)) addSlide(path, time);
        found_.events.push_back(event);
    }

    void addSlide(const PathFit& path, double time) {
        BallSlide slide{.event = found_.events.size()};
        const auto deceleration = [](const auto& p) { return length(Point{p[PathFit::first], p[PathFit::first + 1]}); };
        const auto duration = [&](const auto& p) { return p[PathFit::change] - (time - path.begin); };
        const auto kept = [&](const auto& p) {
            return length(path.velocityAt(p, path.begin + p[PathFit::change])) / length(path.velocityAt(p, time));
        };
        slide.deceleration = deceleration(path.parameters);
        slide.decelerationError = path.errorOf(deceleration);
        slide.kept = kept(path.parameters);
        slide.keptError = path.errorOf(kept);
        slide.duration = duration(path.parameters);
        slide.durationError = path.errorOf(duration);
        found_.slides.push_back(slide);
    }

    /// Of the last second of a rest.
    Point meanOf(const Stretch& stretch) const {
        Point sum;
        double count = 0;
        for (std::size_t i = stretch.first; i < stretch.end; ++i)
            if (timeOf(i) >= timeOf(stretch.end - 1) - 1) sum = sum + points_[i].place, ++count;
        return (1 / count) * sum;
    }

    std::vector<TrackedPoint> points_;
    Nanoseconds origin_;
    double noise_;
    BallAnalysis& found_;
    std::size_t width_ = windowPoints;
    double slopeError_ = 0, limit_ = 0;
    std::vector<Stretch> stretches_;
};

}  // namespace

double trackerNoise(std::span<const StampedBall> ball) {
    std::vector<double> differences;
    for (std::size_t i = 3; i < ball.size(); ++i) {
        const double step = toSeconds(ball[i].time - ball[i - 1].time);
        bool even = true;
        for (std::size_t k = 1; k < 3; ++k)
            even = even && std::abs(toSeconds(ball[i - k].time - ball[i - k - 1].time) - step) < 0.1 * step;
        if (!even || step > toSeconds(longestBallPause)) continue;
        const Point third = ball[i].place - 3 * ball[i - 1].place + 3 * ball[i - 2].place - ball[i - 3].place;
        differences.push_back(third.x);
        differences.push_back(third.y);
    }
    if (differences.empty()) return 0;
    return robustSpread(std::move(differences), 0) / std::sqrt(20.0);
}

BallAnalysis analyseBallTrack(std::span<const StampedBall> ball, double noise) {
    BallAnalysis found;
    found.noise = std::max(noise > 0 ? noise : trackerNoise(ball), leastNoise);
    for (std::size_t begin = 0; begin < ball.size();) {
        std::size_t end = begin + 1;
        while (end < ball.size() && ball[end].time - ball[end - 1].time <= longestBallPause) ++end;
        std::vector<TrackedPoint> points;
        for (std::size_t i = begin; i < end; ++i)
            points.push_back({toSeconds(ball[i].time - ball[begin].time), ball[i].place});
        if (points.size() >= fewestBallPositions)
            TrackPart(std::move(points), ball[begin].time, found.noise, found).analyse();
        begin = end;
    }
    return found;
}

}  // namespace mrose
