#pragma once

#include <QFileSystemWatcher>
#include <QObject>
#include <QTimer>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "session/job_queue.h"

namespace mrose::gui {

/// Notices when files get another content than they were read with: by being written to, by being replaced, as editors
/// do, also after they were gone for a while. A file that is only touched, or saved as it was, has not changed. Files
/// are read in a thread of its own.
class DescriptionWatch final : public QObject {
    Q_OBJECT

public:
    explicit DescriptionWatch(QObject* parent = nullptr);

    /// These files from now on, by their paths, with the hashes (contentHash()) of what was read from them. They may
    /// have been written since then: soon they are compared.
    /// Of `places` only that they disappear is reported: recordings grow.
    void watch(const std::map<std::string, std::string>& hashes, const std::vector<std::string>& places = {});
    /// Whether it is one of those whose content is watched, by whatever name.
    bool watches(const std::string& file) const;
    /// Compares without waiting; otherwise a little after the last change, when writing is done.
    void check();
    void settle() { looking_.settle(); }  ///< until that is done; for scripts and tests

signals:
    /// Each content is reported once.
    void changed(const std::vector<std::string>& files);
    /// They have not been there, or of `places` have been empty, for longer than saving takes to replace a file.
    void gone(const std::vector<std::string>& files);
    void back();                      ///< all of them, with whatever content
    void failed(const Error& error);  ///< looking at them

private:
    /// What a file with another content differs in, but for one that is written twice within a clock's tick.
    struct Stamp {
        std::uintmax_t size = 0;
        std::filesystem::file_time_type written;
        bool operator==(const Stamp&) const = default;
    };
    struct Content {
        std::string hash;            ///< empty: any will do
        std::optional<Stamp> stamp;  ///< nullopt: it is not known with which it was read
        int missed = 0;              ///< how often in a row it was not there
    };
    using Contents = std::map<std::string, Content>;
    static Contents contentsNow(const Contents& known, const GoesOn& goesOn);
    void take(const Contents& now);
    void reportGone();
    void watchPlaces();

    QFileSystemWatcher watcher_;
    QTimer settled_, missing_;
    Contents contents_;
    std::vector<std::string> gone_;  ///< as it was reported last
    JobQueue looking_;
};

}  // namespace mrose::gui
