#include "synthetic/drive_patterns.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <numbers>

#include "geometry/elementary.h"
#include "geometry/point.h"
#include "synthetic/reference_robot.h"
#include "world/noise.h"

namespace mrose {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double fullSpeed = ReferenceRobotParameters{}.largestSpeed;
constexpr double fullTurn = ReferenceRobotParameters{}.largestTurn;
constexpr double commandPeriod = 0.1, standingAtEnd = 2;

/// The draws of one trajectory, one after the other.
class Draws {
public:
    Draws(std::uint64_t seed, std::uint32_t index, DrivePattern pattern)
        : seed_(seed), index_(index), channel_(static_cast<std::uint32_t>(pattern)) {}

    double uniform(double least, double most) {
        return least + (most - least) * uniformNoise({seed_, count_++, index_, 100 + channel_});
    }
    bool chance(double probability) { return uniform(0, 1) < probability; }

private:
    std::uint64_t seed_;
    std::uint32_t index_, channel_;
    std::int64_t count_ = 0;
};

/// A stretch of driving: the command goes evenly from one to the other.
struct Stretch {
    double duration = 0;
    Command from, to;
};

double holdTime(Draws& draws) { return 0.2 * power(15, draws.uniform(0, 1)); }

/// Random driving, one stretch after the other. Half of the drivers are calm: they drive forward, turn gently and
/// change their commands slowly; but they stop, too.
class RandomDriver {
public:
    explicit RandomDriver(Draws& draws) : draws_(draws), calm_(draws.chance(0.5)) {}

    Stretch next() {
        const double choice = draws_.uniform(0, 1);
        const Stretch stretch = calm_ ? calm(choice) : wild(choice);
        last_ = stretch.to;
        return stretch;
    }

private:
    static Stretch hold(double duration, const Command& command) { return {duration, command, command}; }
    double forward() { return draws_.uniform(0.1, fullSpeed); }
    double turn() { return fullTurn * draws_.uniform(-1, 1); }

    Stretch calm(double choice) {
        const double duration = holdTime(draws_);
        if (choice < 0.3) return hold(duration, last_);
        if (choice < 0.4) return hold(duration, {forward(), 0});
        if (choice < 0.5) return {duration, last_, {0, 0}};
        const Command aim{forward(), turn() * draws_.uniform(0, 1)};
        return {std::max(duration, std::abs(aim.w - last_.w) / 2), last_, aim};
    }

    Stretch wild(double choice) {
        const double duration = holdTime(draws_);
        const double sense = draws_.chance(0.75) ? 1 : -1;
        if (choice < 0.18) return hold(duration, {sense * forward(), 0});
        if (choice < 0.24) return hold(duration, {0, turn()});
        if (choice < 0.32) return hold(duration / 2, {0, 0});
        if (choice < 0.42) return hold(duration, {sense * fullSpeed, draws_.uniform(-0.5, 0.5)});
        if (choice < 0.48) return hold(duration, {-last_.v, draws_.chance(0.5) ? last_.w : -last_.w});
        const Command aim{sense * forward(), turn() * draws_.uniform(0, 1)};
        return choice < 0.64 ? Stretch{duration, last_, aim} : hold(duration, aim);
    }

    Draws& draws_;
    bool calm_;
    Command last_;
};

std::vector<Stretch> randomStretches(double duration, Draws& draws) {
    RandomDriver driver(draws);
    std::vector<Stretch> stretches;
    double time = 0;
    while (time < duration) {
        stretches.push_back(driver.next());
        time += stretches.back().duration;
    }
    return stretches;
}

std::vector<Stretch> hardSwitchStretches(double duration, Draws& draws) {
    const double full = draws.uniform(5, 7), zero = full + draws.uniform(2.5, 4);
    std::vector<Stretch> stretches = randomStretches(full, draws);
    double before = 0;
    for (const Stretch& s : stretches) before += s.duration;
    stretches.back().duration -= before - full;
    const Command fast{fullSpeed * (draws.chance(0.8) ? 1 : -1), draws.chance(0.5) ? 0 : draws.uniform(-0.4, 0.4)};
    stretches.push_back({zero - full, fast, fast});
    const double stands = draws.uniform(0.8, 2.0);
    stretches.push_back({stands, {}, {}});
    for (const Stretch& s : randomStretches(std::max(0.0, duration - zero - stands), draws)) stretches.push_back(s);
    return stretches;
}

Command at(const std::vector<Stretch>& stretches, double time) {
    for (const Stretch& s : stretches) {
        if (time < s.duration) {
            const double share = time / s.duration;
            return {s.from.v + share * (s.to.v - s.from.v), s.from.w + share * (s.to.w - s.from.w)};
        }
        time -= s.duration;
    }
    return {};
}

/// A curve that is driven: its length, and how it bends where.
struct Curve {
    double length = 0;
    std::function<double(double)> curvature;  ///< 1/m, by the way from its start
};

/// The way along an ellipse whose start is at the end of the short axis, by Simpson's rule on a fine table.
Curve ellipseCurve(const PatternShape& shape) {
    constexpr int pieces = 2000;
    const double a = shape.ellipseLong, b = shape.ellipseShort;
    const auto rate = [=](double angle) { return length({a * towards(angle).x, b * towards(angle).y}); };
    std::vector<double> way{0};
    constexpr double part = 2 * pi / pieces;
    for (int i = 0; i < pieces; ++i)
        way.push_back(way.back() + part / 6 * (rate(i * part) + 4 * rate((i + 0.5) * part) + rate((i + 1) * part)));
    return {way.back(), [=](double s) {
                const auto next = std::upper_bound(way.begin(), way.end() - 1, s);
                const double i = static_cast<double>(next - way.begin()) - 1;
                const double angle = part * (i + (s - *(next - 1)) / (*next - *(next - 1)));
                return a * b / power(rate(angle), 3);
            }};
}

/// The heading rises and falls like 1 - cos over a swerve; how high, for the way to the side that is asked for.
double swerveHeading(const PatternShape& shape) {
    const auto side = [&](double height) {
        constexpr int pieces = 400;
        double sum = 0;
        for (int i = 0; i < pieces; ++i) sum += sine(height / 2 * (1 - cosine(2 * pi * (i + 0.5) / pieces)));
        return shape.jinkLength * sum / pieces;
    };
    double low = 0, high = pi / 2;
    for (int i = 0; i < 60; ++i) (side((low + high) / 2) < shape.jinkSide ? low : high) = (low + high) / 2;
    return low;
}

Curve jinkCurve(const PatternShape& shape) {
    const double height = swerveHeading(shape), length = shape.jinkLength;
    return {2 * (shape.jinkStraight + length), [=](double s) {
                const double in = s - shape.jinkStraight;
                if (in < 0 || in >= 2 * length) return 0.0;
                const double bend = height * pi / length * sine(2 * pi * in / length);
                return in < length ? bend : -bend;
            }};
}

/// Driven at even acceleration up to the speed, and down to rest at the curve's end.
class Drive {
public:
    Drive(const PatternShape& shape, double length) : shape_(shape), length_(length) {
        assert(length > shape.speed * shape.speed / shape.acceleration);
    }
    double rampTime() const { return shape_.speed / shape_.acceleration; }
    double duration() const { return length_ / shape_.speed + rampTime(); }

    double way(double time) const {
        if (time > duration() / 2) return length_ - way(duration() - time);
        if (time < 0) return 0;
        return time < rampTime() ? shape_.acceleration * time * time / 2 : shape_.speed * (time - rampTime() / 2);
    }

private:
    PatternShape shape_;
    double length_;
};

/// Means over each command's period, so that ideal kinematics end on the curve's end.
Command meanOnCurve(const Curve& curve, const Drive& drive, double begin, double end) {
    const auto clamped = [&](double time) { return std::clamp(time, 0.0, drive.duration()); };
    const double from = drive.way(clamped(begin)), to = drive.way(clamped(end));
    constexpr int pieces = 20;
    double turned = 0;
    for (int i = 0; i < pieces; ++i) turned += curve.curvature(from + (to - from) * (i + 0.5) / pieces) / pieces;
    return {(to - from) / (end - begin), turned * (to - from) / (end - begin)};
}

Curve curveOf(DrivePattern pattern, const PatternShape& shape) {
    return pattern == DrivePattern::ellipse ? ellipseCurve(shape) : jinkCurve(shape);
}

bool onCurve(DrivePattern pattern) { return pattern == DrivePattern::ellipse || pattern == DrivePattern::jink; }

/// When commands are sent: every 0.1 s from a random instant on, a few milliseconds early or late, in whole steps of
/// the robot.
std::vector<Nanoseconds> sendTimes(double duration, Draws& draws) {
    std::vector<Nanoseconds> times;
    double time = commandPeriod * draws.uniform(1, 2);
    while (time < duration) {
        const auto steps = std::llround((time + draws.uniform(-0.006, 0.006)) / toSeconds(ReferenceRobot::step));
        times.push_back(steps * ReferenceRobot::step);
        time += commandPeriod;
    }
    return times;
}

double inThousandths(double value) { return std::round(value * 1000) / 1000; }

}  // namespace

std::string_view name(DrivePattern pattern) {
    constexpr std::array<std::string_view, patternCount> names{"random", "hard_switch", "jink", "ellipse"};
    return names[static_cast<std::size_t>(pattern)];
}

double patternDuration(DrivePattern pattern, const PatternShape& shape) {
    if (!onCurve(pattern)) return 60;
    const double whole = 2 * commandPeriod + Drive(shape, curveOf(pattern, shape).length).duration() + standingAtEnd;
    return std::ceil(whole * 10) / 10;
}

std::vector<StampedCommand> patternCommands(DrivePattern pattern, double duration, std::uint64_t seed,
                                            std::uint32_t index, const PatternShape& shape) {
    if (duration < 0) duration = patternDuration(pattern, shape);
    Draws draws(seed, index, pattern);
    const std::vector<Nanoseconds> times = sendTimes(duration, draws);
    std::vector<StampedCommand> commands;
    if (onCurve(pattern)) {
        const Curve curve = curveOf(pattern, shape);
        const Drive drive(shape, curve.length);
        for (std::size_t i = 0; i < times.size(); ++i) {
            const double begin = toSeconds(times[i] - times[0]);
            const double end = i + 1 < times.size() ? toSeconds(times[i + 1] - times[0]) : begin + commandPeriod;
            commands.push_back({times[i], meanOnCurve(curve, drive, begin, end)});
        }
        return commands;
    }
    const std::vector<Stretch> stretches =
        pattern == DrivePattern::random ? randomStretches(duration, draws) : hardSwitchStretches(duration, draws);
    for (const Nanoseconds time : times) {
        const Command command = at(stretches, toSeconds(time));
        commands.push_back({time, {inThousandths(command.v), inThousandths(command.w)}});
    }
    return commands;
}

}  // namespace mrose
