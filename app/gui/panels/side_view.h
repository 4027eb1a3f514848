#pragma once

#include <QWidget>

#include "session/session.h"
#include "widgets/field_view.h"

class QBoxLayout;

namespace mrose {
class ElidingLabel;
}

namespace mrose::gui {

/// The field view, and when asked for, the branch beside in a second one that shows the same part of the field.
class SideView final : public QWidget {
    Q_OBJECT

public:
    explicit SideView(QWidget* parent = nullptr);

    FieldView& field() const { return *field_; }
    FieldView& beside() const { return *beside_; }
    /// Whether the branch beside is to be seen, where there is one.
    void setSideBySide(bool on);
    void setShown(const Shown& shown);
    void setTheme(const Theme& theme);

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void refresh();
    /// Beside or below one another: where both are larger.
    void arrange();

    FieldView *field_, *beside_;
    ElidingLabel *fieldName_, *besideName_;
    QWidget* besidePane_;
    QBoxLayout* panes_;
    bool sideBySide_ = false, hasBeside_ = false;
};

}  // namespace mrose::gui
