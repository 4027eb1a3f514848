#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "quantities/catalogue.h"
#include "scenario/scenario.h"
#include "simulation/step.h"

namespace mrose {

// A state as messages for people's tools, as JSON. Numbers are rounded, since what is exact lies in the blocks
// (block_bytes.h): positions to 1 mm, headings to about 0.001 rad, velocities to 1 mm/s and 0.001 rad/s. `names` are
// those of all bodies, robots first.

/// foxglove.FrameTransforms: where all bodies are in the frame "world".
std::string transformsMessage(const WorldState& state, std::span<const std::string> frames, Nanoseconds time);

/// What a pair pressed on each other over some ticks.
struct SummedContact {
    std::uint32_t bodyA = 0, bodyB = 0, obstacle = 0;
    Point position;      ///< where it pressed hardest
    double impulse = 0;  ///< N s, along the normal, all together
    double hardest = 0;  ///< N s in one tick
};

/// Sums up contacts of several ticks, pair by pair; in ascending order of the pairs.
std::vector<SummedContact> summedContacts(std::vector<ContactReport> reports);

/// The quantities of the catalogue that mrose.Bodies has of each robot, or of each object.
const std::vector<const Quantity*>& sampledQuantities(bool robot);

/// mrose.Bodies: by its name each body's sampled quantities, and what contacts have pressed on it since the last
/// sample.
std::string bodiesMessage(const Scenario& scenario, const WorldState& state, std::span<const SummedContact> contacts,
                          std::span<const std::string> names);

/// foxglove.SceneUpdate: a sphere at each contact, larger at a harder one, with the bodies' names and the impulse as
/// metadata.
std::string contactsMessage(const Scenario& scenario, std::span<const SummedContact> contacts,
                            std::span<const std::string> names, Nanoseconds time);

/// mrose.Radio: what was sent in a tick and what was due, with the bytes in hexadecimal digits; "" where nothing was.
/// `after`: the state after it. Of more than `mostTransmissions` only so many are listed.
std::string radioMessage(const Scene& scene, const WorldState& after, const StepTrace& trace,
                         std::span<const std::string> names);
constexpr std::size_t mostTransmissions = 1000;

/// foxglove.Log, each for something of note in a tick: kicks, goals, faults, breaks.
std::vector<std::string> logMessages(const Scenario& scenario, const StepTrace& trace,
                                     std::span<const std::string> names, Nanoseconds time);

}  // namespace mrose
