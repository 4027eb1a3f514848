#pragma once

#include <QLabel>
#include <QTimer>

#include "widgets/theme.h"

namespace mrose::gui {

/// A line over the lower edge of a view, for some seconds: what the status bar says, where one looks. It takes no
/// mouse.
class QuietMessage final : public QLabel {
    Q_OBJECT

public:
    explicit QuietMessage(QWidget& over);

    void say(const QString& words);
    void setTheme(const Theme& theme);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void place();

    QTimer end_;
};

}  // namespace mrose::gui
