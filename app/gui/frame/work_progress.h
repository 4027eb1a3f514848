#pragma once

#include <QObject>
#include <QPointer>
#include <QString>
#include <QTimer>
#include <functional>

#include "frame/window_frame.h"

class QProgressDialog;

namespace mrose::gui {

class BackgroundWork;

/// Says what takes long, how far it is, and ends it where the user asks for that: opening a file, a job over the run,
/// the way to a tick, what goes on in the background. What is done at once is not reported.
class WorkProgress final : public QObject {
    Q_OBJECT

public:
    WorkProgress(const WindowFrame& frame, BackgroundWork& background);
    /// How to end what the session knows nothing of: what is being opened, and what is looked for in other runs. Each
    /// says whether there was something.
    using End = std::function<bool()>;
    void setEnds(End opening, End search) {
        endOpening_ = std::move(opening);
        endSearch_ = std::move(search);
    }
    void report(const QString& what, double share);  ///< 1: it has ended

    /// Progress of the next work in the background is reported outside of the window, which is in its pictures.
    void setApart(bool apart) { apart_ = apart; }

    /// Ends what takes long; otherwise dismisses the newest message.
    void cancel();

private:
    void work(const QString& what, double share);
    void show();
    void reportBackground(const QString& what, double share);

    const WindowFrame& frame_;
    BackgroundWork& background_;
    End endOpening_ = [] { return false; }, endSearch_ = endOpening_;
    QString work_;
    double share_ = 0;
    bool onItsWay_ = false;  ///< what is reported is the way to a tick
    QTimer patience_;
    bool apart_ = false;
    QPointer<QProgressDialog> dialog_;
};

}  // namespace mrose::gui
