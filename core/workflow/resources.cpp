#include "workflow/resources.h"

#include <cstdlib>

#include "logs/log_reader.h"

namespace mrose {
namespace {

bool holdsResources(const std::filesystem::path& folder) {
    std::error_code ignored;
    return std::filesystem::is_directory(folder / "shapes", ignored) &&
           std::filesystem::is_directory(folder / "resources" / "robots", ignored);
}

/// Where logs are looked for beside the current folder.
std::vector<std::filesystem::path> dataFolders() {
    const char* const data = std::getenv("MROSE_DATA");
    if (data == nullptr || *data == '\0') return {};
    return {data, std::filesystem::path(data) / "mrclam", std::filesystem::path(data) / "drive"};
}

}  // namespace

std::filesystem::path resourceFolder() {
    if (const char* const named = std::getenv("MROSE_RESOURCES"); named != nullptr && *named != '\0') return named;
    std::error_code ignored;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored);
    for (std::filesystem::path folder = program.parent_path(); folder.has_relative_path();
         folder = folder.parent_path())
        for (const std::filesystem::path& candidate : {folder / "share" / "mrose", folder})
            if (holdsResources(candidate)) return candidate;
    if (holdsResources(MROSE_SOURCE_DIR)) return MROSE_SOURCE_DIR;
    return program.parent_path().parent_path() / "share" / "mrose";
}

Expected<RobotKinds> robotKinds() { return readRobotKinds(resourceFolder() / "resources" / "robots"); }

std::string placeOfLog(const std::string& name) {
    std::error_code ignored;
    if (name.empty() || std::filesystem::exists(name, ignored)) return logOfFile(name).string();
    for (const std::filesystem::path& folder : dataFolders())
        if (std::filesystem::exists(folder / name, ignored)) return (folder / name).string();
    return name;
}

Expected<std::string> existingLog(const std::string& name) {
    std::error_code ignored;
    const std::string place = placeOfLog(name);
    if (std::filesystem::exists(place, ignored)) return place;
    std::string sought;
    if (!std::filesystem::path(name).is_absolute()) {
        for (const std::filesystem::path& folder : dataFolders())
            sought += (sought.empty() ? ", nor in the folders of MROSE_DATA: " : ", ") + folder.string();
        if (sought.empty()) sought = " here; MROSE_DATA, which would name another folder to look in, is not set";
    }
    return fail(name, "does not exist" + sought);
}

std::string placeOfNetwork(const std::string& name) {
    std::error_code ignored;
    const std::filesystem::path shipped = resourceFolder() / "nets" / name;
    return !std::filesystem::exists(name, ignored) && std::filesystem::exists(shipped, ignored) ? shipped.string()
                                                                                                : name;
}

Expected<void> checkRobotFile(const std::string& name) {
    DiskDescriptions source = openDescriptions();
    const std::string shipped = joinedName(std::string(shippedPrefix) + "resources/robots/", name);
    for (const std::string& place : {name, shipped}) {
        const auto text = source.text(place);
        if (!text) return tl::unexpected(text.error());
        if (*text) return {};
    }
    return fail("--robot " + name, "does not exist" + (shipped == name ? "" : ", nor does " + source.shown(shipped)) +
                                       "; expected a robot file, or the name of one that ships");
}

DiskDescriptions openDescriptions(const std::string& log) {
    DiskDescriptions::Options options{resourceFolder(), {"."}, placeOfLog(log)};
    for (const std::filesystem::path& folder : dataFolders()) options.logFolders.push_back(folder);
    return DiskDescriptions(std::move(options));
}

}  // namespace mrose
