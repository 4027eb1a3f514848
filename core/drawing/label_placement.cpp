#include "drawing/label_placement.h"

#include <algorithm>
#include <limits>
#include <numbers>

namespace mrose {
namespace {

constexpr int directions = 16;
constexpr double gaps[] = {9, 16, 28};  // pixels
constexpr double spare = 3;             // pixels, between a label and what it avoids

PageBox wider(const PageBox& box, double by) { return {box.left - by, box.top - by, box.right + by, box.bottom + by}; }

bool within(const PageBox& box, const PageBox& frame) {
    return box.left >= frame.left && box.right <= frame.right && box.top >= frame.top && box.bottom <= frame.bottom;
}

}  // namespace

PageBox placeLabel(const Point& at, double width, double height, std::span<const Point> avoided,
                   std::span<const PageBox> taken, const PageBox& frame) {
    PageBox best;
    double least = std::numeric_limits<double>::infinity();
    for (const double gap : gaps)
        for (int i = 0; i < directions; ++i) {
            const Point side = Placement({0, 0, 2 * std::numbers::pi * i / directions}).rotate({1, 0});
            const Point middle = at + Point{side.x * (width / 2 + gap), side.y * (height / 2 + gap)};
            const PageBox box{middle.x - width / 2, middle.y - height / 2, middle.x + width / 2, middle.y + height / 2};
            const PageBox around = wider(box, spare);
            const auto covered =
                std::count_if(avoided.begin(), avoided.end(), [&](const Point& p) { return around.holds(p); });
            const bool labels =
                std::any_of(taken.begin(), taken.end(), [&](const PageBox& other) { return around.overlaps(other); });
            const double cost =
                static_cast<double>(covered) + 0.05 * gap + (labels ? 1e4 : 0) + (within(box, frame) ? 0 : 1e5);
            if (cost < least) {
                least = cost;
                best = box;
            }
        }
    return best;
}

}  // namespace mrose
