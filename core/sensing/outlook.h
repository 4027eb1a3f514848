#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scene/point_grid.h"
#include "sensing/horizon.h"

namespace mrose {

struct BodyMap;
struct SensorView;

/// The part of the plane that a sensor covers.
struct SightField {
    Point eye;
    Point rightEdge, leftEdge;  ///< directions
    bool allRound = true;       ///< there are no edges
    double range = 0;           ///< m; may be infinite
};

/// Looks outwards from a sensor, the nearest first, and no farther than it may see: what is met closes the directions
/// in which it hides everything. So it finds the bodies that may be seen, and for each of them what may hide it.
class Outlook {
public:
    /// `occlusion`: bodies hide what is behind them.
    void look(const SensorView& view, const BodyMap& map, const SightField& field, bool occlusion);

    struct Body {
        PointGrid::Entry entry;
        double away = 0, turn = 0;  ///< m; Horizon's
        Horizon::Arc core;          ///< where it hides all that is behind it; without extent: nowhere
    };
    /// At least all bodies that the sensor sees, in no order.
    std::span<const Body> found() const { return found_; }
    /// Whether hides(number) holds for a body, asked for at least all that lie on the line to one that was found.
    template <class Hides>
    bool anyBefore(const Body& body, Hides hides) const {
        for (std::uint32_t i = bundles_[bundleOf(Horizon::slotOf(body.turn))]; i != none; i = strands_[i].next)
            if (strands_[i].body != body.entry.number && hides(strands_[i].body)) return true;
        return false;
    }

private:
    static constexpr std::uint32_t none = ~0u;
    /// A body in one of the lists of bodies that meet a bundle of neighbouring slots.
    struct Strand {
        std::uint32_t body, next;
    };
    static constexpr std::size_t bundles = Horizon::slotCount / 16;
    static std::size_t bundleOf(std::size_t slot) { return slot / (Horizon::slotCount / bundles); }

    void bundle(std::uint32_t body, std::size_t first, std::size_t last);
    void meet(const PointGrid::Entry& entry);
    void settle(double limit);

    SightField field_;
    bool occlusion_ = false;
    double slack_ = 0;   ///< m, by which coordinates may be off
    double widest_ = 0;  ///< m, how far bodies reach that hide others
    std::span<const double> cores_;
    Horizon horizon_;
    PointGrid::Spreading spreading_;
    std::vector<Body> met_;  ///< those that do not close anything yet: what is nearer may still be met
    std::vector<Body> found_;
    std::array<std::uint32_t, bundles> bundles_{};  ///< by bundle, its first strand
    std::vector<Strand> strands_;
};

}  // namespace mrose
