#include "debug/sensor_scans.h"

#include <algorithm>

#include "control/sensor_records.h"

namespace mrose {
namespace {

bool isScan(const RecordType& type) {
    return type == recordType<RangeEcho>() || type == recordType<InfraredEcho>() ||
           type == recordType<BumperContact>() || type == recordType<ColourPixel>();
}

SensorScan::Kind kindOf(const RecordType& type, const std::vector<SensorElement>& elements) {
    if (type == recordType<InfraredEcho>()) return SensorScan::Kind::infrared;
    if (type == recordType<BumperContact>()) return SensorScan::Kind::bumpers;
    if (type == recordType<ColourPixel>()) return SensorScan::Kind::lineCamera;
    return elements.empty() || elements.front().halfWidth == 0 ? SensorScan::Kind::laser : SensorScan::Kind::sonar;
}

}  // namespace

std::optional<SensorScan::Kind> scanKind(const Sensor& sensor) {
    for (const ReadingKind& kind : sensor.gives())
        if (isScan(*kind.type)) return kindOf(*kind.type, sensor.elements());
    return std::nullopt;
}

bool isScan(const NewestReading& known) { return isScan(*known.reading->type); }

std::vector<SensorScan> scansOf(const FieldFrame& frame, std::size_t robot) {
    std::vector<SensorScan> scans;
    for (const NewestReading& known : newestReadings(frame.moment(), robot)) {
        const Pose* const eye = isScan(known) ? frame.poseThen(robot, known.reading->measured) : nullptr;
        if (eye == nullptr) continue;
        SensorScan scan{SensorScan::Kind::laser, known, known.sensor->elements(), *eye};
        scan.kind = kindOf(*known.reading->type, scan.elements);
        if (scan.elements.size() == known.reading->count) scans.push_back(std::move(scan));
    }
    return scans;
}

}  // namespace mrose
