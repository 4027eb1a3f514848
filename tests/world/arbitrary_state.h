#pragma once

#include <cstring>
#include <random>

#include "world/world_state.h"

namespace mrose {

/// A state whose every number is another arbitrary pattern of bits, nans and zeros of both signs among them.
inline WorldState arbitraryState(std::uint64_t seed, std::size_t robots = 3) {
    std::mt19937_64 random(seed);
    const auto fill = [&](auto& value) {
        auto* bytes = reinterpret_cast<unsigned char*>(&value);
        for (std::size_t i = 0; i < sizeof value; ++i) bytes[i] = static_cast<unsigned char>(random());
    };
    const auto fillAll = [&](auto& values, std::size_t count) {
        values.resize(count);
        for (auto& value : values) fill(value);
    };
    WorldState state;
    fill(state.tick);
    fill(state.seed);
    state.robots.resize(robots);
    for (RobotState& robot : state.robots) {
        unsigned char bits[sizeof robot];
        for (unsigned char& byte : bits) byte = static_cast<unsigned char>(random());
        std::memcpy(static_cast<void*>(&robot), bits, sizeof robot);
        const bool flag = (random() & 1) != 0;
        std::memcpy(&robot.pushed, &flag, 1);
    }
    fillAll(state.objects, 2);
    fillAll(state.contacts, 5);
    fillAll(state.kicks, 2);
    fillAll(state.goals, 2);
    fillAll(state.commands, 7);
    fillAll(state.messages, 2);
    fillAll(state.motion, 48);
    fillAll(state.memory, 33);
    fillAll(state.sensing, 19);
    fillAll(state.past, 10);
    fillAll(state.touches, 3);
    state.objects[0].pose.x = 0.0;
    state.objects[0].pose.y = -0.0;
    return state;
}

}  // namespace mrose
