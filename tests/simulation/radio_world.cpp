#include "simulation/radio_world.h"

#include <gtest/gtest.h>

namespace mrose {

Heard listen(const Scenario& scenario, int ticks) {
    Heard heard;
    heard.order.resize(scenario.scene().robots.size());
    WorldState state = scenario.initialState();
    StepBuffers buffers;
    StepTrace trace;
    for (int k = 0; k < ticks; ++k) {
        std::vector<Point>& places = heard.places.emplace_back();
        for (const RobotState& robot : state.robots) places.push_back(position(robot.pose));
        step(scenario, state, buffers, {}, &trace);
        heard.mostKept = std::max(heard.mostKept, state.messages.size());
        for (std::uint32_t i = 0; i < trace.robots.size(); ++i) {
            if (!trace.robots[i].decided) continue;
            heard.sent[{i, k}] = trace.robots[i].decision.messages;
            for (const ReceivedMessage& m : trace.robots[i].observation.messages()) {
                const Said said{m.sent / scenario.scene().tickLength, m.from, m.kind, i};
                Nanoseconds told = 0;
                std::memcpy(&told, m.bytes.data(), sizeof told);
                EXPECT_EQ(told, m.sent);
                EXPECT_EQ(m.size, sizeof told);
                heard.at[said].push_back(k);
                heard.order[i].push_back(said);
            }
        }
        for (const Transmission& t : trace.transmissions) {
            const SentMessage& m = trace.messages[t.message];
            heard.lost += t.outcome == Transmission::Outcome::lost ? 1 : 0;
            heard.outOfRange += t.outcome == Transmission::Outcome::outOfRange ? 1 : 0;
            if (t.outcome == Transmission::Outcome::received)
                heard.arrival[{m.tick, m.from, m.kind, t.to}].push_back(t.arrival);
        }
    }
    return heard;
}

std::map<Said, std::vector<std::int64_t>> expectedOf(const Scenario& scenario, const Heard& heard, int ticks) {
    std::map<Said, std::vector<std::int64_t>> expected;
    const Scene& scene = scenario.scene();
    const Radio& radio = scene.radio;
    for (const auto& [when, messages] : heard.sent)
        for (std::uint32_t to = 0; to < scene.robots.size(); ++to) {
            const auto [from, tick] = when;
            const bool none = std::any_of(scene.robots.begin(), scene.robots.end(),
                                          [](const SceneRobot& robot) { return !robot.team.empty(); });
            const std::string &own = scene.robots[from].team, &other = scene.robots[to].team;
            if (to == from || own != other || (none && own.empty())) continue;
            // Instant after instant, until one is late enough.
            std::int64_t instant = scene.robots[to].phase;
            while (instant <= tick || instant * scene.tickLength < tick * scene.tickLength + radio.latency)
                instant += scene.periodTicks(to);
            if (instant >= ticks) continue;
            const Point apart = heard.places[static_cast<std::size_t>(instant)][to] -
                                heard.places[static_cast<std::size_t>(tick)][from];
            if (radio.range > 0 && apart.x * apart.x + apart.y * apart.y > radio.range * radio.range) continue;
            for (const RadioMessage& message : messages)
                if (message.to == broadcast || message.to == to) expected[{tick, from, message.kind, to}] = {instant};
        }
    return expected;
}

}  // namespace mrose
