#include "support/camera_folder.h"

#include <cmath>
#include <cstdio>

#include "geometry/point.h"
#include "io/file.h"
#include "world/noise.h"

namespace mrose {

CameraFolder::CameraFolder() : MrclamFolder(1) {
    constexpr int landmarks = 12;
    constexpr double begin = 1'248'444'187, speed = 0.07, turning = 0.1, end = 250, radius = speed / turning;
    const auto placeOf = [](int i) { return Point{1, -1} + (2 + 0.2 * (i % 4)) * towards(0.52 * i); };
    const auto robotAt = [&](double t) {
        return Pose{1 + radius * std::sin(turning * t), -1 - radius * std::cos(turning * t), turning * t};
    };
    char row[100];
    std::string barcodes = "# Subject # Barcode #\n1 5\n", places = "# Subject # x y sx sy\n", seen = "# t s r b\n";
    for (int i = 0; i < landmarks; ++i) {
        std::snprintf(row, sizeof row, "%d %d\n", 6 + i, 60 + i);
        barcodes += row;
        std::snprintf(row, sizeof row, "%d %.5f %.5f 0.0001 0.0001\n", 6 + i, placeOf(i).x, placeOf(i).y);
        places += row;
    }
    std::string driven = "# t x y heading\n";
    for (int i = 0; i <= static_cast<int>(25 * end); ++i) {
        const Pose pose = robotAt(0.04 * i);
        std::snprintf(row, sizeof row, "%.3f %.6f %.6f %.6f\n", begin + 0.04 * i, pose.x, pose.y, pose.heading);
        driven += row;
    }
    write(1, "Groundtruth", driven);
    for (int k = 2; 0.236 * k < end - 1; ++k) {
        const double t = 0.236 * k;
        const Pose eye = robotAt(t - 0.04);
        for (int i = 0; i < landmarks; ++i) {
            const Point offset = placeOf(i) - position(eye);
            const double bearing = wrapAngle(direction(offset) - eye.heading);
            const auto channel = static_cast<std::uint32_t>(i);
            if (std::abs(bearing) > 0.5 || uniformNoise({3, k, 0, channel}) > 0.8) continue;
            const NoisePair errors = normalPair({4, k, 0, channel});
            std::snprintf(row, sizeof row, "%.3f %d %.4f %.5f\n", begin + t, 60 + i,
                          length(offset) + 0.03 * errors.first, bearing + 0.01 * errors.second);
            seen += row;
        }
    }
    write(1, "Measurement", seen);
    if (!writeFileAtomically(path() + "/Barcodes.dat", barcodes) ||
        !writeFileAtomically(path() + "/Landmark_Groundtruth.dat", places))
        std::abort();
}

}  // namespace mrose
