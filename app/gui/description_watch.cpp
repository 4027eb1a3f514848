#include "description_watch.h"

#include <filesystem>

#include "io/file.h"

namespace mrose::gui {
namespace {

/// Who saves may write in several steps.
constexpr int quietFor = 150;  // ms

}  // namespace

DescriptionWatch::DescriptionWatch(QObject* parent) : QObject(parent) {
    settled_.setSingleShot(true);
    settled_.setInterval(quietFor);
    connect(&settled_, &QTimer::timeout, this, &DescriptionWatch::check);
    const auto wait = [this] { settled_.start(); };
    connect(&watcher_, &QFileSystemWatcher::fileChanged, this, wait);
    connect(&watcher_, &QFileSystemWatcher::directoryChanged, this, wait);
}

void DescriptionWatch::watch(std::map<std::string, std::string> hashes) {
    hashes_ = std::move(hashes);
    if (const QStringList old = watcher_.files() + watcher_.directories(); !old.isEmpty()) watcher_.removePaths(old);
    watchPlaces();
}

/// The files, and their folders: a file that was replaced is another one, which the folder alone tells.
void DescriptionWatch::watchPlaces() {
    QStringList places;
    for (const auto& [file, hash] : hashes_) {
        std::error_code ignored;
        const std::filesystem::path path = std::filesystem::absolute(file, ignored);
        if (std::filesystem::exists(path, ignored)) places << QString::fromStdString(path.string());
        if (std::filesystem::exists(path.parent_path(), ignored))
            places << QString::fromStdString(path.parent_path().string());
    }
    places.removeDuplicates();
    for (const QString& watched : watcher_.files() + watcher_.directories()) places.removeAll(watched);
    if (!places.isEmpty()) watcher_.addPaths(places);
}

void DescriptionWatch::check() {
    std::vector<std::string> files;
    for (auto& [file, hash] : hashes_) {
        std::error_code ignored;
        if (!std::filesystem::is_regular_file(file, ignored)) continue;  // gone: perhaps about to be replaced
        const auto content = readFile(file);
        if (!content) continue;
        std::string now = contentHash(*content);
        if (now == hash) continue;
        hash = std::move(now);
        files.push_back(file);
    }
    watchPlaces();
    if (!files.empty()) emit changed(files);
}

}  // namespace mrose::gui
