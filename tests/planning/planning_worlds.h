#pragma once

#include <cstdint>

#include "planning/disc_space.h"

namespace mrose {

/// Uniform between two bounds, the same for the same seed, trial and part.
double drawnNumber(std::uint64_t seed, std::int64_t which, std::uint32_t part, double least, double most);
ConvexPiece boxPiece(const Pose& pose, double length, double width);
/// Four walls of 0.2 m about a room whose lower left corner is the origin.
std::vector<ConvexPiece> room(double width, double height);
/// A room of 6 x 4 m with up to six boxes and discs drawn in it, some of which overlap; for a disc of 0.25 m.
DiscSpace drawnRoom(std::uint64_t seed, std::int64_t which);
/// A place in the room, drawn, where the disc has room.
Point drawnPlace(const DiscSpace& space, std::uint64_t seed, std::int64_t which, std::uint32_t part);

/// The length of a shortest way over a grid's points with straight ways to `reach` cells away, by Dijkstra; infinite:
/// none. The true one is no longer, but for what start and goal lie beside the grid.
double gridLength(const DiscSpace& space, const Point& start, const Point& goal, double cell, int reach);

}  // namespace mrose
