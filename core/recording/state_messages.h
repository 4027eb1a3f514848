#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scenario/scenario.h"
#include "simulation/step.h"

namespace mrose {

// A state as messages for people's tools, as JSON. Positions are rounded to 0.1 mm, headings to 0.0001 rad, velocities
// to 0.1 mm/s: what is exact lies in the blocks (block_bytes.h). `frames` are names of all bodies, robots first.

/// foxglove.FrameTransforms: where all bodies are in the frame "world".
std::string transformsMessage(const WorldState& state, std::span<const std::string> frames, Nanoseconds time);

/// mrose.Robots: pose, velocity and the command in force, of each robot by its name.
std::string robotsMessage(const Scenario& scenario, const WorldState& state, std::span<const std::string> names);

/// mrose.Objects: pose and velocity, in the world's frame, of each object by its name.
std::string objectsMessage(const WorldState& state, std::span<const std::string> names);

/// What a pair pressed on each other over some ticks.
struct SummedContact {
    std::uint32_t bodyA = 0, bodyB = 0, obstacle = 0;
    Point position;      ///< where it pressed hardest
    double impulse = 0;  ///< N s, along the normal, all together
    double hardest = 0;  ///< N s in one tick
};

/// Sums up contacts of several ticks, pair by pair; in ascending order of the pairs.
std::vector<SummedContact> summedContacts(std::vector<ContactReport> reports);

/// mrose.Contacts.
std::string contactsMessage(const Scenario& scenario, std::span<const SummedContact> contacts,
                            std::span<const std::string> names);

/// foxglove.SceneUpdate: a sphere at each contact, the larger the harder.
std::string contactMarksMessage(std::span<const SummedContact> contacts, Nanoseconds time);

/// foxglove.Log, each for something of note in a tick: kicks, goals, faults, breaks.
std::vector<std::string> logMessages(const Scenario& scenario, const StepTrace& trace,
                                     std::span<const std::string> names, Nanoseconds time);

}  // namespace mrose
