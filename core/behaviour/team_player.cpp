#include "behaviour/team_player.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "behaviour/steering.h"
#include "behaviour/team_belief.h"
#include "behaviour/way_to_ball.h"
#include "geometry/point.h"

namespace mrose {
namespace {

constexpr double cannotTell = std::numeric_limits<double>::infinity();
constexpr double oneBody = 0.5;  // m: places of robots nearer than this are of one
// Places of those that support: how far from the ball, m, and which way from the direction to the own goal, rad.
struct SupportingPlace {
    double far, turned;
};
constexpr std::array supportingPlaces{SupportingPlace{1.6, 0}, SupportingPlace{1.6, 1.9}, SupportingPlace{2.8, 0.5},
                                      SupportingPlace{2.8, -0.5}};
constexpr double keepBefore = 0.8;  // m, of the own goal
constexpr double watchFrom = 0.3;   // m, between a supporting place and where it is left alone
constexpr std::array roleNames{"supports", "goes", "keeps"};

Point unitOf(const Point& vector) { return (1 / std::max(1e-9, length(vector))) * vector; }

/// Mates yield to the one that goes: it does not.
ChaseBall::Options unyielding(ChaseBall::Options options) {
    options.yields = false;
    return options;
}

}  // namespace

TeamPlayer::TeamPlayer(Options options) : options_(std::move(options)), chase_(unyielding(options_.chase)) {}

struct TeamPlayer::Memory {
    ChaseBall::Memory chase;  ///< its ball is what the whole team knows of it
    WallStroke stroke;        ///< where it strikes
    BallTrack sighted;        ///< the ball by own sightings alone
    TeamBelief team;
    RoleChoice choice;
    WayToBall way;
    double cost;
    std::int64_t role;   ///< TeamWord::Role
    std::int64_t begun;  ///< how often it began to go
    Nanoseconds gone;    ///< for how long it has gone in all
};

std::size_t TeamPlayer::memorySize() const {
    static_assert(sizeof(Memory) == sizeof(ChaseBall::Memory) + sizeof(WallStroke) + sizeof(BallTrack) +
                                        sizeof(TeamBelief) + sizeof(RoleChoice) + sizeof(WayToBall) + 4 * 8,
                  "no padding");
    return sizeof(Memory);
}

std::size_t TeamPlayer::placeOf(std::uint32_t robot) const {
    const auto found = std::ranges::find(options_.team, robot, &Member::robot);
    return static_cast<std::size_t>(found - options_.team.begin());
}

void TeamPlayer::listen(const Observation& observation, Memory& memory) const {
    for (const ReceivedMessage& message : observation.messages()) {
        const std::size_t place = placeOf(message.from);
        if (place == options_.team.size() || !memory.team.hear(message, place)) continue;
        const TeamWord& word = memory.team.mates[place].word;
        if (word.role != TeamWord::keeps)
            memory.choice.note(
                place, {message.sent, word.cost, word.role == TeamWord::goes ? RoleChoice::goes : RoleChoice::offers});
    }
}

Point TeamPlayer::placeOfSeen(const SeenBody& seen, const Memory& memory) const {
    return Placement(memory.chase.self.at(seen.measured, memory.chase.motion)).place(seen.position_B);
}

/// Robots that it sees, mates as they tell, and others that these see.
std::vector<Point> TeamPlayer::othersOnTheFloor(const Observation& observation, std::size_t place,
                                                const Memory& memory) const {
    std::vector<Point> bodies;
    const auto isNew = [&](const Point& body) {
        return std::ranges::none_of(bodies, [&](const Point& other) { return distance(body, other) < oneBody; });
    };
    for (const SeenBody& seen : observation.robots()) bodies.push_back(placeOfSeen(seen, memory));
    for (const bool mates : {true, false})
        for (std::size_t i = 0; i < options_.team.size(); ++i) {
            const TeamBelief::Mate& mate = memory.team.mates[i];
            if (i == place || !mate.isHeard(observation.time)) continue;
            if (mates) {
                if (const Point at = position(mate.at(observation.time)); isNew(at)) bodies.push_back(at);
                continue;
            }
            for (const TeamWord::Seen& other : mate.word.others)
                if (const Point at{other.x, other.y}; other.x < TeamWord::nowhere / 2 && isNew(at))
                    bodies.push_back(at);
        }
    return bodies;
}

double TeamPlayer::costOf(const Memory& memory) const {
    if (memory.chase.ball.known == 0) return cannotTell;
    switch (options_.choose) {
        case Choose::nearest:
            return memory.way.distance;
        case Choose::distanceOverSpeed:
            return memory.way.distance / std::max(0.01, options_.chase.speed);
        case Choose::fixed:
            return 0;
        case Choose::time:
            break;
    }
    double time = 0;
    options_.time->evaluate(memory.way.numbers(), std::span(&time, 1));
    return std::max(0.0, time);
}

/// What its own going costs, and who goes.
void TeamPlayer::bid(const Observation& observation, std::size_t place, std::span<const Point> others,
                     Memory& memory) const {
    if (memory.chase.ball.known != 0) {
        const ChaseBall::Situation now = chase_.situation(memory.chase);
        const BackOff& off = memory.chase.backOff;
        const double stuck = std::max(off.hardlyMoving, toSeconds(off.until - observation.time));
        memory.way = WayToBall({.robot = now.robot,
                                .velocity = observation.velocity(),
                                .ball = now.ball,
                                .rolls = memory.chase.ball.velocity,
                                .onwards = now.way.direction,
                                .behind = options_.chase.front + options_.chase.ballRadius,
                                .cornered = now.way.cornered,
                                .walls = options_.chase.walls.get(),
                                .ballRadius = options_.chase.ballRadius,
                                .stuck = stuck,
                                .bodies = others});
    }
    memory.cost = costOf(memory);
    const bool went = memory.role == TeamWord::goes;
    const auto note = [&] {
        const bool goes = memory.role == TeamWord::goes;
        if (!options_.keeper)
            memory.choice.note(place, {observation.time, memory.cost, goes ? RoleChoice::goes : RoleChoice::offers});
    };
    note();
    if (options_.choose == Choose::fixed)
        memory.choice.goer = options_.goes;
    else
        memory.choice.choose(observation.time - (went ? options_.handOver : 0), options_.role);
    const bool chosen = memory.choice.goer == static_cast<std::int64_t>(place) + 1;
    memory.role = options_.keeper ? TeamWord::keeps : chosen ? TeamWord::goes : TeamWord::supports;
    note();  // as it tells the others
    if (memory.role == TeamWord::goes) {
        memory.begun += went ? 0 : 1;
        memory.gone += went ? memory.chase.motion.sinceLast() : 0;
    }
}

void TeamPlayer::tell(const Observation& observation, std::size_t place, const Memory& memory,
                      Decision& decision) const {
    if (options_.team.size() < 2 || place == options_.team.size()) return;
    const BallTrack& ball = memory.sighted;
    const bool known = ball.known != 0;
    TeamWord word{.pose = memory.chase.self.pose,
                  .velocity = observation.velocity(),
                  .poseVariance = memory.chase.self.positionVariance,
                  .ball = known ? ball.position : Point{},
                  .ballVelocity = known ? ball.velocity : Point{},
                  .ballVariance = known ? ball.variance : 0,
                  .ballSeen = ball.seen,
                  .others = {{{TeamWord::nowhere, 0}, {TeamWord::nowhere, 0}}},
                  .cost = memory.cost,
                  .role = memory.role};
    double nearest[] = {1e9, 1e9};
    for (const SeenBody& seen : observation.robots()) {
        if (placeOf(seen.index) != options_.team.size()) continue;
        const Point at = placeOfSeen(seen, memory);
        const double far = distance(at, memory.chase.ball.position);
        const std::size_t which = far < nearest[0] ? 0 : 1;
        if (far >= nearest[which]) continue;
        if (which == 0) nearest[1] = nearest[0], word.others[1] = word.others[0];
        nearest[which] = far;
        word.others[which] = {static_cast<float>(at.x), static_cast<float>(at.y)};
    }
    decision.messages.push_back(RadioMessage::of(word, TeamWord::kind));
}

/// In the order of the team, without who goes and keeps.
Point TeamPlayer::supportingPlace(std::size_t place, const Memory& memory) const {
    const Point ball = memory.chase.ball.position;
    const Point home = unitOf(options_.ownGoal - ball);
    if (options_.keeper) return options_.ownGoal - keepBefore * home;
    std::size_t rank = 0;
    for (std::size_t i = 0; i < place; ++i) {
        const TeamBelief::Mate& mate = memory.team.mates[i];
        const bool keeps = mate.known != 0 && mate.word.role == TeamWord::keeps;
        if (!keeps && memory.choice.goer != static_cast<std::int64_t>(i) + 1) ++rank;
    }
    const SupportingPlace& wanted = supportingPlaces[std::min(rank, supportingPlaces.size() - 1)];
    // Those beside are on the side on which there is more of the field.
    const double side = cross(home, options_.chase.target - options_.ownGoal) * home.x < 0 ? -1 : 1;
    const double room = options_.chase.halfWidth + 0.1;
    const auto way = [&](double turned) { return Placement({0, 0, turned}).rotate(home); };
    const auto free = [&](double turned) { return options_.chase.walls->freeWay(ball, way(turned), room, wanted.far); };
    // Beside a wall another way: at the ball it would be in the way itself.
    const double turned = clearHeading(side * wanted.turned, wanted.far, free);
    return ball + free(turned) * way(turned);
}

Command TeamPlayer::support(const Observation& observation, std::size_t place, std::span<const Point> others,
                            Memory& memory) const {
    if (const std::optional<Command> back = chase_.backOff(observation, memory.chase)) {
        memory.chase.phase = ChaseBall::backingOff;
        return *back;
    }
    if (memory.chase.ball.known == 0 && !options_.keeper) return chase_.search(observation, memory.chase);
    memory.chase.phase = ChaseBall::waiting;
    return chase_.standBy(supportingPlace(place, memory), memory.chase.ball.position, memory.chase, others);
}

void TeamPlayer::decide(const Observation& observation, std::span<std::byte> bytes, Decision& decision) const {
    Memory& memory = as<Memory>(bytes);
    ChaseBall::Memory& chase = memory.chase;
    const std::size_t place = placeOf(observation.robot);
    chase.motion.observe(observation);
    chase.self.update(observation, chase.motion);
    listen(observation, memory);
    decision.command = Command{};
    if (chase.self.known != 0) {
        memory.sighted.update(observation, chase.motion, chase.self, chase_.floor());
        chase.ball = memory.team.ball(memory.sighted, chase.self, chase_.floor(), observation.time);
        const std::vector<Point> others = othersOnTheFloor(observation, place, memory);
        bid(observation, place, others, memory);
        tell(observation, place, memory, decision);
        WallStroke* const stroke = options_.chase.stroke ? &memory.stroke : nullptr;
        decision.command = memory.role == TeamWord::goes ? chase_.play(observation, chase, stroke, others, decision)
                                                         : support(observation, place, others, memory);
        annotate(memory, decision);
    }
    chase.motion.issue(*decision.command);
}

std::string TeamPlayer::nameOfGoer(const Memory& memory) const {
    const std::int64_t goer = memory.choice.goer;
    return goer == 0 ? "nobody" : options_.team[static_cast<std::size_t>(goer - 1)].name;
}

void TeamPlayer::annotate(const Memory& memory, Decision& decision) const {
    if (!decision.wantsAnnotations) return;
    const auto text = [&](const char* label, std::string what) {
        decision.annotations.push_back({.kind = Annotation::Kind::text, .label = label, .text = std::move(what)});
    };
    const auto point = [&](const char* label, const Point& place) {
        decision.annotations.push_back({.kind = Annotation::Kind::point, .label = label, .points = {place}});
    };
    text("role", roleNames[static_cast<std::size_t>(memory.role)]);
    text("goes for the ball", nameOfGoer(memory));
    if (memory.chase.ball.known == 0) return;
    point("ball", memory.chase.ball.position);
    point("aim", memory.chase.aim);
    if (std::isfinite(memory.cost)) decision.annotations.push_back({.label = "cost", .value = memory.cost});
}

void TeamPlayer::explain(std::span<const std::byte> bytes, MemoryEntries& entries) const {
    const Memory& memory = as<Memory>(bytes);
    const Nanoseconds now = memory.chase.motion.now();
    const bool goes = memory.role == TeamWord::goes;
    const char* const unit = options_.choose == Choose::nearest ? "m" : "s";
    entries.add("state", goes || memory.chase.phase != ChaseBall::waiting ? ChaseBall::name(memory.chase.phase)
                         : options_.keeper                                ? "keeping"
                                                                          : "supporting");
    entries.add("role", roleNames[static_cast<std::size_t>(memory.role)]);
    if (entries.wants("goer")) entries.add("goer", nameOfGoer(memory));
    entries.add("since", toSeconds(now - memory.choice.since), "s");
    entries.add("switches", static_cast<double>(memory.choice.switches));
    entries.add("begun", static_cast<double>(memory.begun));
    entries.add("gone", toSeconds(memory.gone), "s");
    for (std::size_t i = 0; i < options_.team.size(); ++i) {
        const EntryName name("cost of ", options_.team[i].name);
        if (!entries.wants(name)) continue;
        const auto bid = memory.choice.newest(i);
        entries.add(name, bid ? bid->cost : std::numeric_limits<double>::quiet_NaN(), unit);
    }
    const std::array<double, WayToBall::count> numbers = memory.way.numbers();
    for (std::size_t i = 0; i < numbers.size(); ++i) entries.add(wayToBallNames.begin()[i], numbers[i]);
    if (options_.choose == Choose::time && entries.wants(beyondLearned))
        entries.add(beyondLearned, memory.chase.ball.known != 0 ? options_.time->beyond(numbers) : 0);
    chase_.explain(memory.chase, entries);
}

}  // namespace mrose
