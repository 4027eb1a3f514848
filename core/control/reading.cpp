#include "control/reading.h"

namespace mrose {
namespace {

template <class Number>
double numberAt(const std::byte* place) {
    Number number;
    std::memcpy(&number, place, sizeof number);
    return static_cast<double>(number);
}

}  // namespace

double RecordField::numberIn(const std::byte* record, std::size_t i) const {
    const std::byte* const place = record + offset + i * sizeOf(kind);
    switch (kind) {
        case NumberKind::float64:
            return numberAt<double>(place);
        case NumberKind::float32:
            return numberAt<float>(place);
        case NumberKind::int64:
            return numberAt<std::int64_t>(place);
        case NumberKind::int32:
            return numberAt<std::int32_t>(place);
        case NumberKind::uint64:
            return numberAt<std::uint64_t>(place);
        case NumberKind::uint32:
            return numberAt<std::uint32_t>(place);
        case NumberKind::uint8:
            return numberAt<std::uint8_t>(place);
    }
    return 0;
}

}  // namespace mrose
