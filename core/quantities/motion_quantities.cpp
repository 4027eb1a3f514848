// Where bodies are, how they move, what touches them, and their commands.
#include <algorithm>

#include "geometry/elementary.h"
#include "geometry/point.h"
#include "quantities/quantity_tables.h"
#include "simulation/driving_now.h"

namespace mrose {
namespace {

using Of = Quantity::Of;
using Needs = Quantity::Needs;

/// Whether any of what the last tick reports fits; there was no last tick at a run's start.
template <class Report, class Fits>
bool any(const Subject& s, std::vector<Report> StepTrace::*reports, Fits fits) {
    return s.at.trace != nullptr && std::any_of((s.at.trace->*reports).begin(), (s.at.trace->*reports).end(), fits);
}

bool involves(const ContactReport& contact, std::uint32_t body) {
    return contact.bodyA == body || contact.bodyB == body;
}
bool isBetween(const ContactReport& contact, std::uint32_t a, std::uint32_t b) {
    return (contact.bodyA == a && contact.bodyB == b) || (contact.bodyA == b && contact.bodyB == a);
}

template <class Fits>
double impulseOf(const Subject& s, Fits fits) {
    double sum = 0;
    if (s.at.trace != nullptr)
        for (const ContactReport& contact : s.at.trace->contacts)
            if (fits(contact)) sum += contact.impulse;
    return sum;
}

double speed(const Subject& s) {
    return isRobot(s) ? length({robotOf(s).velocity_B.x, robotOf(s).velocity_B.y})
                      : length({objectOf(s).velocity_W.x, objectOf(s).velocity_W.y});
}

Command commandBefore(const Subject& s, Nanoseconds delay) {
    return s.at.scenario->commandsOf(*s.at.state, s.body).at(s.at.now() - delay);
}
MotionModel::DeadTimes deadTimes(const Subject& s) { return s.at.scene().modelOf(s.body).deadTimes(); }

Pose predictedEnd(const Subject& s) { return robotOf(s).segment.start * robotOf(s).segment.increment; }

double unfamiliar(const Subject& s) {
    const DrivingReader* const reader = familiarDriving(s.at.scene(), s.body);
    return reader == nullptr ? unknownNumber : reader->unfamiliar(drivingNow(*s.at.scenario, *s.at.state, s.body));
}

/// What contact changed in the last tick, in the frame of where the body would have been.
std::optional<Pose> pushed(const Subject& s) {
    if (s.at.trace == nullptr || s.body >= s.at.trace->robots.size()) return std::nullopt;
    const StepTrace::Robot& of = s.at.trace->robots[s.body];
    return of.touched ? relative(of.planned, poseOf(s)) : Pose{};
}

std::vector<Quantity::Item> manipulators(const Subject& s) {
    std::vector<Quantity::Item> items;
    for (const Manipulator& manipulator : s.at.scene().typeOf(s.body).manipulators)
        items.push_back({manipulator.name, "s"});
    return items;
}

std::optional<std::size_t> manipulatorOf(const Subject& s) {
    const std::vector<Manipulator>& all = s.at.scene().typeOf(s.body).manipulators;
    const auto found = std::find_if(all.begin(), all.end(), [&](const Manipulator& m) { return m.name == s.item; });
    return found == all.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - all.begin()));
}

double readyIn(const Subject& s) {
    const auto which = manipulatorOf(s);
    return which ? toSeconds(std::max<Nanoseconds>(0, robotOf(s).ready[*which] - s.at.now())) : unknownNumber;
}

double kickIn(const Subject& s) {
    const auto which = manipulatorOf(s);
    for (const PendingKick& kick : s.at.state->kicks)
        if (kick.robot == s.body && kick.manipulator == which) return toSeconds(kick.due - s.at.now());
    return unknownNumber;
}

void addOfRun(std::vector<Quantity>& all) {
    addQuantities(
        all, "", Needs::nothing,
        {{"time", seconds, "since the start", Of::run, +[](const Subject& s) { return toSeconds(s.at.now()); }},
         {"tick", count, "ticks since the start", Of::run, +[](const Subject& s) { return s.at.state->tick; }},
         {"seed", count, "of the run's noise", Of::run,
          +[](const Subject& s) { return static_cast<std::int64_t>(s.at.state->seed); }},
         {"goals", count, "balls so far in a goal", Of::goal,
          +[](const Subject& s) { return std::int64_t{s.at.state->goals[s.body]}; }}});
}

void addMotion(std::vector<Quantity>& all) {
    addQuantities(all, "Motion", Needs::nothing,
                  {{"x", metres, "of the reference point, in the world", Of::body,
                    +[](const Subject& s) { return poseOf(s).x; }, true},
                   {"y", metres, "of the reference point, in the world", Of::body,
                    +[](const Subject& s) { return poseOf(s).y; }, true},
                   {"heading", angle, "counter-clockwise from the x axis", Of::body,
                    +[](const Subject& s) { return wrapAngle(poseOf(s).heading); }, true},
                   {"speed", metresPerSecond, "in whatever direction", Of::body, speed},
                   {"v", metresPerSecond, "its velocity along its heading", Of::robot,
                    +[](const Subject& s) { return robotOf(s).velocity_B.x; }, true},
                   {"v_left", metresPerSecond, "its velocity to its left: where it is pushed", Of::robot,
                    +[](const Subject& s) { return robotOf(s).velocity_B.y; }, true},
                   {"w", radiansPerSecond, "its turning, counter-clockwise", Of::robot,
                    +[](const Subject& s) { return robotOf(s).velocity_B.rotation; }, true},
                   {"vx", metresPerSecond, "its velocity along the x axis", Of::object,
                    +[](const Subject& s) { return objectOf(s).velocity_W.x; }, true},
                   {"vy", metresPerSecond, "its velocity along the y axis", Of::object,
                    +[](const Subject& s) { return objectOf(s).velocity_W.y; }, true},
                   {"w", radiansPerSecond, "its turning, counter-clockwise", Of::object,
                    +[](const Subject& s) { return objectOf(s).velocity_W.rotation; }, true},
                   {"direction", angle, "in which it moves", Of::object,
                    +[](const Subject& s) {
                        const Twist& velocity_W = objectOf(s).velocity_W;
                        return speed(s) > 0 ? arcTangent(velocity_W.y, velocity_W.x) : unknownNumber;
                    }},
                   {"slip", metresPerSecond, "speed of its lowest point over the floor: 0 where it rolls", Of::object,
                    +[](const Subject& s) {
                        return length(Point{objectOf(s).velocity_W.x, objectOf(s).velocity_W.y} - objectOf(s).roll_W);
                    }}});
}

void addContacts(std::vector<Quantity>& all) {
    addQuantities(
        all, "", Needs::nothing,
        {{"touching", count, "whether it touched anything in the last tick", Of::body,
          +[](const Subject& s) {
              return any(s, &StepTrace::contacts, [&](const auto& contact) { return involves(contact, s.body); });
          }},
         {"impulse", newtonSeconds, "of all touches in the last tick", Of::body,
          +[](const Subject& s) {
              return impulseOf(s, [&](const ContactReport& contact) { return involves(contact, s.body); });
          }},
         {"touching", count, "whether they touched in the last tick", Of::touchingPair,
          +[](const Subject& s) {
              return any(s, &StepTrace::contacts,
                         [&](const auto& contact) { return isBetween(contact, s.body, s.other); });
          }},
         {"impulse", newtonSeconds, "along the normal, in the last tick", Of::touchingPair,
          +[](const Subject& s) {
              return impulseOf(s, [&](const ContactReport& contact) { return isBetween(contact, s.body, s.other); });
          }},
         {"distance", metres, "between the reference points", Of::pair,
          +[](const Subject& s) { return distance(position(poseOf(s)), position(otherPose(s))); }},
         {"bearing", angle, "from its heading to the direction of the other; left is positive", Of::pair,
          +[](const Subject& s) {
              const Pose &from = poseOf(s), &to = otherPose(s);
              return wrapAngle(direction(position(to) - position(from)) - from.heading);
          }}});
}

void addCommands(std::vector<Quantity>& all) {
    addQuantities(all, "Commands", Needs::nothing,
                  {{"active_v", metresPerSecond, "of the command that acts now: issued a dead time ago", Of::robot,
                    +[](const Subject& s) { return commandBefore(s, deadTimes(s).v).v; }},
                   {"active_w", radiansPerSecond, "of the command that acts now: issued a dead time ago", Of::robot,
                    +[](const Subject& s) { return commandBefore(s, deadTimes(s).w).w; }},
                   {"command_v", metresPerSecond, "of the command issued last; it acts a dead time later", Of::robot,
                    +[](const Subject& s) { return commandBefore(s, 0).v; }, true},
                   {"command_w", radiansPerSecond, "of the command issued last; it acts a dead time later", Of::robot,
                    +[](const Subject& s) { return commandBefore(s, 0).w; }, true}});
    addQuantities(
        all, "Kicks", Needs::nothing,
        {{"kicked", count, "whether one of its manipulators acted in the last tick", Of::robot,
          +[](const Subject& s) {
              return any(s, &StepTrace::kicks, [&](const StepTrace::Kicked& kick) { return kick.robot == s.body; });
          }},
         {"ready_in", roughSeconds, "until a manipulator can act again", Of::items, readyIn, false, manipulators},
         {"kick_in", roughSeconds, "of a kick on its way: until it is carried out", Of::items, kickIn, false,
          manipulators}});
}

void addPredictions(std::vector<Quantity>& all) {
    const char* const end = "predicted for the end of its control period, if nothing touches it";
    const char* const off = "where contact put it in the last tick, as seen from where the model had planned it";
    addQuantities(all, "Motion model", Needs::nothing,
                  {{"predicted_x", metres, end, Of::robot, +[](const Subject& s) { return predictedEnd(s).x; }},
                   {"predicted_y", metres, end, Of::robot, +[](const Subject& s) { return predictedEnd(s).y; }},
                   {"predicted_heading", angle, end, Of::robot,
                    +[](const Subject& s) { return wrapAngle(predictedEnd(s).heading); }},
                   {"predicted_v", metresPerSecond, end, Of::robot,
                    +[](const Subject& s) { return robotOf(s).segment.endVelocity.v; }},
                   {"predicted_w", radiansPerSecond, end, Of::robot,
                    +[](const Subject& s) { return robotOf(s).segment.endVelocity.w; }},
                   {"unfamiliar", share, "to its network: 0.9 is as far from what it learned from as 1 in 1000 of that",
                    Of::robot, unfamiliar},
                   {"pushed_ahead", tenthsOfMillimetres, off, Of::robot,
                    +[](const Subject& s) { return partOr(pushed(s), &Pose::x); }},
                   {"pushed_left", tenthsOfMillimetres, off, Of::robot,
                    +[](const Subject& s) { return partOr(pushed(s), &Pose::y); }},
                   {"pushed_round", fineAngle, off, Of::robot,
                    +[](const Subject& s) { return wrapAngle(partOr(pushed(s), &Pose::heading)); }},
                   {"recovering", count, "whether its wheels bring it back to its way after a push", Of::robot,
                    +[](const Subject& s) { return robotOf(s).pushed; }}});
}

}  // namespace

void addMotionQuantities(std::vector<Quantity>& all) {
    addOfRun(all);
    addMotion(all);
    addContacts(all);
    addCommands(all);
    addPredictions(all);
}

}  // namespace mrose
