#pragma once

#include <QDialog>
#include <functional>
#include <vector>

#include "export/exports.h"
#include "io/error.h"

class QCheckBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QPushButton;

namespace mrose::gui {

/// Some files and a folder for a report on them. It stays open beside the window until the report is begun.
class ReportDialog final : public QDialog {
    Q_OBJECT

public:
    ReportDialog(const Exports& exports, const QString& title, const QString& about);

    /// A row in which a path is written or chosen. Its name is for those who look for its line.
    enum class Kind { file, log, folder };
    QLineEdit* addPath(const QString& name, const QString& label, Kind kind, const QString& kinds, const QString& tip);
    QLineEdit* addWords(const QString& name, const QString& label, const QString& tip);
    /// A row of short lines for numbers, each with what no number means and what follows it.
    struct NumberLine {
        QString name, nothing, after, tip;
    };
    void addNumbers(const QString& label, const std::vector<NumberLine>& lines);
    bool replaces() const;
    /// What the button does; what is wrong is said in the dialogue.
    void setAction(std::function<Expected<void>()> run) { run_ = std::move(run); }
    void start();

private:
    void choose(QLineEdit* line, Kind kind, const QString& kinds);

    const Exports& exports_;
    QFormLayout* form_;
    QCheckBox* replace_;
    QLabel* error_;
    QPushButton* start_;
    std::function<Expected<void>()> run_;
};

ReportDialog* showReportDialog(const Exports& exports);
ReportDialog* showComparisonDialog(const Exports& exports);

}  // namespace mrose::gui
