#include "shared/resources.h"

#include <cstdlib>

namespace mrose {
namespace {

bool holdsResources(const std::filesystem::path& folder) {
    std::error_code ignored;
    return std::filesystem::is_directory(folder / "shapes", ignored) &&
           std::filesystem::is_directory(folder / "resources" / "robots", ignored);
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
    return program.parent_path().parent_path() / "share" / "mrose";
}

DiskDescriptions openDescriptions(const std::string& log) {
    DiskDescriptions::Options options{resourceFolder(), {"."}, log};
    if (const char* const data = std::getenv("MROSE_DATA"); data != nullptr && *data != '\0') {
        options.logFolders.push_back(data);
        options.logFolders.push_back(std::filesystem::path(data) / "mrclam");
    }
    return DiskDescriptions(std::move(options));
}

}  // namespace mrose
