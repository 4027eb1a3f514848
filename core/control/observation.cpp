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
    notePlace(name, static_cast<std::uint32_t>(used_ - 1));
    dataSize_ += (count * type.size + 7) / 8 * 8;
    if (dataSize_ > data_.size()) data_.resize(std::max(dataSize_, 2 * data_.size()));
    return data_.data() + reading.first;
}

void Observation::notePlace(const ReadingName& name, std::uint32_t index) {
    const auto note = [&](Standard reading, const ReadingName& standard) {
        std::uint32_t& place = places_[static_cast<std::size_t>(reading)];
        if (name == standard && place == none) place = index;
    };
    note(Standard::self, selfReading);
    note(Standard::odometry, odometryReading);
    note(Standard::robots, robotsReading);
    note(Standard::objects, objectsReading);
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
