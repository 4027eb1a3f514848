#pragma once

#include <cstddef>
#include <vector>

#include "planning/path.h"

namespace mrose {

/// The places that are as far as they can be from the pieces around them: the edges of the Voronoi diagram between
/// points of different pieces (O'Dunlaing and Yap 1985). The pieces stand in it as points along their outlines, at most
/// 0.36 m apart, or 0.72 m where other pieces are 1.2 m away, so that a node is nearly as far from two pieces; the
/// diagram is Boost.Polygon's. Start and goal may differ from call to call: a roadmap serves many robots of one size.
class VoronoiRoadmap {
public:
    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    struct Node {
        Point place;
        double distance = 0;      ///< m, to the nearest piece
        std::size_t ways = none;  ///< the first of those that lead away
    };

    /// A way from a node to another one, straight as good as.
    struct Way {
        std::size_t to = none;
        std::size_t next = none;  ///< of the ways from the same node
    };

    explicit VoronoiRoadmap(DiscSpace space);

    /// Of those where the disc has room.
    const std::vector<Node>& nodes() const { return nodes_; }
    /// The shortest way on the roadmap (A*), to which start and goal are joined by straight ways to nodes nearby.
    Path path(const Point& start, const Point& goal) const;

private:
    void makeNodes();
    std::size_t node(const Point& place, std::size_t onePiece, std::size_t otherPiece);
    bool joined(const Point& a, double distanceA, const Point& b, double distanceB) const;
    void join(std::size_t a, std::size_t b);
    std::vector<std::size_t> nearby(const Point& place) const;

    DiscSpace space_;
    Point low_, high_;  ///< corners of a box that holds all outlines
    std::vector<Node> nodes_;
    std::vector<Way> ways_;
};

}  // namespace mrose
