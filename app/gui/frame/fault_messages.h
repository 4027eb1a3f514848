#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

#include "debug/branch_record.h"

namespace mrose {
class MessageBar;
}

namespace mrose::gui {

class Session;

/// Says which robot's controller or model has failed, which plug-in keeps the run waiting, and what the session had to
/// give up.
class FaultMessages final : public QObject {
    Q_OBJECT

public:
    FaultMessages(Session& session, MessageBar& messages);

private:
    void showFaults();
    void lookForHang();

    Session& session_;
    MessageBar& messages_;
    std::vector<BranchRecord::FirstFault> reported_;
    QTimer look_;
    QElapsedTimer sinceShown_;
};

}  // namespace mrose::gui
