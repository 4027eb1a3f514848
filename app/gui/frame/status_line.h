#pragma once

#include <QLabel>
#include <QString>
#include <QTimer>
#include <cstdint>

#include "frame/quiet_message.h"
#include "widgets/eliding_label.h"

namespace mrose::gui {

class Actions;
class Session;

/// What is said of the shown tick, in the status bar and for some seconds over the field: what the run's debugger says
/// of it, and what anyone else says until another tick is shown, while it plays for those seconds, until it is done, or
/// for a while.
class StatusLine final : public ElidingLabel {
    Q_OBJECT

public:
    /// `over` is where it is said, too.
    StatusLine(Session& session, const Actions& actions, QWidget& over);

    void say(const QString& text);
    /// Asks the user for something: until done(), or for a while.
    void ask(const QString& text);
    void done();  ///< what was asked for
    const QString& said() const { return said_; }
    /// Stands in its place for as long as something is pointed at; empty: nothing is.
    void showTip(const QString& tip) { setText(tip.isEmpty() ? said_ : tip); }
    QuietMessage& quietMessage() { return quiet_; }

private:
    void follow();

    Session& session_;
    const Actions& actions_;
    QuietMessage& quiet_;
    std::int64_t saidAt_ = 0;  ///< the tick shown when something was said
    QString reported_;         ///< the debugger's last message
    QString said_;
    bool asked_ = false;
    QTimer end_;
};

}  // namespace mrose::gui
