#include "control/observation.h"

#include <algorithm>

namespace mrose {

void Observation::makeRoom() {
    if (used_ > readings_.size()) readings_.resize(2 * used_);
    if (dataSize_ > data_.size()) data_.resize(2 * dataSize_);
}

Observation::Place Observation::append(const ReadingName& name, const RecordType& type, Nanoseconds measured,
                                       std::size_t count) {
    const Place place{static_cast<std::uint32_t>(dataSize_), static_cast<std::uint32_t>(count), measured};
    ++used_;
    dataSize_ += (count * type.size + 7) / 8 * 8;
    if (used_ > readings_.size() || dataSize_ > data_.size()) makeRoom();
    readings_[used_ - 1] = {name, &type, measured, place.first, place.count};
    return place;
}

std::byte* Observation::add(const ReadingName& name, const RecordType& type, Nanoseconds measured, std::size_t count) {
    const Place place = append(name, type, measured, count);
    const Reading& reading = readings_[used_ - 1];
    if (isOf(reading, recordType<Pose>())) note<Pose>(name, place);
    if (isOf(reading, recordType<Velocity>())) note<Velocity>(name, place);
    if (isOf(reading, recordType<SeenBody>())) note<SeenBody>(name, place);
    return data_.data() + place.first;
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
