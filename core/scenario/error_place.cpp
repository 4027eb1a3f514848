#include "scenario/error_place.h"

namespace mrose {

bool isWithin(const ScenarioValue& value, std::string key, const std::string& path) {
    const Value* const there = value.at(path);
    while (there != nullptr && value.at(key) != there) {
        const std::size_t dot = key.rfind('.');
        if (dot == std::string::npos) return false;
        key.resize(dot);
    }
    return there != nullptr;
}

}  // namespace mrose
