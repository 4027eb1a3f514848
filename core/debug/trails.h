#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "geometry/point.h"

namespace mrose {

/// Where all bodies were in some ticks in a row, body by body. Filled from the front, each place once; readers know how
/// far it is filled, so that writing may go on meanwhile.
class TrailBlock {
public:
    static constexpr std::uint32_t capacity = 64;  ///< ticks
    struct Place {
        float x, y, heading;
        Point point() const { return {x, y}; }
    };

    explicit TrailBlock(std::size_t bodies) : bodies_(bodies), places_(bodies * capacity) {}
    std::size_t bodies() const { return bodies_; }
    std::size_t bytes() const { return places_.size() * sizeof(Place); }
    const Place& at(std::size_t body, std::uint32_t tick) const { return places_[body * capacity + tick]; }
    Place& at(std::size_t body, std::uint32_t tick) { return places_[body * capacity + tick]; }

private:
    std::size_t bodies_;
    std::vector<Place> places_;
};

/// The ways of all bodies up to a tick, oldest first. A value whose copies share their places.
struct Trails {
    struct Piece {
        std::shared_ptr<const TrailBlock> block;
        std::uint32_t from = 0, to = 0;  ///< ticks of the block, `to` not among them
        bool begins = false;  ///< no motion leads from the piece before to this one: something was changed between
    };
    std::vector<Piece> pieces;

    bool empty() const { return pieces.empty(); }
    std::size_t bodies() const { return empty() ? 0 : pieces.front().block->bodies(); }
    std::size_t ticks() const {
        std::size_t sum = 0;
        for (const Piece& piece : pieces) sum += piece.to - piece.from;
        return sum;
    }
    /// visit(point, begins) for each place of a body; `begins`: no line leads there.
    template <class Visit>
    void visit(std::size_t body, Visit visit) const {
        for (const Piece& piece : pieces)
            for (std::uint32_t i = piece.from; i < piece.to; ++i)
                visit(piece.block->at(body, i).point(), piece.begins && i == piece.from);
    }
};

}  // namespace mrose
