#pragma once

#include <map>
#include <vector>

#include "simulation/small_world.h"

namespace mrose {

/// Says so many things at every control instant: kind n is the n-th of them, the bytes say its time. Odd ones go to
/// `to`, even ones to all. It remembers all that it hears, in its order, as a hash, and may turn by that.
class Announcer final : public Controller {
public:
    Announcer(int messages, std::uint32_t to = broadcast, Command command = {}, bool turns = false)
        : messages_(messages), to_(to), command_(command), turns_(turns) {}
    std::size_t memorySize() const override { return sizeof(std::uint64_t); }
    void decide(const Observation& observation, std::span<std::byte> memory, Decision& decision) const override {
        auto& heard = as<std::uint64_t>(memory);
        for (const ReceivedMessage& m : observation.messages())
            for (const std::uint64_t part : {static_cast<std::uint64_t>(m.sent), std::uint64_t{m.from},
                                             std::uint64_t{m.kind}, static_cast<std::uint64_t>(observation.time)})
                heard = (heard ^ part) * 0x100000001b3;
        decision.command = command_;
        if (turns_) decision.command->w = static_cast<double>(heard >> 32) * 0x1p-32;
        for (int n = 0; n < messages_; ++n)
            decision.messages.push_back(
                RadioMessage::of(observation.time, static_cast<std::uint32_t>(n), n % 2 == 1 ? to_ : broadcast));
    }

private:
    int messages_;
    std::uint32_t to_;
    Command command_;
    bool turns_;
};

inline std::shared_ptr<const Controller> announcer(int messages, std::uint32_t to = broadcast, Command command = {}) {
    return std::make_shared<const Announcer>(messages, to, command);
}
inline std::shared_ptr<const MotionModel> everyTicks(std::int64_t ticks) {
    return std::make_shared<const KinematicModel>(KinematicParameters{}, ticks * 20'000'000);
}

/// A message as a test knows it: who said which thing to whom in which tick.
struct Said {
    std::int64_t tick = 0;
    std::uint32_t from = 0, kind = 0, to = 0;
    auto operator<=>(const Said&) const = default;
};
/// What robots were given, by the observations of their controllers; and where all were at each tick.
struct Heard {
    std::map<Said, std::vector<std::int64_t>> at;  ///< the ticks in which it was given
    std::map<Said, std::vector<Nanoseconds>> arrival;
    std::vector<std::vector<Said>> order;                                              ///< of each receiver
    std::map<std::pair<std::uint32_t, std::int64_t>, std::vector<RadioMessage>> sent;  ///< by robot and tick
    std::vector<std::vector<Point>> places;                                            ///< by tick and robot
    int outOfRange = 0, lost = 0;
    std::size_t mostKept = 0;
};
/// Runs it, and checks that what arrives is what was sent.
Heard listen(const Scenario& scenario, int ticks);
/// What must be given by then, and when, of a radio without jitter and loss: from the periods and phases alone.
std::map<Said, std::vector<std::int64_t>> expectedOf(const Scenario& scenario, const Heard& heard, int ticks);

}  // namespace mrose
