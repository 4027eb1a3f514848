#include "behaviour/coming_path.h"

#include <algorithm>
#include <cstring>

namespace mrose {

TimedPath ComingPath::timed(double sent, double rotation) const {
    std::vector<Point> way{place()};
    for (std::size_t i = 0; i < count; ++i) way.push_back({points[i][0], points[i][1]});
    return timedPath(way, {heading, std::max(0.01f, speed), rotation, sent}, {holdAt, holdFor});
}

std::optional<ComingPath> comingPath(const ReceivedMessage& message) {
    if (message.kind != ComingPath::kind || message.size != sizeof(ComingPath)) return std::nullopt;
    ComingPath path;
    std::memcpy(&path, message.bytes.data(), sizeof path);
    path.count = std::min<std::uint8_t>(path.count, ComingPath::most);
    return path;
}

}  // namespace mrose
