#pragma once

#include <QObject>
#include <functional>
#include <optional>

#include "frame/frame.h"
#include "session/job_queue.h"
#include "workflow/open_log.h"

namespace mrose::gui {

/// Opens logs, and rollouts of them, beside the window. The newest wish counts: what was asked for before it comes to
/// nothing.
class LogOpener final : public QObject {
    Q_OBJECT

public:
    explicit LogOpener(const Frame& frame);

    template <class Work, class Take>
    void open(Work work, Take take) {
        drop();
        queue_.run(std::move(work), std::move(take));
    }
    /// What takes longer than a moment is said, with a way to end it. To be called after open().
    void reportOpening(const std::string& place);
    void drop();
    bool busy() { return queue_.busy(); }
    void settle() { queue_.settle(); }

signals:
    void cancelled();

private:
    Frame frame_;
    JobQueue queue_;
    std::uint64_t openings_ = 0;  ///< begun and ended
};

}  // namespace mrose::gui
