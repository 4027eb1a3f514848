#pragma once

#include <QObject>
#include <QTimer>
#include <functional>
#include <string>
#include <utility>

#include "frame/window_frame.h"
#include "session/job_queue.h"
#include "workflow/open_run.h"

namespace mrose::gui {

/// Opens runs and logs beside the window, which says what takes longer than a moment. The newest wish counts: one that
/// was asked for before it comes to nothing, whatever it would have given.
class OpeningQueue final : public QObject {
    Q_OBJECT

public:
    /// `topic` of what it says.
    OpeningQueue(const WindowFrame& frame, const QString& topic);

    /// `work` gets an OpenProgress and gives an Expected, which `take` gets in the window's thread unless something
    /// else is opened before, or it is cancelled.
    template <class Work, class Take>
    void open(const std::string& place, Work work, Take take) {
        begin(place);
        queue_.run([this, work = std::move(work)](const GoesOn& goesOn) { return work(progress(goesOn)); },
                   [this, take = std::move(take)](auto opened) {
                       end();
                       take(std::move(opened));
                   });
    }
    /// False: nothing was under way.
    bool cancel();
    bool busy() { return queue_.busy(); }
    /// Waits until what is under way is done and delivered; for scripts and tests.
    void settle() { queue_.settle(); }

signals:
    void ended();      ///< done, or no more wanted
    void cancelled();  ///< by the user

private:
    void begin(const std::string& place);
    void end();
    OpenProgress progress(const GoesOn& goesOn);
    void report();

    const WindowFrame& frame_;
    QString topic_;
    std::string reading_;
    QTimer patience_;
    JobQueue queue_;
};

}  // namespace mrose::gui
