#pragma once

#include <QObject>
#include <QPointer>

#include "widgets/theme.h"

class QWidget;

namespace mrose::gui {

/// Shows which of a window's fields, lists, tools and timeline the keys go to: by a ring about it, and by the colour of
/// what is selected in it, which is quieter in all others.
class FocusRing final : public QObject {
    Q_OBJECT

public:
    explicit FocusRing(QWidget& window);

    void setTheme(const Theme& theme);
    /// About which widget it is now; nullptr: none.
    QWidget* shownAbout() const;

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    class Ring;
    void follow(QWidget* now);

    QWidget& window_;
    QPointer<QWidget> target_;
    QPointer<Ring> ring_;
    Theme theme_ = Theme::light();
};

}  // namespace mrose::gui
