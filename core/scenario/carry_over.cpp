#include "scenario/carry_over.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <typeinfo>

#include "motion/same_motion.h"
#include "physics/kept_impulses.h"

namespace mrose {
namespace {

class CarryOver {
public:
    CarryOver(const Scenario& from, const WorldState& state, const Scenario& to)
        : from_(from), old_(state), to_(to), next_(to.freshState(state.seed)) {
        matchBodies();
    }

    WorldState carry() {
        next_.tick = tickOf(old_.tick);
        for (std::size_t i = 0; i < next_.robots.size(); ++i) {
            if (origin_[i])
                carryRobot(i, *origin_[i]);
            else
                beginRobot(i);
        }
        for (std::size_t i = 0; i < next_.objects.size(); ++i)
            if (const auto origin = origin_[next_.robots.size() + i]) carryObject(i, *origin - old_.robots.size());
        carryContacts();
        carryKicks();
        carryMessages();
        carryGoals();
        carryPast();
        carryTouches();
        return std::move(next_);
    }

private:
    static std::vector<std::string> namesOf(const Scene& scene) {
        std::vector<std::string> names;
        for (const SceneRobot& robot : scene.robots) names.push_back("robot " + robot.name);
        for (const SceneObject& object : scene.objects) names.push_back("object " + object.name);
        return names;
    }

    void matchBodies() {
        const std::vector<std::string> before = namesOf(from_.scene()), after = namesOf(to_.scene());
        std::map<std::string, std::size_t> places;
        for (std::size_t body = 0; body < before.size(); ++body) places.emplace(before[body], body);
        target_.resize(before.size());
        for (std::size_t body = 0; body < after.size(); ++body) {
            const auto found = places.find(after[body]);
            origin_.push_back(found == places.end() ? std::optional<std::size_t>() : found->second);
            if (origin_.back()) target_[*origin_.back()] = body;
        }
    }

    /// Rounded up, so that nothing that was commanded lies in the future.
    std::int64_t tickOf(std::int64_t old) const {
        const Nanoseconds time = from_.scene().timeOf(old), length = to_.scene().tickLength;
        return time / length + (time % length > 0 ? 1 : 0);
    }

    bool sameClock() const { return from_.scene().tickLength == to_.scene().tickLength; }

    void beginRobot(std::size_t robot) {
        RobotState& r = next_.robots[robot];
        r.segment.startTick = r.nextControl = next_.tick;
        r.lastControl = next_.tick - to_.periodOf(robot).ticks;
    }

    void carryRobot(std::size_t robot, std::size_t origin) {
        RobotState& r = next_.robots[robot];
        const auto ready = r.ready;
        r = old_.robots[origin];
        r.ready = ready;
        r.lastControl = tickOf(r.lastControl);
        if (sameMotion(from_.scene().modelOf(origin), to_.scene().modelOf(robot)))
            std::ranges::copy(from_.motionMemory(old_, origin), to_.motionMemory(next_, robot).begin());
        if (!sameClock() || from_.periodOf(origin).ticks != to_.periodOf(robot).ticks)
            r.nextControl = r.segment.startTick = next_.tick;
        carryCommands(robot, origin);
        carryManipulators(robot, origin);
        carrySensors(robot, origin);
        const Controller &before = from_.controller(origin), &after = to_.controller(robot);
        const std::span<const std::byte> memory = from_.memoryOf(old_, origin);
        if (typeid(before) == typeid(after) && memory.size() == to_.memoryOf(next_, robot).size())
            std::copy(memory.begin(), memory.end(), to_.memoryOf(next_, robot).begin());
    }

    void carryObject(std::size_t object, std::size_t origin) {
        next_.objects[object] = old_.objects[origin];
        const ObjectModel &before = *from_.scene().typeOfObject(origin).motion,
                          &after = *to_.scene().typeOfObject(object).motion;
        const std::span<const std::byte> memory = from_.motionMemory(old_, old_.robots.size() + origin);
        const std::span<std::byte> own = to_.motionMemory(next_, next_.robots.size() + object);
        if (typeid(before) == typeid(after) && memory.size() == own.size()) std::ranges::copy(memory, own.begin());
    }

    /// What sensors of the same class, name and memory remember.
    void carrySensors(std::size_t robot, std::size_t origin) {
        const auto before = from_.sensors(origin), after = to_.sensors(robot);
        for (std::size_t i = 0; i < after.size(); ++i)
            for (std::size_t k = 0; k < before.size(); ++k) {
                const std::span<std::byte> own = to_.sensorMemory(next_, robot, i);
                const std::span<const std::byte> old = from_.sensorMemory(old_, origin, k);
                const Sensor &was = *before[k], &becomes = *after[i];
                if (typeid(was) == typeid(becomes) && becomes.name() == was.name() && own.size() == old.size())
                    std::ranges::copy(old, own.begin());
            }
    }

    void carryCommands(std::size_t robot, std::size_t origin) {
        RobotState& r = next_.robots[robot];
        const std::span<const StampedCommand> old = from_.commandSlots(old_, origin).first(r.commandCount);
        r.commandCount = keepNewest(old, to_.commandSlots(next_, robot), r.commandBefore);
    }

    /// Index in `to`'s robot of a manipulator.
    std::optional<std::size_t> manipulatorOf(std::size_t robot, std::size_t origin, std::size_t manipulator) const {
        const std::string& name = from_.scene().typeOf(origin).manipulators[manipulator].name;
        const std::vector<Manipulator>& all = to_.scene().typeOf(robot).manipulators;
        for (std::size_t k = 0; k < all.size(); ++k)
            if (all[k].name == name) return k;
        return std::nullopt;
    }

    void carryManipulators(std::size_t robot, std::size_t origin) {
        for (std::size_t k = 0; k < from_.scene().typeOf(origin).manipulators.size(); ++k)
            if (const auto own = manipulatorOf(robot, origin, k))
                next_.robots[robot].ready[*own] = old_.robots[origin].ready[k];
    }

    void carryContacts() {
        const auto carried = [&](std::uint32_t& body) {
            if (body == noBody) return true;
            if (!target_[body]) return false;
            body = static_cast<std::uint32_t>(*target_[body]);
            return true;
        };
        for (ContactImpulse contact : old_.contacts)
            if (carried(contact.bodyA) && carried(contact.bodyB)) next_.contacts.push_back(contact);
        std::sort(next_.contacts.begin(), next_.contacts.end(), keyLess);
    }

    void carryKicks() {
        for (PendingKick kick : old_.kicks) {
            if (!target_[kick.robot]) continue;
            const std::size_t robot = *target_[kick.robot];
            const auto manipulator = manipulatorOf(robot, kick.robot, kick.manipulator);
            if (!manipulator) continue;
            kick.robot = static_cast<std::uint32_t>(robot);
            kick.manipulator = static_cast<std::uint32_t>(*manipulator);
            next_.kicks.push_back(kick);
        }
    }

    void carryMessages() {
        for (SentMessage message : old_.messages) {
            if (!target_[message.from] || (message.to != noBody && !target_[message.to])) continue;
            message.from = static_cast<std::uint32_t>(*target_[message.from]);
            if (message.to != noBody) message.to = static_cast<std::uint32_t>(*target_[message.to]);
            message.tick = tickOf(message.tick);
            next_.messages.push_back(message);
        }
    }

    void carryGoals() {
        const std::vector<Goal>&before = from_.scene().environment.goals, &after = to_.scene().environment.goals;
        for (std::size_t i = 0; i < after.size(); ++i) {
            const bool stays = i < before.size() && before[i].name == after[i].name;
            const auto found = std::find_if(before.begin(), before.end(),
                                            [&](const Goal& goal) { return goal.name == after[i].name; });
            if (stays || found != before.end())
                next_.goals[i] = old_.goals[stays ? i : static_cast<std::size_t>(found - before.begin())];
        }
    }

    void carryPast() {
        const std::size_t bodies = to_.scene().bodyCount();
        for (std::int64_t lag = 1; lag <= to_.pastDepth(); ++lag) {
            const Nanoseconds ago = lag * to_.scene().tickLength;
            const std::int64_t before = std::min(from_.scene().ticksOf(ago), from_.pastDepth());
            const std::int64_t depth = to_.pastDepth(), slot = ((next_.tick - lag) % depth + depth) % depth;
            for (std::size_t body = 0; body < bodies; ++body)
                next_.past[static_cast<std::size_t>(slot) * bodies + body] =
                    origin_[body] ? from_.poseBefore(old_, *origin_[body], before) : Scenario::poseOf(next_, body);
        }
    }

    void carryTouches() {
        for (RobotTouch touch : old_.touches) {
            if (!target_[touch.robot] || !to_.feelsTouches(*target_[touch.robot])) continue;
            touch.robot = static_cast<std::uint32_t>(*target_[touch.robot]);
            if (touch.other != noBody)
                touch.other = target_[touch.other] ? static_cast<std::uint32_t>(*target_[touch.other]) : noBody;
            touch.tick = tickOf(touch.tick);
            next_.touches.push_back(touch);
        }
    }

    const Scenario& from_;
    const WorldState& old_;
    const Scenario& to_;
    WorldState next_;
    std::vector<std::optional<std::size_t>> origin_;  ///< of each body of `to`, which of `from` it is
    std::vector<std::optional<std::size_t>> target_;  ///< the other way round
};

}  // namespace

std::uint32_t keepNewest(std::span<const StampedCommand> commands, std::span<StampedCommand> slots, Command& before) {
    const std::size_t left = commands.size() - std::min(commands.size(), slots.size());
    if (left > 0) before = commands[left - 1].command;
    std::copy(commands.begin() + static_cast<std::ptrdiff_t>(left), commands.end(), slots.begin());
    return static_cast<std::uint32_t>(commands.size() - left);
}

WorldState carriedOver(const Scenario& from, const WorldState& state, const Scenario& to) {
    return CarryOver(from, state, to).carry();
}

}  // namespace mrose
