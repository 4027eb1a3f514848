#pragma once

#include <QObject>
#include <QString>
#include <QTimer>

namespace mrose {
class MessageBar;
}

namespace mrose::gui {

class MainWindow;

/// Says what takes long, how far it is, and ends it where the user asks for that: opening a file, a job over the run,
/// the way to a tick. What is done at once is not told.
class WorkProgress final : public QObject {
    Q_OBJECT

public:
    WorkProgress(MainWindow& window, MessageBar& messages);

    /// Ends what takes long; otherwise dismisses the newest message.
    void cancel();

private:
    void work(const QString& what, double share);
    void show();

    MainWindow& window_;
    MessageBar& messages_;
    QString work_;
    double share_ = 0;
    QTimer patience_;
};

}  // namespace mrose::gui
