#include "experiment/results_file.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "io/file.h"
#include "io/file_lock.h"
#include "io/pending_file.h"

namespace mrose {
namespace {

constexpr int mostTries = 100;

/// What a row begins with.
std::optional<RunKey> keyOf(std::string_view row, bool variants) {
    RunKey key;
    const char *at = row.data(), *const end = row.data() + row.size();
    const auto number = [&](auto& value) {
        const auto read = std::from_chars(at, end, value);
        if (read.ec != std::errc() || read.ptr == end || *read.ptr != ',') return false;
        at = read.ptr + 1;
        return true;
    };
    if (!number(key.trial) || !number(key.seed) || (variants && !number(key.variant))) return std::nullopt;
    return key;
}

/// Whether a third number stands behind trial and seed; a batch has a word there.
bool hasVariant(std::string_view row) { return keyOf(row, true).has_value(); }

tl::unexpected<Error> systemError(const std::filesystem::path& path) {
    return fail(path.string(), std::string("cannot be written: ") + std::strerror(errno));
}

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) out += c == '\n' ? std::string("\\n") : c == '\\' ? "\\\\" : std::string(1, c);
    return out;
}

std::string unescaped(std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool escape = text[i] == '\\' && i + 1 < text.size();
        if (escape) ++i;
        out += escape && text[i] == 'n' ? '\n' : text[i];
    }
    return out;
}

constexpr std::string_view lastLine = "end of this file\n";

/// A line for each: "name = value", and one that says that it is whole.
std::string identityText(const BatchIdentity& identity) {
    std::string text;
    for (const auto& [name, value] : identity) text += escaped(name) + " = " + escaped(value) + '\n';
    return text.append(lastLine);
}

BatchIdentity parseIdentity(std::string_view text) {
    constexpr std::string_view gap = " = ";
    BatchIdentity identity;
    if (text.ends_with(lastLine)) text.remove_suffix(lastLine.size());
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        // Names of files and values of options may hold the gap; neither hashes nor names of options do.
        const std::size_t middle =
            std::min(line.starts_with(contentOf) ? line.rfind(gap) : line.find(gap), line.size());
        identity.emplace(unescaped(line.substr(0, middle)),
                         unescaped(line.substr(std::min(middle + gap.size(), line.size()))));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return identity;
}

/// What differs first; "" for nothing.
std::string differenceOf(const BatchIdentity& before, const BatchIdentity& now) {
    const auto valueIn = [](const BatchIdentity& identity, const std::string& name) {
        const auto found = identity.find(name);
        return found == identity.end() ? std::string() : found->second;
    };
    // Another version may know its results by something else.
    const std::string version = "mrose", by = valueIn(before, version), own = valueIn(now, version);
    if (by != own && !by.empty() && !own.empty()) return "they were made by mrose " + by + ", and this is " + own;
    BatchIdentity all = now;
    all.insert(before.begin(), before.end());
    std::string ofContent;
    for (const auto& [name, value] : all) {
        const std::string then = valueIn(before, name), here = valueIn(now, name);
        if (then == here) continue;
        if (!name.starts_with(contentOf))
            return name + " was " + (then.empty() ? "not given" : then) + " and is " +
                   (here.empty() ? "not given" : here);
        // Of another scenario there are other files.
        const std::string what = name.substr(contentOf.size());
        if (!ofContent.empty()) continue;
        ofContent = then.empty()   ? "they were made without " + what
                    : here.empty() ? "they were made with " + what
                                   : "the " + name + " has changed";
    }
    return ofContent;
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

Expected<ResultsFile> ResultsFile::open(const std::filesystem::path& folder, const BatchIdentity& identity,
                                        const std::string& header) {
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    if (failed) return fail(folder.string(), failed.message());
    ResultsFile file(folder, header);
    // In this order: a batch that begins meanwhile has batch.txt before any results.
    const bool results = std::filesystem::exists(folder / "results.csv") || std::filesystem::exists(file.part());
    if (results && !std::filesystem::exists(file.batch()))
        return fail(folder.string(), "holds results of no batch and no experiment; expected an empty folder");
    if (const auto locked = file.lock(); !locked) return tl::unexpected(locked.error());
    for (const std::filesystem::path& path : {folder / "results.csv", file.part()})
        if (std::filesystem::exists(path))
            if (const auto read = file.readRows(path); !read) return tl::unexpected(read.error());
    if (const auto same = file.checkIdentity(identity); !same) return tl::unexpected(same.error());
    // What a kill has cut off must not run into the next row.
    std::string kept;
    for (const auto& [key, row] : file.rows_) kept += row + '\n';
    if (const auto written = writeFileAtomically(file.part(), kept); !written) return tl::unexpected(written.error());
    file.descriptor_ = ::open(file.part().c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (file.descriptor_ < 0) return systemError(file.part());
    return file;
}

Expected<void> ResultsFile::lock() {
    for (int i = 0; i < mostTries; ++i) {
        if (lock_ >= 0) ::close(lock_);
        lock_ = ::open(batch().c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (lock_ < 0) return systemError(batch());
        if (!lockForWriting(lock_)) return fail(folder_.string(), "another mrose is at work in it");
        // Who could not write what it made has removed it.
        if (isFileAt(lock_, batch())) return {};
    }
    return fail(batch().string(), "cannot be locked: it is another file each time");
}

/// A folder without a row yet may become another batch's.
Expected<void> ResultsFile::checkIdentity(const BatchIdentity& identity) {
    const auto before = readFile(batch());
    if (!before) return tl::unexpected(before.error());
    const BatchIdentity known = parseIdentity(*before);
    const bool whole = before->ends_with(lastLine);
    const std::string other = differenceOf(known, identity);
    if (other.empty() && (whole || known == identity)) return {};
    if (!rows_.empty() && !whole)
        return fail(batch().string(),
                    "is damaged and does not say any more whose results lie beside it; expected an empty folder");
    if (!rows_.empty())
        return fail(folder_.string(),
                    "holds other results: " + other + "; expected an empty folder, or the same batch or experiment");
    return writeIdentity(identity);
}

/// In its place: the lock is the file's. What a kill cuts off belongs to no row.
Expected<void> ResultsFile::writeIdentity(const BatchIdentity& identity) const {
    Expected<void> written;
    if (::ftruncate(lock_, 0) != 0 || ::lseek(lock_, 0, SEEK_SET) != 0) written = systemError(batch());
    if (written) written = writeAll(lock_, identityText(identity), batch());
    if (written && ::fsync(lock_) != 0) written = systemError(batch());
    if (written)
        syncFolderOf(batch());
    else
        ::unlink(batch().c_str());
    return written;
}

Expected<void> ResultsFile::readRows(const std::filesystem::path& path) {
    const auto text = readFile(path);
    if (!text) return tl::unexpected(text.error());
    const bool variants = header_.starts_with("trial,seed,variant,");
    const char* const others = variants ? "a batch" : "an experiment";
    for (std::string_view rest = *text; !rest.empty();) {
        const std::size_t end = rest.find('\n');
        if (end == std::string_view::npos) break;
        const std::string_view row = rest.substr(0, end);
        const bool header = row.starts_with("trial,seed,");
        const auto key = keyOf(row, variants);
        if (header ? variants != row.starts_with("trial,seed,variant,") : !key || hasVariant(row) != variants)
            return fail(folder_.string(), std::string("holds results of ") + others + "; expected an empty folder");
        if (key) rows_.emplace(*key, row);
        rest.remove_prefix(end + 1);
    }
    return {};
}

Expected<void> ResultsFile::checkAsked(const std::function<bool(const RunKey&)>& asked, const std::string& take) const {
    for (const auto& [key, row] : rows_)
        if (!asked(key))
            return fail(folder_.string(), "holds a run of trial " + std::to_string(key.trial) + " with seed " +
                                              std::to_string(key.seed) +
                                              ", which was not asked for now; expected another folder, or " + take +
                                              " that take in what is there");
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
