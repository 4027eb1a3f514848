#include "panels/log_dialog.h"

#include <QDir>
#include <QLineEdit>

#include "logs/log_reader.h"

namespace mrose::gui {
namespace {

/// A folder of MRCLAM is one log; one with tables may hold several, of which one is wanted.
bool isOneLog(const QString& folder) { return !QDir(folder).entryList({"*_Odometry.dat"}, QDir::Files).isEmpty(); }

}  // namespace

LogDialog::LogDialog(QWidget* parent, const QString& title, const QString& folder, const QString& kinds)
    : QFileDialog(parent, title, folder, kinds) {
    setFileMode(QFileDialog::ExistingFile);
    setOption(QFileDialog::DontUseNativeDialog);  // it would not take folders
    connect(this, &QFileDialog::directoryEntered, this, [this](const QString& entered) {
        if (isOneLog(entered)) take(entered);
    });
}

bool LogDialog::take(const QString& folder) {
    if (!looksLikeLog(folder.toStdString())) return false;
    chosen_ = QDir(folder).absolutePath();
    done(Accepted);
    return true;
}

void LogDialog::accept() {
    const QString typed = findChild<QLineEdit*>("fileNameEdit")->text();
    const QFileInfo named(directory().absoluteFilePath(typed));
    // Where nothing is named, the folder that is shown is meant.
    if (typed.isEmpty() && take(directory().path())) return;
    if (!typed.isEmpty() && named.isDir() && isOneLog(named.filePath()) && take(named.filePath())) return;
    QFileDialog::accept();
    if (result() == QDialog::Accepted && chosen_.isEmpty() && !selectedFiles().isEmpty())
        chosen_ = selectedFiles().first();
}

QString LogDialog::ask() { return exec() == QDialog::Accepted ? chosen_ : QString(); }

}  // namespace mrose::gui
