#include "scenario/description_source.h"

#include "io/file.h"
#include "io/format.h"
#include "logs/log_reader.h"
#include "scenario/log_excerpt.h"

namespace mrose {
namespace {

bool isShipped(std::string_view name) { return name.starts_with(shippedPrefix); }

std::string normal(const std::filesystem::path& path) { return path.lexically_normal().generic_string(); }

}  // namespace

std::string LogExcerpt::name() const {
    std::string text = log + "#robot=" + robot;
    if (!trajectory.empty()) text += ",trajectory=" + trajectory;
    text += ",start_s=" + numberText(start);
    if (drive) text += ",wheel_radius_m=" + numberText(drive->wheelRadius) + ",track_m=" + numberText(drive->track);
    return text;
}

std::string joinedName(const std::string& from, const std::string& reference) {
    const std::filesystem::path path(reference);
    if (path.is_absolute() || isShipped(reference)) return reference;
    if (isShipped(from)) {
        const std::filesystem::path inner(from.substr(shippedPrefix.size()));
        return std::string(shippedPrefix) + normal(inner.parent_path() / path);
    }
    return normal(std::filesystem::path(from).parent_path() / path);
}

std::string DiskDescriptions::shown(const std::string& name) const {
    if (!isShipped(name)) return name;
    return (options_.resources / name.substr(shippedPrefix.size())).string();
}

Expected<std::optional<std::string>> DiskDescriptions::text(const std::string& name) {
    const std::filesystem::path path = shown(name);
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return std::nullopt;
    auto content = readFile(path);
    if (!content) return tl::unexpected(content.error());
    hashes_[path.string()] = contentHash(*content);
    return std::move(*content);
}

Expected<const Log*> DiskDescriptions::logAt(const std::filesystem::path& path, const DifferentialDrive& drive) {
    const std::tuple key(path, drive.wheelRadius, drive.track);
    if (const auto found = logs_.find(key); found != logs_.end()) return &found->second;
    LogOptions options;
    options.drive = drive;
    auto log = readLog(path, options);
    if (!log) return tl::unexpected(log.error());
    for (const LogFile& file : log->files) hashes_[file.path] = file.hash;
    return &logs_.emplace(key, std::move(*log)).first->second;
}

std::optional<std::filesystem::path> DiskDescriptions::logPlace(const LogExcerpt& excerpt) const {
    if (!options_.log.empty()) return options_.log;
    std::vector<std::filesystem::path> places{shown(excerpt.log)};
    for (const std::filesystem::path& folder : options_.logFolders) places.push_back(folder / excerpt.reference);
    std::error_code ignored;
    for (const std::filesystem::path& place : places)
        if (std::filesystem::exists(place, ignored)) return place;
    return {};
}

Expected<std::optional<ExcerptContent>> DiskDescriptions::excerpt(const LogExcerpt& excerpt) {
    const auto place = logPlace(excerpt);
    if (!place) return std::nullopt;
    const auto found = logAt(*place, excerpt.drive.value_or(DifferentialDrive{}));
    if (!found) return tl::unexpected(found.error());
    auto content = excerptOf(**found, excerpt);
    if (!content) return tl::unexpected(content.error());
    return std::move(*content);
}

Expected<std::optional<std::string>> KeptDescriptions::text(const std::string& name) {
    const auto found = texts_.find(name);
    if (found == texts_.end()) return std::nullopt;
    return found->second;
}

Expected<std::optional<ExcerptContent>> KeptDescriptions::excerpt(const LogExcerpt& excerpt) {
    const auto found = texts_.find(excerpt.name());
    if (found == texts_.end()) return std::nullopt;
    auto content = parseExcerpt(found->second, found->first);
    if (!content) return tl::unexpected(content.error());
    return std::move(*content);
}

}  // namespace mrose
