#pragma once

#include <QString>
#include <string>

#include "debug/opened_run.h"

namespace mrose::gui {

/// A real log that is laid over the run, as far as those who open files need it.
class LaidOverLog {
public:
    virtual ~LaidOverLog() = default;

    virtual void openLog(const std::string& place) = 0;
    virtual bool isOpen() const = 0;
    /// A run that was opened as such is shown: where it plays a log, that is laid over it.
    virtual void follow(const OpenedRun& run) = 0;
    /// Reads log and scenario again, where the run is one of the log's rollouts; false: it is none.
    virtual bool reload(const QString& why) = 0;
    /// Shows what another motion model makes of the same commands.
    virtual void addModel(const std::string& named) = 0;
};

}  // namespace mrose::gui
