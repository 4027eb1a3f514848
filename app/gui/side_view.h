#pragma once

#include <QWidget>

#include "session.h"
#include "widgets/field_view.h"

class QLabel;

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

private:
    void refresh();

    FieldView *field_, *beside_;
    QLabel *fieldName_, *besideName_;
    QWidget* besidePane_;
    bool sideBySide_ = false, hasBeside_ = false;
};

}  // namespace mrose::gui
