#include "synthetic/field_landmarks.h"

#include <cmath>

#include "geometry/point.h"

namespace mrose {

const std::vector<LogSubject>& fieldLandmarks() {
    constexpr double length = syntheticFieldLength, width = syntheticFieldWidth, goal = 2, outside = 6;
    constexpr double left = (width + goal) / 2, right = (width - goal) / 2;
    const auto at = [](const char* name, double x, double y) {
        return LogSubject{.name = name, .position = Point{x, y}};
    };
    static const std::vector<LogSubject> all{at("corner 1", 0, 0),
                                             at("corner 2", length, 0),
                                             at("corner 3", length, width),
                                             at("corner 4", 0, width),
                                             at("own goal left", 0, left),
                                             at("own goal right", 0, right),
                                             at("goal left", length, left),
                                             at("goal right", length, right),
                                             at("middle 1", length / 2, 0),
                                             at("middle 2", length / 2, width),
                                             at("beacon 1", -outside, -outside),
                                             at("beacon 2", length + outside, -outside),
                                             at("beacon 3", length + outside, width + outside),
                                             at("beacon 4", -outside, width + outside)};
    return all;
}

std::vector<LandmarkInView> landmarksInView(const Pose& pose, double range, double fieldOfView) {
    std::vector<LandmarkInView> inView;
    const std::vector<LogSubject>& all = fieldLandmarks();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Point offset = *all[i].position - position(pose);
        const double bearing = wrapAngle(direction(offset) - pose.heading);
        if (length(offset) <= range && std::abs(bearing) <= fieldOfView / 2)
            inView.push_back({i, length(offset), bearing, offset});
    }
    return inView;
}

}  // namespace mrose
