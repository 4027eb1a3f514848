#include "frame/input_keys.h"

#include <QAbstractSpinBox>
#include <QApplication>
#include <QComboBox>
#include <QDockWidget>
#include <QDoubleSpinBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <QSpinBox>

namespace mrose::gui {
namespace {

/// Within a panel; an editor of a list's row is the list's.
bool isInput(const QWidget& widget) {
    bool inList = false, inPanel = false;
    for (const QWidget* at = &widget; at != nullptr; at = at->parentWidget()) {
        inList = inList || at->inherits("QAbstractItemView");
        inPanel = inPanel || qobject_cast<const QDockWidget*>(at) != nullptr;
    }
    const bool typed = qobject_cast<const QAbstractSpinBox*>(&widget) || qobject_cast<const QLineEdit*>(&widget) ||
                       qobject_cast<const QComboBox*>(&widget);
    return typed && inPanel && !inList;
}

QLineEdit* lineOf(QWidget* input) {
    if (auto* line = qobject_cast<QLineEdit*>(input)) return line;
    // The line of a spin box is its own only.
    return qobject_cast<QAbstractSpinBox*>(input) != nullptr ? input->findChild<QLineEdit*>() : nullptr;
}

}  // namespace

InputKeys::InputKeys(QWidget& window) : QObject(&window), window_(window) {
    connect(qApp, &QApplication::focusChanged, this, [this](QWidget*, QWidget* now) { follow(now); });
}

void InputKeys::follow(QWidget* now) {
    if (now == input_ || (now != nullptr && now->window() != &window_)) return;
    if (input_) {
        input_->removeEventFilter(this);
        disconnect(accepted_);
    }
    input_ = now != nullptr && isInput(*now) ? now : nullptr;
    if (!input_) return;
    const QLineEdit* line = lineOf(input_);
    before_ = line != nullptr ? line->text() : QString();
    input_->installEventFilter(this);
    if (line != nullptr) watchAccepted(line);
}

/// A number that is only typed emits no signal, where it does not track the keyboard.
void InputKeys::watchAccepted(const QLineEdit* line) {
    const auto keep = [this, line] { before_ = line->text(); };
    if (input_ == line) accepted_ = connect(line, &QLineEdit::returnPressed, this, keep);
    if (auto* box = qobject_cast<QDoubleSpinBox*>(input_); box != nullptr && !box->keyboardTracking())
        accepted_ = connect(box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, keep);
    if (auto* box = qobject_cast<QSpinBox*>(input_); box != nullptr && !box->keyboardTracking())
        accepted_ = connect(box, QOverload<int>::of(&QSpinBox::valueChanged), this, keep);
}

bool InputKeys::eventFilter(QObject* watched, QEvent* event) {
    const bool overrides = event->type() == QEvent::ShortcutOverride;
    if (watched != input_ || (!overrides && event->type() != QEvent::KeyPress)) return false;
    const auto* key = static_cast<QKeyEvent*>(event);
    const bool plain = (key->modifiers() & ~Qt::KeypadModifier) == Qt::NoModifier;
    if (plain && key->key() == Qt::Key_Space && qobject_cast<QAbstractSpinBox*>(input_)) {
        event->ignore();  // what is not taken is an action's
        return true;
    }
    // A list is gone through by letters and Home and End.
    if (overrides && plain && key->key() != Qt::Key_Escape && qobject_cast<QComboBox*>(input_)) event->accept();
    if (!plain || key->key() != Qt::Key_Escape) return false;
    event->accept();
    if (!overrides) takeBack();
    return true;
}

void InputKeys::takeBack() {
    if (QLineEdit* line = lineOf(input_)) line->setText(before_);
    emit takenBack(input_);
}

}  // namespace mrose::gui
