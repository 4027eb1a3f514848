#include "control/observation.h"

#include <algorithm>

namespace mrose {

std::byte* Observation::add(const ReadingName& name, const RecordType& type, Nanoseconds measured, std::size_t count) {
    if (used_ == readings_.size()) readings_.emplace_back();
    Reading& reading = readings_[used_++];
    reading.name = name;
    reading.type = &type;
    reading.measured = measured;
    reading.first = static_cast<std::uint32_t>(dataSize_);
    reading.count = static_cast<std::uint32_t>(count);
    notePlace(reading);
    dataSize_ += (count * type.size + 7) / 8 * 8;
    if (dataSize_ > data_.size()) data_.resize(std::max(dataSize_, 2 * data_.size()));
    return data_.data() + reading.first;
}

void Observation::notePlace(const Reading& reading) {
    const auto note = [&](Place& place, const ReadingName& standard, const RecordType& type) {
        if (reading.name == standard && place.count == 0 && isOf(reading, type))
            place = {reading.first, reading.count, reading.measured};
    };
    note(self_, selfReading, recordType<Pose>());
    note(odometry_, odometryReading, recordType<Velocity>());
    note(robots_, robotsReading, recordType<SeenBody>());
    note(objects_, objectsReading, recordType<SeenBody>());
}

bool Observation::operator==(const Observation& other) const {
    const auto sameRecords = [&](const Reading& a, const Reading& b) {
        const std::byte *one = recordsOf(a), *two = other.recordsOf(b);
        for (std::uint32_t i = 0; i < a.count; ++i, one += a.type->size, two += a.type->size)
            for (const RecordField& f : a.type->fields)
                if (std::memcmp(one + f.offset, two + f.offset, f.count * sizeOf(f.kind)) != 0) return false;
        return true;
    };
    const auto same = [&](const Reading& a, const Reading& b) {
        return a.name == b.name && a.measured == b.measured && a.count == b.count && isOf(a, *b.type) &&
               sameRecords(a, b);
    };
    return robot == other.robot && manipulators == other.manipulators && time == other.time && noise == other.noise &&
           std::ranges::equal(readings(), other.readings(), same);
}

}  // namespace mrose
