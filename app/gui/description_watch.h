#pragma once

#include <QFileSystemWatcher>
#include <QObject>
#include <QTimer>
#include <map>
#include <string>
#include <vector>

namespace mrose::gui {

/// Tells when files get another content than they were read with: by being written to, by being replaced, as editors
/// do, also after they were gone for a while. Who only touches a file, or saves it as it was, changes nothing.
class DescriptionWatch final : public QObject {
    Q_OBJECT

public:
    explicit DescriptionWatch(QObject* parent = nullptr);

    /// These files from now on, by their paths, with the hashes (contentHash()) of what was read from them.
    void watch(std::map<std::string, std::string> hashes);
    /// Compares now; otherwise a little after the last change, when who writes is done.
    void check();

signals:
    /// Each content is told once.
    void changed(const std::vector<std::string>& files);

private:
    void watchPlaces();

    QFileSystemWatcher watcher_;
    QTimer settled_;
    std::map<std::string, std::string> hashes_;
};

}  // namespace mrose::gui
