#include "scenario/error_place.h"

namespace mrose {

namespace {

/// Whether `key`, or a key above it, leads from `content` to `there`.
bool leadsTo(const Value* there, const Value& content, std::string key) {
    while (content.at(key) != there) {
        const std::size_t dot = key.rfind('.');
        if (dot == std::string::npos) return false;
        key.resize(dot);
    }
    return true;
}

}  // namespace

bool isWithin(const ScenarioValue& value, const Error& error, const std::string& path) {
    const Value* const there = value.at(path);
    if (there == nullptr) return false;
    if (leadsTo(there, value.content(), error.key)) return true;
    // The keys of an error about a file on the way begin at that file.
    for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', dot + 1)) {
        const Value* const before = value.at(path.substr(0, dot));
        const DescriptionFile* const file = before != nullptr ? before->asFile() : nullptr;
        if (file != nullptr && leadsTo(there, file->content, error.key)) return true;
    }
    return false;
}

}  // namespace mrose
