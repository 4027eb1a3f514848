#pragma once

#include <QObject>
#include <QTimer>
#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "debug/open_run.h"

namespace mrose::gui {

/// Opens runs in threads of their own, so that the window goes on meanwhile. One that is asked for later takes the
/// place of an earlier one, whatever that would have given.
class RunOpener final : public QObject {
    Q_OBJECT

public:
    using Done = std::function<void(Expected<OpenRun>)>;

    explicit RunOpener(QObject* parent = nullptr);
    ~RunOpener() override;

    /// `done` is called in the window's thread, unless something else is opened before, or it is cancelled.
    void open(const OpenRequest& request, Done done);
    /// False: nothing was under way.
    bool cancel();
    bool busy() const { return job_ != nullptr; }
    /// Waits until what is under way is done and delivered; for scripts and tests.
    void settle();

signals:
    /// It takes long enough to be reported: what is read now.
    void progress(const QString& what);
    /// Done, or no more wanted.
    void ended();

private:
    struct Job;
    void work(Job& job);
    void deliver();
    void abandon();
    void joinDone();

    std::mutex mutex_;
    std::condition_variable done_;
    std::shared_ptr<Job> job_;
    std::vector<std::shared_ptr<Job>> abandoned_;
    QTimer progress_;
};

}  // namespace mrose::gui
