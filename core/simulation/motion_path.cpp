#include "simulation/motion_path.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/elementary.h"
#include "geometry/point.h"

namespace mrose {
namespace {

/// Two numbers that are computed with at once, each as by itself.
typedef double TwoDoubles __attribute__((vector_size(2 * sizeof(double))));

TwoDoubles both(double first, double second) { return TwoDoubles{first, second}; }
/// A vector turned by a quarter, counter-clockwise.
TwoDoubles quarterTurned(const TwoDoubles& p) { return both(-1, 1) * __builtin_shufflevector(p, p, 1, 0); }

/// A twist whose x and y are computed at once.
struct PairedTwist {
    TwoDoubles way;
    double rotation;

    PairedTwist(const TwoDoubles& way, double rotation) : way(way), rotation(rotation) {}
    PairedTwist(const Twist& t) : way(both(t.x, t.y)), rotation(t.rotation) {}
    operator Twist() const { return {way[0], way[1], rotation}; }
};
PairedTwist operator*(double factor, const PairedTwist& t) { return {factor * t.way, factor * t.rotation}; }
PairedTwist operator+(const PairedTwist& a, const PairedTwist& b) { return {a.way + b.way, a.rotation + b.rotation}; }

/// What exponential and right Jacobian of SE(2) at a rotation r are made of, by one sine and cosine.
struct ArcTerms {
    double along, across;  ///< sin(r)/r, (1 - cos(r))/r
    double lag, bend;      ///< (r - sin(r))/r2, (1 - cos(r))/r2

    explicit ArcTerms(double r) {
        const double u = r * r;
        if (u < 0.25) {  // what a robot turns in a period: the series to rounding, without cancellation
            const TwoDoubles sums = series(u);
            bend = sums[0];
            along = 1 - u * sums[1];
            lag = r * sums[1];
        } else {
            const auto [s, c] = sineCosine(r / 2);
            const double whole = 2 * s * c;
            along = whole / r;
            lag = (r - whole) / u;
            bend = 2 * s * s / u;
        }
        across = bend * r;
    }

    /// (1 - cos(r))/r2 and (r - sin(r))/r3: 1/n! - u/(n+2)! + u2/(n+4)! ... for n = 2 and 3, by Horner's rule; u at
    /// most 1/4, where what is left out is below rounding.
    static TwoDoubles series(double u) {
        constexpr int terms = 7;
        static constexpr std::array<std::array<double, 2>, terms> coefficients = [] {
            std::array<std::array<double, 2>, terms> list{{{1.0 / 2, 1.0 / 6}}};
            for (int i = 1; i < terms; ++i)
                for (int n = 2; n <= 3; ++n) list[i][n - 2] = -list[i - 1][n - 2] / ((n + 2 * i - 1) * (n + 2 * i));
            return list;
        }();
        const auto term = [](int i) { return both(coefficients[i][0], coefficients[i][1]); };
        TwoDoubles sum = term(terms - 1);
        for (int i = terms - 1; i-- > 0;) sum = sum * u + term(i);
        return sum;
    }

    TwoDoubles displacement(const TwoDoubles& way) const { return along * way + across * quarterTurned(way); }
    Twist logarithm(const Pose& pose) const {
        const double squared = along * along + across * across;
        return {(along * pose.x + across * pose.y) / squared, (along * pose.y - across * pose.x) / squared,
                pose.heading};
    }
};

/// The right Jacobian of SE(2) at p (Sola, Deray, Atchuthan 2018, eq. 163): body velocity = J p'.
struct RightJacobian {
    double along, across;
    TwoDoubles fromRotation;

    RightJacobian(const PairedTwist& p, const ArcTerms& terms)
        : along(terms.along),
          across(terms.across),
          fromRotation(terms.lag * p.way + terms.bend * quarterTurned(p.way)) {}

    PairedTwist apply(const PairedTwist& rate) const {
        return {along * rate.way - across * quarterTurned(rate.way) + fromRotation * rate.rotation, rate.rotation};
    }
    Twist solve(const Twist& velocity) const {
        const double x = velocity.x - fromRotation[0] * velocity.rotation;
        const double y = velocity.y - fromRotation[1] * velocity.rotation;
        const double squared = along * along + across * across;
        return {(along * x - across * y) / squared, (along * y + across * x) / squared, velocity.rotation};
    }
};

struct LogPoint {
    PairedTwist value, rate;  ///< p(s), p'(s)
};

/// Hermite's cubic from 0 to the logarithm.
LogPoint logAt(const MotionSegment& segment, double s) {
    const PairedTwist m0 = segment.startRate, m1 = segment.endRate, whole = segment.logarithm;
    const PairedTwist b = 3 * whole + -2 * m0 + -1 * m1;
    const PairedTwist c = m0 + m1 + -2 * whole;
    return {s * (m0 + s * (b + s * c)), m0 + s * (2 * b + 3 * s * c)};
}

void beginAt(MotionSegment& segment, const Pose& pose) {
    segment.start = pose;
    segment.direction = towards(pose.heading);
}

}  // namespace

MotionSegment beginSegment(const Pose& pose, const Twist& velocity_B, const MotionStep& predicted, std::int64_t tick,
                           double period) {
    MotionSegment segment;
    segment.startTick = tick;
    beginAt(segment, pose);
    segment.increment = predicted.increment;
    const ArcTerms terms(predicted.increment.heading);
    segment.logarithm = terms.logarithm(predicted.increment);
    segment.startRate = {period * velocity_B.x, 0, period * velocity_B.rotation};
    segment.endRate = RightJacobian(segment.logarithm, terms)
                          .solve({period * predicted.velocity.v, 0, period * predicted.velocity.w});
    segment.endVelocity = predicted.velocity;
    return segment;
}

MotionSegment restAt(const Pose& pose, std::int64_t tick) {
    MotionSegment segment;
    segment.startTick = tick;
    beginAt(segment, pose);
    return segment;
}

PathPoint fromStart(const MotionSegment& segment, double share, double period) {
    if (share >= 1) return {segment.increment, {segment.endVelocity.v, 0, segment.endVelocity.w}};
    const LogPoint p = logAt(segment, share);
    const ArcTerms terms(p.value.rotation);
    const TwoDoubles moved = terms.displacement(p.value.way);
    return {{moved[0], moved[1], p.value.rotation}, (1 / period) * RightJacobian(p.value, terms).apply(p.rate)};
}

PathPoint at(const MotionSegment& segment, double share, double period) {
    PathPoint point = fromStart(segment, share, period);
    const Pose& start = segment.start;
    const auto [c, s] = segment.direction;
    const Pose& moved = point.pose;
    point.pose = {start.x + c * moved.x - s * moved.y, start.y + s * moved.x + c * moved.y,
                  start.heading + moved.heading};
    return point;
}

Recovery recover(const PathPoint& now, const PathPoint& onWay, const PathPoint& next, double duration, double traction,
                 double turnLever) {
    // How much faster it is than its way, in the body's frame, which turns little within a tick.
    Point slip{now.velocity_B.x - onWay.velocity_B.x, now.velocity_B.y - onWay.velocity_B.y};
    double turn = now.velocity_B.rotation - onWay.velocity_B.rotation;
    const double speed = length(slip), lost = traction * duration;
    slip = speed > lost ? (1 - lost / speed) * slip : Point{};
    turn = std::copysign(std::max(0.0, std::abs(turn) - lost * turnLever), turn);
    Recovery result{next, !(slip == Point{}) || turn != 0};
    const Pose way = relative(onWay.pose, next.pose);
    result.point.pose =
        now.pose * Pose{way.x + slip.x * duration, way.y + slip.y * duration, way.heading + turn * duration};
    result.point.velocity_B.x += slip.x;
    result.point.velocity_B.y += slip.y;
    result.point.velocity_B.rotation += turn;
    return result;
}

void moveTo(MotionSegment& segment, double share, const Pose& pose) {
    const Pose onWay = fromStart(segment, share, 1).pose;
    const double heading = pose.heading - onWay.heading;
    const auto [s, c] = sineCosine(heading);
    segment.start = {pose.x - (c * onWay.x - s * onWay.y), pose.y - (s * onWay.x + c * onWay.y), heading};
    segment.direction = {c, s};
}

}  // namespace mrose
