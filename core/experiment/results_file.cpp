#include "experiment/results_file.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "io/file.h"

namespace mrose {
namespace {

/// Trial and seed that a row begins with.
std::optional<RunKey> keyOf(std::string_view row) {
    RunKey key;
    const char* const end = row.data() + row.size();
    const auto trial = std::from_chars(row.data(), end, key.trial);
    if (trial.ec != std::errc() || trial.ptr == end || *trial.ptr != ',') return std::nullopt;
    const auto seed = std::from_chars(trial.ptr + 1, end, key.seed);
    if (seed.ec != std::errc() || seed.ptr == end || *seed.ptr != ',') return std::nullopt;
    return key;
}

tl::unexpected<Error> systemError(const std::filesystem::path& path) {
    return fail(path.string(), std::strerror(errno));
}

Expected<void> writeAll(int descriptor, std::string_view text, const std::filesystem::path& path) {
    while (!text.empty()) {
        const ssize_t written = ::write(descriptor, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return systemError(path);
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    return {};
}

}  // namespace

ResultsFile::ResultsFile(ResultsFile&& other) noexcept
    : folder_(std::move(other.folder_)),
      header_(std::move(other.header_)),
      rows_(std::move(other.rows_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      lock_(std::exchange(other.lock_, -1)) {}

ResultsFile::~ResultsFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (lock_ >= 0) ::close(lock_);
}

Expected<ResultsFile> ResultsFile::open(const std::filesystem::path& folder, const std::string& identity,
                                        const std::string& header) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed) return fail(folder.string(), failed.message());
    ResultsFile file(folder, header);
    const std::filesystem::path batch = folder / "batch.txt";
    if (std::filesystem::exists(batch)) {
        const auto before = readFile(batch);
        if (!before) return tl::unexpected(before.error());
        if (*before != identity)
            return fail(folder.string(), "holds results of another batch; expected an empty folder, or the same batch");
    } else if (std::filesystem::exists(folder / "results.csv") || std::filesystem::exists(file.part())) {
        return fail(folder.string(), "holds results of no batch; expected an empty folder");
    } else if (const auto written = writeFileAtomically(batch, identity); !written) {
        return tl::unexpected(written.error());
    }
    file.lock_ = ::open(batch.c_str(), O_RDONLY | O_CLOEXEC);
    if (file.lock_ < 0) return systemError(batch);
    if (::flock(file.lock_, LOCK_EX | LOCK_NB) != 0)
        return fail(folder.string(), "another mrose batch is at work in it");
    for (const std::filesystem::path& path : {folder / "results.csv", file.part()})
        if (std::filesystem::exists(path))
            if (const auto read = file.readRows(path); !read) return tl::unexpected(read.error());
    // What a kill has cut off must not run into the next row.
    std::string kept;
    for (const auto& [key, row] : file.rows_) kept += row + '\n';
    if (const auto written = writeFileAtomically(file.part(), kept); !written) return tl::unexpected(written.error());
    file.descriptor_ = ::open(file.part().c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (file.descriptor_ < 0) return systemError(file.part());
    return file;
}

Expected<void> ResultsFile::readRows(const std::filesystem::path& path) {
    const auto text = readFile(path);
    if (!text) return tl::unexpected(text.error());
    for (std::string_view rest = *text; !rest.empty();) {
        const std::size_t end = rest.find('\n');
        if (end == std::string_view::npos) break;
        const std::string_view row = rest.substr(0, end);
        if (const auto key = keyOf(row)) rows_.emplace(*key, row);
        rest.remove_prefix(end + 1);
    }
    return {};
}

Expected<void> ResultsFile::add(const RunKey& key, const std::string& row) {
    const off_t end = ::lseek(descriptor_, 0, SEEK_END);
    auto written = writeAll(descriptor_, row + '\n', part());
    if (!written) {
        // A full disk may have taken a part of the row.
        if (end >= 0 && ::ftruncate(descriptor_, end) != 0) return systemError(part());
        return written;
    }
    rows_.emplace(key, row);
    return {};
}

Expected<void> ResultsFile::finish() {
    std::string text = header_ + '\n';
    for (const auto& [key, row] : rows_) text += row + '\n';
    if (const auto written = writeFileAtomically(folder_ / "results.csv", text); !written)
        return tl::unexpected(written.error());
    std::error_code ignored;
    std::filesystem::remove(part(), ignored);
    return {};
}

}  // namespace mrose
