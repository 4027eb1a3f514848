#include "support/camera_folder.h"

#include <cmath>
#include <cstdio>

#include "geometry/point.h"
#include "io/file.h"
#include "perception/logged_view.h"
#include "world/noise.h"

namespace mrose {

CameraFolder::CameraFolder() : MrclamFolder(1) {
    constexpr int landmarks = 12;
    constexpr double begin = 1'248'444'187, speed = 0.07, turning = 0.1;
    const auto placeOf = [](int i) { return Point{1, -1} + (2 + 0.2 * (i % 4)) * towards(0.52 * i); };
    char row[100];
    std::string barcodes = "# Subject # Barcode #\n1 5\n", places = "# Subject # x y sx sy\n", seen = "# t s r b\n";
    for (int i = 0; i < landmarks; ++i) {
        std::snprintf(row, sizeof row, "%d %d\n", 6 + i, 60 + i);
        barcodes += row;
        std::snprintf(row, sizeof row, "%d %.5f %.5f 0.0001 0.0001\n", 6 + i, placeOf(i).x, placeOf(i).y);
        places += row;
    }
    for (int k = 2; 0.236 * k < 59; ++k) {
        const double t = 0.236 * k, measured = t - 0.04, heading = turning * measured, radius = speed / turning;
        const Point eye{1 + radius * std::sin(heading), -1 - radius * std::cos(heading)};
        for (int i = 0; i < landmarks; ++i) {
            const Point offset = placeOf(i) - eye;
            const double bearing = wrappedAngle(direction(offset) - heading);
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
