#include "logs/log_reader.h"

#include "logs/mrclam_reader.h"

namespace mrose {

Expected<Log> readLog(const std::filesystem::path& source, const LogOptions& options) {
    std::error_code ignored;
    if (!std::filesystem::exists(source, ignored)) return fail(source.string(), "does not exist");
    if (isMrclamFolder(source)) return readMrclam(source, options);
    return fail(source.string(), "is no log of a known format");
}

}  // namespace mrose
