#pragma once

#include <QFileDialog>

namespace mrose::gui {

/// Asks for a file, or for a folder that is a log: one that is entered, or typed, is taken as it is.
class LogDialog final : public QFileDialog {
    Q_OBJECT

public:
    LogDialog(QWidget* parent, const QString& title, const QString& folder, const QString& kinds);

    QString ask();  ///< blocks; empty: the user cancelled
    const QString& chosen() const { return chosen_; }

protected:
    void accept() override;

private:
    bool take(const QString& folder);

    QString chosen_;
};

}  // namespace mrose::gui
