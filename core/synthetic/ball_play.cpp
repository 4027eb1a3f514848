#include "synthetic/ball_play.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/pose.h"
#include "scene/scene.h"
#include "synthetic/field_landmarks.h"
#include "synthetic/reference_ball.h"
#include "synthetic/reference_kicker.h"
#include "synthetic/reference_robot.h"
#include "synthetic/sensor_noise.h"

namespace mrose {
namespace {

enum BallChannel : std::uint32_t {
    ballStart = 440,
    ballHeading,
    driving,
    kicking,
    lying,
    throwing,
    throwAim,
    throwRoll,
    trackedBall,
    missedBall
};

constexpr double radius = 0.11, robotRadius = 0.225;  // m
constexpr double wallFriction = 0.15;
constexpr double margin = 1.4;  // m, of starts from the walls

double between(double least, double most, double share) { return least + (most - least) * share; }

/// The ball and what it may hit, step by step.
class BallHall {
public:
    BallHall(std::uint64_t seed, const Point& place) : seed_(seed), floor_(ballHallFloor()) {
        type_.name = "ball";
        type_.shape = std::make_shared<const Shape>(Shape::fromParts("ball", {{"ball", {}, {}, radius, {}}}));
        ball_.pose = {place.x, place.y, 0};
    }

    Point place() const { return position(ball_.pose); }
    Point velocity() const { return {ball_.velocity_W.x, ball_.velocity_W.y}; }
    void launch(const Point& velocity, double roll, double spin) {
        ball_.velocity_W = {velocity.x, velocity.y, spin};
        ball_.roll_W = roll * velocity;
    }

    /// On by one step, with the robot as it is then.
    void next(std::int64_t step, const Pose& robot, const Point& robotVelocity, BallTruth& truth) {
        const NoiseKey key{seed_, step, 0, 0};
        ball_ = model_.after({ball_, type_, floor_, 0, toSeconds(ReferenceRobot::step), key,
                              std::as_writable_bytes(std::span<ReferenceBall::Memory>(&memory_, 1))});
        const Nanoseconds time = (step + 1) * ReferenceRobot::step;
        const Point at = place();
        const std::array<std::pair<Point, double>, 4> walls{{{{1, 0}, at.x},
                                                             {{-1, 0}, syntheticFieldLength - at.x},
                                                             {{0, 1}, at.y},
                                                             {{0, -1}, syntheticFieldWidth - at.y}}};
        for (const auto& [normal, distance] : walls)
            if (distance < radius) bounce(normal, {}, false, time, truth);
        const Point off = at - position(robot);
        if (const double far = length(off); far < radius + robotRadius && far > 0)
            bounce((1 / far) * off, robotVelocity, true, time, truth);
    }
    double rolling() const {
        const Point slip = velocity() - ball_.roll_W;
        return length(slip) < 0.06 ? model_.rollingDeceleration(place(), velocity(), floor_.rollingDeceleration) : 0;
    }

private:
    void bounce(const Point& normal, const Point& surface, bool robot, Nanoseconds time, BallTruth& truth) {
        const Point relative = velocity() - surface;
        const double approach = -dot(relative, normal);
        if (approach <= 0) return;
        const double parting = hallRestitution(robot, approach) * approach;
        const Point across = relative + approach * normal;
        const double slip = length(across);
        const double kept = slip > 0 ? std::max(0.0, 1 - wallFriction * (approach + parting) / slip) : 0;
        const Point after = surface + kept * across + parting * normal;
        ball_.velocity_W.x = after.x;
        ball_.velocity_W.y = after.y;
        truth.bounces.push_back({time, robot, approach, parting, place()});
    }

    std::uint64_t seed_;
    FloorSurface floor_;
    ReferenceBall model_;
    ReferenceBall::Memory memory_;
    ObjectType type_;
    ObjectState ball_;
};

/// What is drawn for a run before it begins.
struct PlayPlan {
    std::vector<StampedCommand> commands;
    Pose start;
    Nanoseconds event = 0;  ///< the kick's command, or the throw
    double power = 1;
};

PlayPlan planOf(BallPlay play, double duration, std::uint64_t seed) {
    const UniformDraws start(NoiseKey{seed, 0, 0, ballStart}), drive(NoiseKey{seed, 0, 0, driving}),
        kick(NoiseKey{seed, 0, 0, kicking});
    PlayPlan plan;
    plan.start = {between(margin, syntheticFieldLength - margin, start[0]),
                  between(margin, syntheticFieldWidth - margin, start[1]), std::numbers::pi * (2 * start[2] - 1)};
    plan.event = fromSeconds(between(1.0, 1.8, kick[0]));
    plan.power = 0.2 + 0.8 * kick[1];
    const bool drives = play == BallPlay::kicks && drive[0] > 0.3;
    const Command command = drives ? Command{0.4 * drive[1], 1.2 * drive[2] - 0.6} : Command{};
    for (int i = 0; i < static_cast<int>(duration * 10); ++i) {
        const Nanoseconds time = Nanoseconds{i} * 100'000'000 + fromSeconds(0.05 * drive[3]);
        plan.commands.push_back({time, time < plan.event ? command : Command{}});
    }
    return plan;
}

/// Robot poses every step, tracked and true.
struct DrivenRobot {
    SyntheticRun run;
    const Pose& at(std::int64_t step) const {
        return run.truth[std::min(static_cast<std::size_t>(step), run.truth.size() - 1)].pose;
    }
    /// By the steps around.
    Velocity velocity(std::int64_t step) const {
        constexpr std::int64_t span = 5;
        const std::int64_t first = std::max<std::int64_t>(0, step - span);
        const Pose &a = at(first), &b = at(step + span);
        const double seconds = static_cast<double>(step + span - first) * toSeconds(ReferenceRobot::step);
        const Point ahead = towards(at(step).heading);
        return {dot(position(b) - position(a), ahead) / seconds, wrapAngle(b.heading - a.heading) / seconds};
    }
    Point velocity_W(std::int64_t step) const { return velocity(step).v * towards(at(step).heading); }
};

Point trackedPlace(const Point& place, std::uint64_t seed, std::int64_t sample) {
    const NoisePair noise = boxMullerPair({seed, sample, 0, trackedBall});
    const auto inSteps = [](double value) { return std::round(value * 1e4) / 1e4; };
    return {inSteps(place.x + ballTrackerNoise * noise.first), inSteps(place.y + ballTrackerNoise * noise.second)};
}

/// Every so many-th sample of those that were taken at each step.
SyntheticRun thinned(const SyntheticRun& every) {
    SyntheticRun run;
    const auto stride = static_cast<std::size_t>(SyntheticTracker{}.period / ReferenceRobot::step);
    for (std::size_t i = 0; i < every.truth.size(); i += stride) {
        run.truth.push_back(every.truth[i]);
        run.tracked.push_back(every.tracked[i]);
    }
    return run;
}

struct Launch {
    Point place;  ///< where the ball lies before
    std::int64_t step = -1;
    Point velocity_W;
    double roll = 0, spin = 0;
};

Launch kickOff(const DrivenRobot& drive, const PlayPlan& plan, std::uint64_t seed, std::int64_t number,
               BallTruth& truth) {
    const ReferenceKicker kicker(seed);
    const ReferenceKickerParameters& p = kicker.parameters();
    const UniformDraws where(NoiseKey{seed, 0, 0, lying});
    BallTruth::Departure departure;
    departure.delay = kicker.delay(plan.power, number);
    const std::int64_t step = (plan.event + fromSeconds(departure.delay)) / ReferenceRobot::step;
    departure.place = {p.face + radius + between(0, 0.068, where[0]), between(-0.125, 0.125, where[1])};
    departure.robot = drive.velocity(step);
    const ReferenceDeparture left = kicker.strike(plan.power, departure.place, departure.robot, number);
    departure.hit = left.hit;
    departure.velocity = left.velocity;
    truth.departures.push_back(departure);
    const Placement frame(drive.at(step));
    return {frame.place(departure.place), left.hit ? step : -1, frame.rotate(left.velocity), left.roll, left.spin};
}

Launch thrown(const DrivenRobot& drive, const PlayPlan& plan, std::uint64_t seed) {
    const UniformDraws draw(NoiseKey{seed, 0, 0, throwing}), aim(NoiseKey{seed, 0, 0, throwAim});
    const Point robot = position(drive.at(0));
    Launch launch;
    launch.step = plan.event / ReferenceRobot::step;
    const Point from = robot + between(0.8, 2, draw[0]) * towards(2 * std::numbers::pi * draw[1]);
    launch.place = {std::clamp(from.x, 0.3, syntheticFieldLength - 0.3),
                    std::clamp(from.y, 0.3, syntheticFieldWidth - 0.3)};
    const Point at = robot - launch.place;
    const bool atRobot = aim[0] < 0.5;
    const double aim_W = atRobot ? direction(at) + between(-0.12, 0.12, aim[1]) : 2 * std::numbers::pi * aim[1];
    launch.velocity_W = between(0.9, 2.8, draw[2]) * towards(aim_W);
    launch.roll = between(0.2, 1, draw[3]);
    return launch;
}

}  // namespace

FloorSurface ballHallFloor() {
    FloorSurface floor;
    floor.slidingFriction = 0.3;
    floor.rollingDeceleration = 0.4;
    return floor;
}

double hallRestitution(bool robot, double approach) {
    return robot ? std::max(0.2, 0.5 - 0.03 * approach) : std::max(0.3, 0.72 - 0.03 * approach);
}

BallRun playBall(BallPlay play, double duration, std::uint64_t seed, std::int64_t number) {
    const PlayPlan plan = planOf(play, duration, seed);
    SyntheticTracker everyStep;
    everyStep.period = ReferenceRobot::step;
    const DrivenRobot drive{runReferenceRobot(plan.commands, duration, plan.start, seed, everyStep)};
    BallRun run;
    run.commands = plan.commands;
    run.robot = thinned(drive.run);
    if (play == BallPlay::kicks) run.kicks.push_back({plan.event, plan.power});
    const Launch launch =
        play == BallPlay::kicks ? kickOff(drive, plan, seed, number, run.truth) : thrown(drive, plan, seed);
    BallHall hall(seed, launch.place);
    constexpr std::int64_t every = ballTrackerPeriod / ReferenceRobot::step;
    for (std::int64_t step = 0; step < static_cast<std::int64_t>(drive.run.truth.size()); ++step) {
        const Nanoseconds time = step * ReferenceRobot::step;
        if (step == launch.step) hall.launch(launch.velocity_W, launch.roll, launch.spin);
        run.truth.path.push_back({time, hall.place()});
        run.truth.rolling.push_back(hall.rolling());
        if (step % every == 0 && uniformNoise({seed, step, 0, missedBall}) > ballTrackerMissing)
            run.ball.push_back({time, trackedPlace(hall.place(), seed, step)});
        hall.next(step, drive.at(step + 1), drive.velocity_W(step + 1), run.truth);
    }
    return run;
}

}  // namespace mrose
