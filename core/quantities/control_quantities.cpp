// What sensors and controllers saw, decided and noted at the last control instant. This is the only place that reads
// observations.
#include <algorithm>
#include <cmath>

#include "quantities/note_label.h"
#include "quantities/quantity_tables.h"

namespace mrose {
namespace {

using Of = Quantity::Of;

const RobotInsight* insightOf(const Subject& s) {
    return s.body < s.at.insights.size() && s.at.insights[s.body].tick >= 0 ? &s.at.insights[s.body] : nullptr;
}

const Observation* observation(const Subject& s) {
    return insightOf(s) != nullptr && insightOf(s)->observed ? &insightOf(s)->observation : nullptr;
}

std::optional<Pose> measuredSelf(const Subject& s) {
    const Observation* const all = observation(s);
    return all != nullptr && all->localised() ? std::optional(all->self()) : std::nullopt;
}

const SeenBody* seen(const Subject& s) {
    const Observation* const all = observation(s);
    if (all == nullptr) return nullptr;
    const auto robots = static_cast<std::uint32_t>(s.at.state->robots.size());
    const std::span<const SeenBody> bodies = s.other < robots ? all->robots() : all->objects();
    const std::uint32_t index = s.other < robots ? s.other : s.other - robots;
    const auto found =
        std::find_if(bodies.begin(), bodies.end(), [&](const SeenBody& body) { return body.index == index; });
    return found == bodies.end() ? nullptr : &*found;
}

/// Where the robot takes what it sees to be, by the pose that it measured.
std::optional<Point> seenAt(const Subject& s) {
    const SeenBody* const body = seen(s);
    const auto self = measuredSelf(s);
    if (body == nullptr || !self) return std::nullopt;
    return Placement(*self).place(body->position_B);
}

using Kind = Annotation::Kind;

template <bool points>
std::vector<Quantity::Item> notes(const Subject& s) {
    std::vector<Quantity::Item> items;
    if (insightOf(s) == nullptr) return items;
    for (const Annotation& note : insightOf(s)->decision.annotations) {
        const NoteLabel label = noteLabel(note.label);
        if (!points && note.kind == Kind::value) items.push_back({label.name, label.unit});
        if (!points && note.kind == Kind::text) items.push_back({note.label, ""});
        if (points && !note.points.empty()) items.push_back({note.label, "m"});
    }
    return items;
}

const Annotation* noteOf(const Subject& s) {
    if (insightOf(s) == nullptr) return nullptr;
    for (const Annotation& note : insightOf(s)->decision.annotations)
        if (note.label == s.item || noteLabel(note.label).name == s.item) return &note;
    return nullptr;
}

QuantityValue noted(const Subject& s) {
    const Annotation* const note = noteOf(s);
    if (note != nullptr && note->kind == Kind::text) return note->text;
    return note != nullptr && note->kind == Kind::value ? note->value : unknownNumber;
}

double notedPoint(const Subject& s, double Point::*axis) {
    const Annotation* const note = noteOf(s);
    return note != nullptr && !note->points.empty() ? note->points.front().*axis : unknownNumber;
}

void addSight(std::vector<Quantity>& all) {
    addQuantities(
        all, "", Quantity::Needs::control,
        {{"seen_x", metres, "of what it sees, with the pose that it takes itself to have", Of::seenPair,
          +[](const Subject& s) { return seenAt(s) ? seenAt(s)->x : unknownNumber; }},
         {"seen_y", metres, "of what it sees, with the pose that it takes itself to have", Of::seenPair,
          +[](const Subject& s) { return seenAt(s) ? seenAt(s)->y : unknownNumber; }},
         {"seen_error", metres, "how far off it sees the other: measured then, against where that is now", Of::seenPair,
          +[](const Subject& s) {
              const auto place = seenAt(s);
              return place ? distance(*place, position(otherPose(s))) : unknownNumber;
          }},
         {"seen_age", seconds, "since it measured the other", Of::seenPair, +[](const Subject& s) {
              return seen(s) != nullptr ? toSeconds(s.at.now() - seen(s)->measured) : unknownNumber;
          }}});
}

void addNotes(std::vector<Quantity>& all) {
    addQuantities(all, "", Quantity::Needs::control,
                  {{"note", {}, "the controller's own note", Of::items, noted, false, notes<false>, true},
                   {"note_x", metres, "of a point or line that the controller noted", Of::items,
                    +[](const Subject& s) { return notedPoint(s, &Point::x); }, false, notes<true>, true},
                   {"note_y", metres, "of a point or line that the controller noted", Of::items,
                    +[](const Subject& s) { return notedPoint(s, &Point::y); }, false, notes<true>, true}});
}

/// Since the newest of those that were received at the last control instant was sent.
double messageAge(const Subject& s) {
    const Observation* const all = observation(s);
    if (all == nullptr || all->messages().empty()) return unknownNumber;
    Nanoseconds newest = all->messages().front().sent;
    for (const ReceivedMessage& message : all->messages()) newest = std::max(newest, message.sent);
    return toSeconds(s.at.now() - newest);
}

void addRadio(std::vector<Quantity>& all) {
    addQuantities(all, "Radio", Quantity::Needs::control,
                  {{"messages_received", count, "how many messages it got at its last control instant", Of::robot,
                    +[](const Subject& s) {
                        const Observation* const seen = observation(s);
                        return seen != nullptr ? static_cast<double>(seen->messages().size()) : unknownNumber;
                    }},
                   {"messages_sent", count, "how many messages it sent at its last control instant", Of::robot,
                    +[](const Subject& s) {
                        const RobotInsight* const insight = insightOf(s);
                        return insight != nullptr ? static_cast<double>(insight->decision.messages.size())
                                                  : unknownNumber;
                    }},
                   {"message_age", seconds, "since the newest of the messages that it got then was sent", Of::robot,
                    messageAge}});
}

double odometry(const Subject& subject, double Velocity::*part) {
    const Observation* const seen = observation(subject);
    return seen != nullptr ? seen->velocity().*part : unknownNumber;
}

}  // namespace

void addControlQuantities(std::vector<Quantity>& all) {
    const char* const self = "of itself, as measured last";
    addQuantities(
        all, "Sees", Quantity::Needs::control,
        {{"measured_error", metres, "how far off it takes itself to be: as measured, against where it is now",
          Of::robot,
          +[](const Subject& s) {
              const auto measured = measuredSelf(s);
              return measured ? distance(position(*measured), position(poseOf(s))) : unknownNumber;
          }},
         {"measured_x", metres, self, Of::robot, +[](const Subject& s) { return partOr(measuredSelf(s), &Pose::x); }},
         {"measured_y", metres, self, Of::robot, +[](const Subject& s) { return partOr(measuredSelf(s), &Pose::y); }},
         {"measured_heading", angle, self, Of::robot,
          +[](const Subject& s) { return wrapAngle(partOr(measuredSelf(s), &Pose::heading)); }},
         {"measured_heading_error", angle, "of itself, as measured, against its heading now", Of::robot,
          +[](const Subject& s) { return wrapAngle(partOr(measuredSelf(s), &Pose::heading) - poseOf(s).heading); }},
         {"measured_age", seconds, "since it measured itself", Of::robot,
          +[](const Subject& s) {
              return measuredSelf(s) ? toSeconds(s.at.now() - observation(s)->selfMeasured()) : unknownNumber;
          }},
         {"odometry_v", metresPerSecond, "by odometry", Of::robot,
          +[](const Subject& s) { return odometry(s, &Velocity::v); }},
         {"odometry_w", radiansPerSecond, "by odometry", Of::robot,
          +[](const Subject& s) { return odometry(s, &Velocity::w); }}});
    addSight(all);
    addRadio(all);
    addNotes(all);
}

}  // namespace mrose
