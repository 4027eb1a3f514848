#include "io/made_folder.h"

#include <algorithm>

namespace mrose {

Expected<MadeFolder> MadeFolder::make(const std::filesystem::path& folder) {
    std::error_code error;
    MadeFolder result;
    std::filesystem::path missing = std::filesystem::absolute(folder, error).lexically_normal();
    for (; !missing.empty() && !std::filesystem::exists(missing, error); missing = missing.parent_path())
        if (missing.has_filename()) result.made_.push_back(missing);
    std::reverse(result.made_.begin(), result.made_.end());
    std::filesystem::create_directories(folder, error);
    if (!error && !std::filesystem::is_directory(folder, error) && !error)
        error = std::make_error_code(std::errc::not_a_directory);
    if (error) return fail(folder.string(), "cannot make the folder: " + error.message());
    return result;
}

MadeFolder::~MadeFolder() {
    std::error_code ignored;
    for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) std::filesystem::remove(*folder, ignored);
}

}  // namespace mrose
