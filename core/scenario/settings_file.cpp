#include "scenario/settings_file.h"

#include <algorithm>
#include <utility>

#include "scenario/description_reader.h"

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

/// Whether an error about a scenario, or about a file that it names, is of what stands at a path of its value, or
/// within that.
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

}  // namespace

Expected<ScenarioValue> Settings::putInto(const ScenarioValue& value) const {
    ScenarioValue with = value;
    for (const auto& [path, setting] : set) {
        auto changed = with.with(path, setting);
        if (!changed) return tl::unexpected(about(path, setting, changed.error().cause));
        with = std::move(*changed);
    }
    return with;
}

Error Settings::about(const std::string& path, const Value& value, std::string cause) const {
    return {file, static_cast<int>(value.line), static_cast<int>(value.column), path, std::move(cause)};
}

Error Settings::placed(const Error& error, const ScenarioValue& with) const {
    const auto at = [&](const std::pair<std::string, Value>& one) { return isWithin(with, error, one.first); };
    const auto found = std::ranges::find_if(set, at);
    // Of robots of one file an error does not say which of them it is about.
    if (found == set.end() || std::find_if(found + 1, set.end(), at) != set.end()) return error;
    const auto& [path, setting] = *found;
    return about(path, setting, (error.key == path ? "" : error.key + ": ") + error.cause);
}

Expected<Settings> readSettings(const Value& content, const std::string& file) {
    TomlTable root = openDescription(content, file, DescriptionKind::settings);
    Settings settings{file, root.stringOr("name", ""), {}};
    TomlTable set = root.table("set");
    const Value* const named = root.has("set") ? root.value("set") : nullptr;
    if (named != nullptr && named->asTable() != nullptr)
        for (const auto& [path, value] : generalFirst(*named->asTable())) {
            set.value(path);
            for (const char* const own : {"seed", "duration_s", "name", "format", "version"})
                if (path == own) set.reject(path, "is nothing that settings may set");
            settings.set.emplace_back(path, value);
        }
    if (settings.set.empty()) root.reject("set", "expected at least one path with its value");
    if (root.has("evidence")) root.table("evidence");
    root.rejectUnknown();
    if (root.failed()) return tl::unexpected(root.error());
    return settings;
}

}  // namespace mrose
