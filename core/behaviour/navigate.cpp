#include "behaviour/navigate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "behaviour/arrival.h"
#include "behaviour/back_off.h"
#include "behaviour/coming_path.h"
#include "behaviour/memory_entries.h"
#include "behaviour/own_belief.h"
#include "behaviour/path_following.h"

namespace mrose {
namespace {

constexpr std::size_t mostPoints = 16;                 // of its path
constexpr Nanoseconds planCheckedEvery = 500'000'000;  // whether its plan still holds
constexpr Nanoseconds believedFor = 1'500'000'000;     // what others told, and where they were seen
constexpr double mostOffPath = 0.25;                   // m, from which on it plans anew
constexpr double passingNearer = 0.03;                 // m, nearer than planned that a path may come to be
constexpr double spareAhead = 0.01;                    // m, to what is ahead
constexpr double seesFor = 0.8, seesMore = 0.25;       // s and m, ahead
constexpr double yieldingPatience = 1.2,
                 otherPatience = 2.5;  // s, blocked: until it goes round who gives way, who does not
constexpr Nanoseconds goesRoundFor = 4 * nanosecondsPerSecond;
constexpr double turnAwayFromPath = 0.6;  // rad, after backing off
constexpr double straightAhead = 0.5;     // cosine
constexpr double stopsWithin = 0.05;      // m, of where it is to stop
constexpr double newestShare = 0.3;       // share of a sighting in what is remembered of an object
constexpr double displaced = 0.3;         // m, after which it is believed anew

}  // namespace

struct Navigate::Memory {
    struct Object {
        Point place;
        std::int64_t known;
    };
    struct Mate {
        ComingPath path;  ///< as told last
        Nanoseconds sent;
        std::int64_t told;
        Point place;  ///< as seen last
        Nanoseconds seenAt;
        std::int64_t seen;
    };

    MotionMemory motion;
    OwnBelief self;
    BackOff backOff;
    Arrival arrival;
    std::array<Object, mostBodies> objects;
    std::array<Mate, mostBodies> mates;
    std::array<Point, mostPoints> points;  ///< of its path
    std::int64_t count;                    ///< of these; 0: it has none
    std::int64_t clear;                    ///< it conflicts with nobody's
    std::int64_t planned;                  ///< how often it has planned
    std::int64_t outcome;                  ///< of the last time
    Nanoseconds checked;
    double progress;         ///< m, along its path
    double holdAt;           ///< m, likewise
    Nanoseconds holdUntil;   ///< 0: it does not stop
    double blocked;          ///< s, for how long somebody has been in the way
    Nanoseconds roundUntil;  ///< until then others count as obstacles where they are
    MethodChoice choice;
    std::int64_t plannedBy;  ///< numberOf() the method by which it planned last

    std::span<const Point> path() const { return std::span(points).first(static_cast<std::size_t>(count)); }
    bool holds() const { return motion.now() < holdUntil; }
};

/// What is known of others at one instant.
struct Navigate::Traffic {
    DiscSpace space;
    std::vector<TimedPath> others;  ///< to which it gives way
};

std::size_t Navigate::memorySize() const {
    static_assert(sizeof(Memory::Mate) == sizeof(ComingPath) + 6 * 8, "no padding");
    static_assert(sizeof(Memory) == sizeof(MotionMemory) + sizeof(OwnBelief) + sizeof(BackOff) + sizeof(Arrival) +
                                        mostBodies * (sizeof(Memory::Object) + sizeof(Memory::Mate)) +
                                        mostPoints * sizeof(Point) + 11 * 8 + sizeof(MethodChoice),
                  "no padding");
    return sizeof(Memory);
}

namespace {

std::int64_t numberOf(const TeamMethod& method) {
    return (static_cast<std::int64_t>(method.planner) * 16 + static_cast<std::int64_t>(method.repair)) * 2 +
           (method.lowestFirst ? 1 : 2);
}

/// Where a team mate is by what it told, or where it was seen, if that is newer.
template <class Mate>
std::optional<Point> placeOfMate(const Mate& mate, Nanoseconds now, double rotation) {
    const bool told = mate.told != 0 && now - mate.sent <= believedFor,
               seen = mate.seen != 0 && now - mate.seenAt <= believedFor;
    if (told && (!seen || mate.sent >= mate.seenAt)) return mate.path.timed(toSeconds(mate.sent - now), rotation).at(0);
    if (seen) return mate.place;
    return std::nullopt;
}

template <class Memory>
void rememberBodies(const Observation& observation, bool ball, Memory& memory) {
    for (const SeenBody& seen : observation.objects()) {
        if ((ball && seen.index == 0) || seen.index >= memory.objects.size()) continue;
        auto& object = memory.objects[seen.index];
        const Point at = Placement(memory.self.at(seen.measured, memory.motion)).place(seen.position_B);
        const double share = object.known == 0 || distance(object.place, at) > displaced ? 1 : newestShare;
        object.place = object.place + share * (at - object.place);
        object.known = 1;
    }
    for (const SeenBody& seen : observation.robots()) {
        if (seen.index >= memory.mates.size()) continue;
        auto& mate = memory.mates[seen.index];
        mate.place = Placement(memory.self.at(seen.measured, memory.motion)).place(seen.position_B);
        mate.seenAt = seen.measured;
        mate.seen = 1;
    }
    for (const ReceivedMessage& message : observation.messages()) {
        const std::optional<ComingPath> path = comingPath(message);
        if (!path || message.from >= memory.mates.size()) continue;
        auto& mate = memory.mates[message.from];
        if (mate.told != 0 && message.sent < mate.sent) continue;
        mate.path = *path;
        mate.sent = message.sent;
        mate.told = 1;
    }
}

/// As few of the points as there is room for, by leaving out those that the way bends least at.
void fit(std::vector<Point>& points, std::size_t most) {
    while (points.size() > most) {
        std::size_t least = 1;
        double off = std::numeric_limits<double>::infinity();
        for (std::size_t i = 1; i + 1 < points.size(); ++i)
            if (const double far = distanceToSegment(points[i], points[i - 1], points[i + 1]); far < off) {
                off = far;
                least = i;
            }
        points.erase(points.begin() + static_cast<std::ptrdiff_t>(least));
    }
}

}  // namespace

Navigate::Traffic Navigate::traffic(const Observation& observation, const Memory& memory) const {
    std::vector<ConvexPiece> pieces = options_.walls->pieces();
    for (const Memory::Object& object : memory.objects)
        if (object.known != 0) pieces.push_back(ConvexPiece::circle(object.place, options_.objectRadius));
    std::vector<TimedPath> others;
    const bool round = observation.time < memory.roundUntil;
    for (std::size_t i = 0; i < memory.mates.size(); ++i) {
        const Memory::Mate& mate = memory.mates[i];
        const auto place = placeOfMate(mate, observation.time, options_.rotation);
        if (i == observation.robot || !place) continue;
        const bool told = mate.told != 0 && observation.time - mate.sent <= believedFor;
        const bool stands = !told || mate.path.resting != 0;
        if (stands || (round && distance(*place, position(memory.self.pose)) < 3 * separation()))
            pieces.push_back(ConvexPiece::circle(*place, options_.radius));
        else if (yieldsTo(i, observation.robot, memory))
            others.push_back(mate.path.timed(toSeconds(mate.sent - observation.time), options_.rotation));
    }
    return {DiscSpace(std::move(pieces), options_.radius + options_.spare), std::move(others)};
}

const TeamMethod& Navigate::methodNow(const Memory& memory) const {
    const auto chosen = static_cast<std::size_t>(memory.choice.chosen);
    return chosen > 0 && chosen <= options_.choice.methods.size() ? options_.choice.methods[chosen - 1]
                                                                  : options_.method;
}

/// What a mate tells that comes before it counts. Who is the first itself plans for all, once it has heard who is
/// there.
void Navigate::chooseMethod(const Observation& observation, Memory& memory) const {
    const MethodChoice::Options& options = options_.choice;
    if (options.methods.empty()) return;
    const auto hears = [&](const Memory::Mate& mate) {
        return mate.told != 0 && observation.time - mate.sent <= believedFor;
    };
    for (std::size_t i = 0; i < std::min<std::size_t>(observation.robot, mostBodies); ++i)
        if (const Memory::Mate& mate = memory.mates[i]; hears(mate)) {
            if (mate.path.method != 0) memory.choice.chosen = mate.path.method;
            return;
        }
    if (!memory.choice.hasListened(observation.time, options) || memory.choice.isMade(options)) return;
    std::vector<TeamMember> team{{memory.self.pose, options_.target}};
    std::vector<ConvexPiece> pieces = options_.walls->pieces();
    double objects = 0;
    for (const Memory::Object& object : memory.objects)
        if (object.known != 0) {
            pieces.push_back(ConvexPiece::circle(object.place, options_.objectRadius));
            ++objects;
        }
    for (std::size_t i = 0; i < memory.mates.size(); ++i) {
        const Memory::Mate& mate = memory.mates[i];
        const auto place = placeOfMate(mate, observation.time, options_.rotation);
        if (i == observation.robot || !place) continue;
        if (hears(mate))
            team.push_back({{place->x, place->y, mate.path.heading}, mate.path.target()});
        else
            pieces.push_back(ConvexPiece::circle(*place, options_.radius));
    }
    const DiscSpace space(std::move(pieces), options_.radius + options_.spare);
    memory.choice.consider({team, space, objects, driveTimes(0), separation()}, options);
}

/// Whether the rest of its path is free still, and in no new conflict.
bool Navigate::stillGood(const Traffic& traffic, const Pose& ahead, const Memory& memory) const {
    if (memory.count == 0 || memory.clear == 0 || memory.holds()) return false;
    const auto path = memory.path();
    if (distance(pointAt(path, memory.progress), position(ahead)) > mostOffPath) return false;
    std::vector<Point> rest = pointsAfter(path, memory.progress);
    rest.insert(rest.begin(), pointAt(path, memory.progress));
    // Its first and last piece may lead out of a grown body and into one.
    for (std::size_t i = 2; i + 1 < rest.size(); ++i)
        if (traffic.space.distance(rest[i - 1], rest[i], 1) < traffic.space.radius() - passingNearer) return false;
    rest.front() = position(ahead);
    return !firstConflict(timedPath(rest, driveTimes(ahead.heading)), traffic.others, separation());
}

void Navigate::plan(const Observation& observation, const Pose& ahead, Memory& memory) const {
    memory.checked = observation.time;
    Traffic seen = traffic(observation, memory);
    if (stillGood(seen, ahead, memory)) return;
    const TeamMethod& method = methodNow(memory);
    const PathFinder finder(method.planner, std::move(seen.space));
    const PlanRequest request{
        finder,      method.repair, position(ahead), position(options_.target), driveTimes(ahead.heading),
        seen.others, separation()};
    Plan plan = repairedPlan(request);
    memory.plannedBy = numberOf(method);
    ++memory.planned;
    memory.outcome = static_cast<std::int64_t>(plan.outcome);
    memory.clear = plan.clear ? 1 : 0;
    memory.progress = 0;
    memory.points = {};
    memory.count = 0;
    memory.holdAt = 0;
    memory.holdUntil = 0;
    if (!plan.found()) return;
    fit(plan.points, mostPoints);
    std::copy(plan.points.begin(), plan.points.end(), memory.points.begin());
    memory.count = static_cast<std::int64_t>(plan.points.size());
    if (plan.hold.duration <= 0) return;
    // It stops for so long once it is there.
    const double arrives = plan.hold.at / options_.speed;
    memory.holdAt = plan.hold.at;
    memory.holdUntil = observation.time + fromSeconds(arrives + plan.hold.duration);
}

/// How far it is free straight ahead, m.
double Navigate::freeAhead(const Observation& observation, const Pose& ahead, double most, const Memory& memory) const {
    const Point place = position(ahead), way = towards(ahead.heading);
    double free = options_.walls->freeWay(place, way, options_.radius + spareAhead, most);
    const auto meets = [&](const Point& centre, double radius) {
        const Point line = centre - place;
        const double along = dot(line, way), reach = options_.radius + spareAhead + radius;
        const double squared = dot(line, line), rest = reach * reach - (squared - along * along);
        // Past what it all but touches it may slide.
        if (squared < reach * reach ? along > straightAhead * std::sqrt(squared) : along > 0 && rest > 0)
            free = std::min(free, std::max(0.0, along - std::sqrt(rest)));
    };
    for (const Memory::Object& object : memory.objects)
        if (object.known != 0) meets(object.place, options_.objectRadius);
    for (std::size_t i = 0; i < memory.mates.size(); ++i)
        if (i != observation.robot)
            if (const auto mate = placeOfMate(memory.mates[i], observation.time, options_.rotation))
                meets(*mate, options_.radius);
    return free;
}

/// Who is blocked for some time goes round the others, the one of the higher index sooner.
void Navigate::noteBlocked(const Observation& observation, bool blocked, Memory& memory) const {
    const double since = toSeconds(memory.motion.sinceLast());
    memory.blocked = blocked ? memory.blocked + since : 0;
    bool yields = false;
    for (std::size_t i = 0; i < memory.mates.size(); ++i)
        if (yieldsTo(i, observation.robot, memory))
            if (const auto mate = placeOfMate(memory.mates[i], observation.time, options_.rotation))
                yields = yields || distance(*mate, position(memory.self.pose)) < 2 * separation();
    if (memory.blocked < (yields ? yieldingPatience : otherPatience)) return;
    memory.blocked = 0;
    memory.roundUntil = observation.time + goesRoundFor;
    memory.count = 0;
}

Command Navigate::onTheWay(const Observation& observation, const Pose& ahead, Memory& memory) const {
    if (memory.plannedBy != numberOf(methodNow(memory))) memory.count = 0;
    if (memory.count == 0 || observation.time - memory.checked >= planCheckedEvery) plan(observation, ahead, memory);
    if (memory.count == 0) return {};
    const auto path = memory.path();
    const double all = lengthOf(path);
    memory.progress = progressAlong(path, position(ahead), memory.progress);
    const double end = memory.holds() ? std::min(all, memory.holdAt) : all;
    if (memory.holds() && end - memory.progress < stopsWithin) {
        memory.blocked = 0;
        return {};
    }
    Command command = followPath(path, ahead, memory.progress, end, {options_.speed, options_.rotation});
    const double look = std::min(seesMore + seesFor * options_.speed, std::max(0.05, end - memory.progress));
    const double onwards = freeAhead(observation, ahead, look, memory);
    command.v *= std::min(1.0, onwards / look);
    noteBlocked(observation, onwards < 0.25 * look && std::abs(command.w) < 0.2 * options_.rotation, memory);
    return command;
}

Command Navigate::drive(const Observation& observation, Memory& memory) const {
    if (const std::optional<Command> back = memory.backOff.update(
            observation, memory.motion, {options_.speed, options_.rotation, options_.deadTime, turnAwayFromPath})) {
        memory.arrival.phase = Arrival::backingOff;
        memory.count = 0;
        return *back;
    }
    const Pose ahead = memory.self.pose * memory.motion.motionDuring(options_.deadTime);
    memory.arrival.update(ahead, options_.target, memory.self, {options_.tolerance, options_.headingTolerance, false});
    if (memory.arrival.phase == Arrival::resting) return {};
    if (memory.arrival.phase == Arrival::aligning) return turnTo(options_.target.heading, ahead, options_.rotation);
    return onTheWay(observation, ahead, memory);
}

void Navigate::tell(const Memory& memory, Decision& decision) const {
    ComingPath told{};
    const Pose& pose = memory.self.pose;
    told.x = static_cast<float>(pose.x);
    told.y = static_cast<float>(pose.y);
    told.heading = static_cast<float>(wrapAngle(pose.heading));
    told.targetX = static_cast<float>(options_.target.x);
    told.targetY = static_cast<float>(options_.target.y);
    told.targetHeading = static_cast<float>(options_.target.heading);
    told.speed = static_cast<float>(0.95 * options_.speed);
    told.method = static_cast<std::uint8_t>(memory.choice.chosen);
    told.resting = memory.arrival.phase == Arrival::resting ? 1 : 0;
    if (memory.count > 0 && memory.arrival.phase == Arrival::approaching) {
        std::vector<Point> rest = pointsAfter(memory.path(), memory.progress);
        fit(rest, ComingPath::most);
        told.count = static_cast<std::uint8_t>(rest.size());
        for (std::size_t i = 0; i < rest.size(); ++i)
            told.points[i] = {static_cast<float>(rest[i].x), static_cast<float>(rest[i].y)};
        if (memory.holds()) {
            const double left = std::max(0.0, memory.holdAt - memory.progress);
            told.holdAt = static_cast<float>(left);
            told.holdFor = static_cast<float>(
                std::max(0.0, toSeconds(memory.holdUntil - memory.motion.now()) - left / options_.speed));
        }
    }
    decision.messages.push_back(RadioMessage::of(told, ComingPath::kind));
}

std::string_view Navigate::stateOf(const Memory& memory) const {
    if (memory.arrival.phase != Arrival::approaching)
        return Arrival::names[static_cast<std::size_t>(memory.arrival.phase)];
    if (memory.count == 0) return memory.planned > 0 ? "no way" : "planning";
    if (memory.holds() && memory.holdAt - memory.progress < stopsWithin) return "waiting";
    return memory.motion.now() < memory.roundUntil ? "going round" : "driving";
}

void Navigate::annotate(const Memory& memory, Decision& decision) const {
    if (!decision.wantsAnnotations) return;
    const Point goal = position(options_.target);
    decision.annotations.push_back({.kind = Annotation::Kind::point, .label = "goal", .points = {goal}});
    if (memory.count > 0 && memory.arrival.phase == Arrival::approaching) {
        Annotation path{.kind = Annotation::Kind::line, .label = "path"};
        path.points = pointsAfter(memory.path(), memory.progress);
        path.points.insert(path.points.begin(), position(memory.self.pose));
        decision.annotations.push_back(std::move(path));
        if (memory.holds())
            decision.annotations.push_back({.kind = Annotation::Kind::point,
                                            .label = "waits here",
                                            .points = {pointAt(memory.path(), memory.holdAt)}});
    }
    decision.annotations.push_back(
        {.kind = Annotation::Kind::text, .label = "state", .text = std::string(stateOf(memory))});
}

void Navigate::explain(std::span<const std::byte> bytes, MemoryEntries& entries) const {
    const Memory& memory = as<Memory>(bytes);
    const Nanoseconds now = memory.motion.now();
    entries.add("state", stateOf(memory));
    if (entries.complete()) return;
    if (entries.wants("method")) entries.add("method", nameOf(methodNow(memory)));
    entries.add("plans so far", static_cast<double>(memory.planned));
    if (entries.wants("path length")) entries.add("path length", lengthOf(memory.path()), "m");
    entries.add("progress", memory.progress, "m");
    entries.add("conflicts", memory.count > 0 && memory.clear == 0 ? "yes" : "no");
    entries.add("stops at", memory.holdAt, "m");
    entries.add("stops for", toSeconds(std::max<Nanoseconds>(0, memory.holdUntil - now)), "s");
    entries.add("blocked for", memory.blocked, "s");
    for (std::size_t i = 0; i < memory.objects.size(); ++i)
        if (memory.objects[i].known != 0) {
            const std::string number = std::to_string(i + 1);
            entries.add(EntryName("object ", number, " x"), memory.objects[i].place.x, "m");
            entries.add(EntryName("object ", number, " y"), memory.objects[i].place.y, "m");
        }
    memory.choice.explain(options_.choice, entries);
    explainSelf(memory.self, now, entries);
    explainBackOff(memory.backOff, now, entries);
}

void Navigate::decide(const Observation& observation, std::span<std::byte> bytes, Decision& decision) const {
    Memory& memory = as<Memory>(bytes);
    memory.motion.observe(observation);
    memory.self.update(observation, memory.motion);
    decision.command = Command{};
    if (memory.self.known != 0) {
        rememberBodies(observation, options_.ball, memory);
        chooseMethod(observation, memory);
        decision.command = drive(observation, memory);
        tell(memory, decision);
        annotate(memory, decision);
    }
    memory.motion.issue(*decision.command);
}

}  // namespace mrose
