#pragma once

#include <cstddef>
#include <vector>

#include "planning/path.h"

namespace mrose {

/// The places that are as far as they can be from the pieces around them: the edges of the generalised Voronoi diagram of
/// the pieces' outlines, without those between sides of one piece (O'Dunlaing and Yap 1985). Circles stand in it as
/// octagons of the same area, and coordinates as whole tenths of a millimetre. The diagram is Boost.Polygon's. Start and
/// goal may differ from call to call: a roadmap serves many robots of one size.
class VoronoiRoadmap {
public:
    struct Node {
        Point place;
        double distance = 0;             ///< m, to the nearest piece
        std::vector<std::size_t> next;  ///< nodes to which a way leads, straight as good as
    };

    explicit VoronoiRoadmap(DiscSpace space);

    /// Of those where the disc has room.
    const std::vector<Node>& nodes() const { return nodes_; }
    /// The shortest way on the roadmap (A*), to which start and goal are joined by straight ways to nodes nearby.
    Path path(const Point& start, const Point& goal) const;

private:
    void makeNodes();
    std::size_t node(const Point& place);
    void join(std::size_t a, std::size_t b);
    std::vector<std::size_t> nearby(const Point& place) const;

    DiscSpace space_;
    std::vector<Node> nodes_;
};

/// The roadmap made for one way.
Path greatestClearancePath(const DiscSpace& space, const Point& start, const Point& goal);

}  // namespace mrose
