#pragma once

#include <QObject>
#include <QString>
#include <QTimer>
#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <optional>

#include "session/awaited.h"
#include "session/job_queue.h"

namespace mrose::gui {

/// One piece of long work at a time beside window and session, named, with its progress.
class BackgroundWork final : public QObject {
    Q_OBJECT

public:
    /// False: it was ended before its end, and left nothing behind.
    using Outcome = Expected<bool>;
    /// Asks its progress now and then whether it is to go on.
    using Job = std::function<Outcome(const Progress&)>;
    using Done = std::function<void(const Outcome&)>;

    explicit BackgroundWork(QObject* parent = nullptr);
    ~BackgroundWork() override { cancelled_ = true; }

    /// `done` is called in the window's thread; what the job throws is its outcome's error. Error: something else is
    /// under way.
    Expected<void> start(const QString& what, Job job, Done done);
    bool cancel();  ///< false: nothing is under way
    bool busy() const { return running_; }
    /// Until nothing is under way; the window goes on meanwhile.
    void settle();
    /// Ends what is under way, and whatever is begun after it, and waits until that has left nothing behind; from any
    /// thread.
    void quit();

signals:
    void progress(const QString& what, double share);  ///< share 1: it has ended

private:
    QString what_;
    bool running_ = false;
    QTimer reporting_;
    std::atomic<double> share_ = 0;
    std::atomic<bool> cancelled_ = false, quit_ = false;
    std::atomic<bool> atWork_ = false;  ///< the job has not returned
    JobQueue queue_;
};

/// Asks in the window's thread from another one, and waits for the answer; nullopt where it is not to go on. The
/// question may be asked all the same then: it holds what it needs.
template <class Answer>
std::optional<Answer> askWindow(QObject& window, std::function<Answer()> question, const GoesOn& goesOn) {
    auto promise = std::make_shared<std::promise<Answer>>();
    auto answer = promise->get_future();
    const auto ask = [promise, question = std::move(question)] {
        try {
            promise->set_value(question());
        } catch (...) {
            promise->set_exception(std::current_exception());  // the work's, which waits for it
        }
    };
    QMetaObject::invokeMethod(&window, ask, Qt::QueuedConnection);
    return awaited(std::move(answer), goesOn);
}

}  // namespace mrose::gui
