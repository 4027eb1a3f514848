#include "files/description_watch.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "io/file.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

/// Who saves may write in several steps.
constexpr int quietFor = 150;  // ms
/// Who replaces a file may take it away first.
constexpr int replacedIn = 1000;  // ms
constexpr int missedOften = 2;
/// Of file systems: what was written within it may have been written twice.
constexpr auto coarsestClock = std::chrono::seconds(2);

}  // namespace

DescriptionWatch::DescriptionWatch(QObject* parent) : QObject(parent) {
    settled_.setSingleShot(true);
    settled_.setInterval(quietFor);
    missing_.setSingleShot(true);
    missing_.setInterval(replacedIn);
    for (QTimer* timer : {&settled_, &missing_}) connect(timer, &QTimer::timeout, this, &DescriptionWatch::check);
    const auto wait = [this] { settled_.start(); };
    connect(&watcher_, &QFileSystemWatcher::fileChanged, this, wait);
    connect(&watcher_, &QFileSystemWatcher::directoryChanged, this, wait);
}

void DescriptionWatch::watch(const std::map<std::string, std::string>& hashes, const std::vector<std::string>& places) {
    looking_.drop();
    missing_.stop();
    gone_.clear();
    Contents contents;
    for (const std::string& place : places) contents[place] = {};
    for (const auto& [file, hash] : hashes) {
        const auto known = contents_.find(file);
        const bool same = known != contents_.end() && known->second.hash == hash;
        contents[file] = {hash, same ? known->second.stamp : std::nullopt, 0};
    }
    contents_ = std::move(contents);
    if (const QStringList old = watcher_.files() + watcher_.directories(); !old.isEmpty()) watcher_.removePaths(old);
    watchPlaces();
    settled_.start();
}

bool DescriptionWatch::watches(const std::string& file) const {
    return std::any_of(contents_.begin(), contents_.end(), [&](const auto& watched) {
        std::error_code ignored;
        return !watched.second.hash.empty() && std::filesystem::equivalent(watched.first, file, ignored);
    });
}

/// The files, and their folders: a file that was replaced is another one, which only the folder shows.
void DescriptionWatch::watchPlaces() {
    QStringList places;
    for (const auto& [file, content] : contents_) {
        std::error_code ignored;
        const std::filesystem::path path = std::filesystem::absolute(file, ignored);
        if (std::filesystem::exists(path, ignored)) places << qtText(path.string());
        if (std::filesystem::exists(path.parent_path(), ignored)) places << qtText(path.parent_path().string());
    }
    places.removeDuplicates();
    for (const QString& watched : watcher_.files() + watcher_.directories()) places.removeAll(watched);
    if (!places.isEmpty()) watcher_.addPaths(places);
}

void DescriptionWatch::check() {
    if (looking_.busy()) return settled_.start();
    looking_.run([known = contents_](const GoesOn& goesOn) -> Expected<Contents> { return contentsNow(known, goesOn); },
                 [this](const Expected<Contents>& now) {
                     if (now)
                         take(*now);
                     else
                         emit failed(now.error());
                 });
}

/// Of those files that may have another content, and of those that are missed, or were.
DescriptionWatch::Contents DescriptionWatch::contentsNow(const Contents& known, const GoesOn& goesOn) {
    Contents now;
    for (const auto& [file, content] : known) {
        if (!goesOn()) break;
        std::error_code failed;
        const bool anyContent = content.hash.empty();
        const bool there = std::filesystem::is_regular_file(file, failed) &&
                           !(anyContent && std::filesystem::file_size(file, failed) == 0);
        if (!there || content.missed > 0) now[file] = {content.hash, content.stamp, there ? 0 : content.missed + 1};
        if (!there || anyContent) continue;
        const Stamp stamp{std::filesystem::file_size(file, failed), std::filesystem::last_write_time(file, failed)};
        if (failed || stamp == content.stamp) continue;
        const auto read = readFile(file);
        if (!read) continue;
        const bool old = std::filesystem::file_time_type::clock::now() - stamp.written > coarsestClock;
        now[file] = {contentHash(*read), old ? std::optional(stamp) : std::nullopt, 0};
    }
    return now;
}

void DescriptionWatch::take(const Contents& now) {
    std::vector<std::string> files;
    for (const auto& [file, content] : now) {
        Content& known = contents_.at(file);
        if (known.hash != content.hash) files.push_back(file);
        known = content;
    }
    watchPlaces();
    reportGone();
    if (!files.empty()) emit changed(files);
}

void DescriptionWatch::reportGone() {
    std::vector<std::string> files;
    bool missed = false;
    for (const auto& [file, content] : contents_) {
        if (content.missed >= missedOften) files.push_back(file);
        missed = missed || (content.missed > 0 && content.missed < missedOften);
    }
    if (missed) missing_.start();
    if (files == gone_) return;
    gone_ = std::move(files);
    if (gone_.empty())
        emit back();
    else
        emit gone(gone_);
}

}  // namespace mrose::gui
