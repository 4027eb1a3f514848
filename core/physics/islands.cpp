#include "physics/islands.h"

#include <algorithm>
#include <numeric>

namespace mrose {

void Islands::separate(std::size_t bodies) {
    parent_.resize(bodies);
    std::iota(parent_.begin(), parent_.end(), 0);
    effort_.assign(bodies, 0);
}

std::uint32_t Islands::of(std::uint32_t body) {
    while (parent_[body] != body) body = parent_[body] = parent_[parent_[body]];
    return body;
}

void Islands::join(std::uint32_t a, std::uint32_t b) {
    const auto [least, other] = std::minmax({of(a), of(b)});
    if (least == other) return;
    parent_[other] = least;
    effort_[least] += effort_[other];
}

}  // namespace mrose
