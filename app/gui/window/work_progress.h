#pragma once

#include <QObject>
#include <QPointer>
#include <QString>
#include <QTimer>

#include "frame/frame.h"

class QProgressDialog;

namespace mrose::gui {

class BackgroundWork;
class Overlay;
class WindowFiles;

/// Says what takes long, how far it is, and ends it where the user asks for that: opening a file, a job over the run,
/// the way to a tick, what goes on in the background. What is done at once is not reported.
class WorkProgress final : public QObject {
    Q_OBJECT

public:
    WorkProgress(const Frame& frame, WindowFiles& files, BackgroundWork& background, Overlay& overlay);

    /// Progress of the next work in the background is reported outside of the window, which is in its pictures.
    void setApart(bool apart) { apart_ = apart; }

    /// Ends what takes long; otherwise dismisses the newest message.
    void cancel();

private:
    void work(const QString& what, double share);
    void show();
    void reportBackground(const QString& what, double share);

    Frame frame_;
    WindowFiles& files_;
    BackgroundWork& background_;
    Overlay& overlay_;
    QString work_;
    double share_ = 0;
    bool onItsWay_ = false;  ///< what is reported is the way to a tick
    QTimer patience_;
    bool apart_ = false;
    QPointer<QProgressDialog> dialog_;
};

}  // namespace mrose::gui
