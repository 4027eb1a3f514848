#include "export/frame_folder.h"

#include <QBuffer>
#include <QFile>
#include <algorithm>
#include <system_error>

#include "frame/actions.h"
#include "io/pending_file.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

constexpr std::size_t leastDigits = 4;
constexpr int mostTries = 100;

/// "frames/" and "frames" are the same folder.
std::filesystem::path plainPath(const std::filesystem::path& folder) {
    std::error_code ignored;
    const auto path = std::filesystem::absolute(folder, ignored).lexically_normal();
    return path.has_filename() ? path : path.parent_path();
}

}  // namespace

Expected<void> checkFrameFolder(const std::filesystem::path& folder) {
    std::error_code error;
    if (!std::filesystem::exists(folder, error)) return {};
    if (!std::filesystem::is_directory(folder, error))
        return fail(folder.string(), "is there already and no folder; expected another name");
    const bool empty = std::filesystem::is_empty(folder, error);
    if (error) return fail(folder.string(), "cannot be read: " + error.message());
    if (!empty) return fail(folder.string(), "is a folder with something in it; expected a new or an empty one");
    return {};
}

Expected<std::unique_ptr<FrameSink>> FrameFolder::begin(const std::filesystem::path& folder, std::size_t frames) {
    if (auto free = checkFrameFolder(folder); !free) return tl::unexpected(free.error());
    const std::filesystem::path path = plainPath(folder);
    auto parent = MadeFolder::make(path.parent_path());
    if (!parent) return tl::unexpected(parent.error());
    const std::size_t digits = std::max(leastDigits, std::to_string(frames - 1).size());
    std::unique_ptr<FrameFolder> made(new FrameFolder(path, std::move(*parent), digits));
    std::error_code error;
    for (int i = 0; i < mostTries && !error; ++i) {
        const std::filesystem::path part = nameBeside(path);
        if (!std::filesystem::create_directory(part, error)) continue;
        made->part_ = part;
        return std::unique_ptr<FrameSink>(std::move(made));
    }
    return fail(folder.string(), "cannot make the folder" + (error ? ": " + error.message() : ""));
}

FrameFolder::~FrameFolder() {
    std::error_code ignored;
    if (!part_.empty()) std::filesystem::remove_all(part_, ignored);
}

Expected<void> FrameFolder::add(const QImage& frame) {
    const std::string number = std::to_string(next_++);
    const std::string name = "frame_" + std::string(digits_ - std::min(digits_, number.size()), '0') + number + ".png";
    QByteArray bytes;
    QBuffer buffer(&bytes);
    buffer.open(QIODevice::WriteOnly);
    if (!frame.save(&buffer, "PNG")) return fail((folder_ / name).string(), "the picture could not be drawn");
    QFile file(qtText((part_ / name).string()));
    if (file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size() && file.flush()) return {};
    return fail((folder_ / name).string(), "cannot be written: " + file.errorString().toStdString());
}

Expected<bool> FrameFolder::finish() {
    std::error_code error;
    // An empty folder of that name gives way.
    std::filesystem::rename(part_, folder_, error);
    if (error) return fail(folder_.string(), "cannot be written: " + error.message());
    part_.clear();
    syncFolderOf(folder_);
    return true;
}

}  // namespace mrose::gui
