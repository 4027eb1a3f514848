#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/error.h"
#include "scenario/scenario.h"
#include "scenario/scenario_value.h"

namespace mrose {

/// A state of a run by itself, with the bodies' names and the layout of its arrays.
struct SavedState {
    std::string scenario;  ///< its name
    Nanoseconds tickLength = 0;
    struct Robot {
        std::string name;
        Nanoseconds period = 0;
        std::uint64_t commands = 0;            ///< places for them
        std::uint64_t motion = 0, memory = 0;  ///< bytes of its motion model and its controller
        struct Sensor {
            std::string name;
            std::uint64_t memory = 0;  ///< bytes
            bool operator==(const Sensor&) const = default;
        };
        std::vector<Sensor> sensors;
        bool operator==(const Robot&) const = default;
    };
    std::vector<Robot> robots;
    struct Object {
        std::string name;
        std::uint64_t motion = 0;  ///< bytes of its motion model
        bool operator==(const Object&) const = default;
    };
    std::vector<Object> objects;
    WorldState state;
};
SavedState savedState(const Scenario& scenario, const WorldState& state);

/// As a state file (resources/README.md), exact to the last bit, and back. With `whole`, the scenario that it is a
/// state of, the file is one that can be run by itself. Error: file, line and key of the first thing wrong.
std::string savedStateText(const SavedState& saved, const ScenarioValue* whole = nullptr);
Expected<SavedState> readSavedState(const Value& content, const std::string& file);
Expected<SavedState> parseSavedState(std::string_view text, const std::string& file);

/// Why a scene cannot go on from it: other bodies, ticks of another length. Empty: it can.
std::string unfit(const SavedState& saved, const Scene& scene);

/// The state in a scenario that is fit for it: at its own tick, as it was to the last bit. Bodies whose starts in the
/// scene are elsewhere are moved there. A controller, a motion model or a sensor starts anew where its memory has
/// another size, a sensor also where there was none of its name; a robot whose control period is another decides at
/// once.
WorldState restored(const SavedState& saved, const Scenario& scenario, std::uint64_t seed);

}  // namespace mrose
