#include "sensing/horizon.h"

namespace mrose {
namespace {

/// visit(word, mask) for the bits from `first` to `last`, as long as it is true.
template <class Visit>
bool forBits(std::size_t first, std::size_t last, Visit visit) {
    constexpr std::uint64_t all = ~std::uint64_t{0};
    const std::uint64_t start = all << first % 64, end = all >> (63 - last % 64);
    std::size_t word = first / 64;
    if (word == last / 64) return visit(word, start & end);
    if (!visit(word, start)) return false;
    for (++word; word < last / 64; ++word)
        if (!visit(word, all)) return false;
    return visit(word, end);
}

}  // namespace

void Horizon::close(const Arc& arc) {
    const auto closeSlots = [&](double right, double left) {
        const double first = std::ceil((right + 2) * perTurn + 1e-6), end = std::floor((left + 2) * perTurn - 1e-6);
        if (!(first < end)) return;
        forBits(static_cast<std::size_t>(first), static_cast<std::size_t>(end) - 1,
                [&](std::size_t word, std::uint64_t mask) {
                    closed_[word] |= mask;
                    return true;
                });
    };
    if (arc.right <= arc.left) {
        closeSlots(arc.right, arc.left);
    } else {
        constexpr double rounding = 2e-6 / perTurn;
        closeSlots(arc.right, 2 + rounding);
        closeSlots(-2 - rounding, arc.left);
    }
}

bool Horizon::allClosed(std::size_t first, std::size_t last) const {
    return forBits(first, last, [&](std::size_t word, std::uint64_t mask) { return (~closed_[word] & mask) == 0; });
}

}  // namespace mrose
