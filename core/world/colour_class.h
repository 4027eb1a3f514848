#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace mrose {

/// What a colour stands for in the eyes of a colour camera. Readings have the numbers.
enum class ColourClass : std::uint32_t {
    nothing,  ///< within range, or of no known colour
    floor,
    marking,
    wall,
    obstacle,
    yellowGoal,
    blueGoal,
    ball,
    box,
    person,
    robot,     ///< it or who looks is of no team
    teamMate,  ///< of the team of who looks
    opponent,  ///< of another one
};

/// As files have them.
constexpr std::array<std::string_view, 13> colourClassWords{"nothing",     "floor",     "marking", "wall", "obstacle",
                                                            "yellow_goal", "blue_goal", "ball",    "box",  "person",
                                                            "robot",       "team_mate", "opponent"};
static_assert(static_cast<std::size_t>(ColourClass::opponent) + 1 == colourClassWords.size());

constexpr std::string_view wordOf(ColourClass colourClass) {
    return colourClassWords[static_cast<std::size_t>(colourClass)];
}

}  // namespace mrose
