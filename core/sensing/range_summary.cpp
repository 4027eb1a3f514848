#include "sensing/range_summary.h"

#include <cmath>
#include <limits>

namespace mrose {
namespace {

constexpr double noRange = std::numeric_limits<double>::infinity();

}  // namespace

std::vector<MemoryEntry> rangeSummary(std::span<const RangeEcho> echoes) {
    RangeEcho nearest{0, noRange};
    double count = 0;
    for (const RangeEcho& echo : echoes) {
        if (echo.range < nearest.range) nearest = echo;
        if (std::isfinite(echo.range)) ++count;
    }
    return {{"nearest", nearest.range, "m"}, {"nearest_bearing", nearest.bearing, "rad"}, {"echoes", count}};
}

std::vector<MemoryEntry> elementSummary(std::span<const RangeEcho> echoes, std::size_t elements) {
    std::vector<MemoryEntry> entries = rangeSummary(echoes);
    for (std::size_t i = 0; i < elements; ++i)
        entries.push_back({"range_" + std::to_string(i + 1), i < echoes.size() ? echoes[i].range : noRange, "m"});
    return entries;
}

std::vector<MemoryEntry> elementSummary(std::span<const InfraredEcho> echoes, std::size_t elements) {
    InfraredEcho strongest;
    for (const InfraredEcho& echo : echoes)
        if (echo.intensity > strongest.intensity) strongest = echo;
    std::vector<MemoryEntry> entries{{"strongest", strongest.intensity},
                                     {"strongest_bearing", strongest.bearing, "rad"}};
    for (std::size_t i = 0; i < elements; ++i)
        entries.push_back({"intensity_" + std::to_string(i + 1), i < echoes.size() ? echoes[i].intensity : 0});
    return entries;
}

}  // namespace mrose
