#pragma once

#include <QObject>
#include <QPointer>
#include <QString>

class QKeyEvent;
class QLineEdit;
class QWidget;

namespace mrose::gui {

/// Keys while something is typed in a panel: Escape takes back what is not accepted yet, and keys go to the field
/// again. In a number Space is no letter, and so plays.
class InputKeys final : public QObject {
    Q_OBJECT

public:
    explicit InputKeys(QWidget& window);

signals:
    void takenBack(QWidget* input);  ///< what was typed there is no more

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void follow(QWidget* now);
    void watchAccepted(const QLineEdit* line);
    void takeBack();

    QWidget& window_;
    QPointer<QWidget> input_;
    QMetaObject::Connection accepted_;
    QString before_;  ///< what stood there when the keys came to it, or was accepted since
};

}  // namespace mrose::gui
