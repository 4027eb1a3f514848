#include "geometry/area.h"

#include <algorithm>

namespace mrose {

void Area::include(const Point& point, double reach) {
    const Point low = point - Point{reach, reach}, high = point + Point{reach, reach};
    if (empty()) {
        least = low;
        most = high;
        return;
    }
    least = {std::min(least.x, low.x), std::min(least.y, low.y)};
    most = {std::max(most.x, high.x), std::max(most.y, high.y)};
}

void Area::include(const Area& other) {
    if (other.empty()) return;
    include(other.least);
    include(other.most);
}

}  // namespace mrose
