#pragma once

#include <QDialog>
#include <string>
#include <vector>

#include "debug/opened_run.h"

class QTableWidget;

namespace mrose::gui {

/// A run of a batch: how it is opened, and what became of it.
struct TrialRow {
    OpenRequest request;
    double end = 0;  ///< s: where it ended
    std::vector<std::string> cells;
};

/// The rows of a results.csv that `mrose batch` wrote. Scenario and log are looked for from here, then from the folders
/// that hold the results. Error: file and line of what is no such row.
struct TrialTable {
    std::vector<std::string> columns;  ///< of `cells`
    std::vector<TrialRow> rows;
};
Expected<TrialTable> readTrials(const std::string& path);

/// The runs of a batch in a list; one that is chosen is opened at the tick where it ended.
class TrialList final : public QDialog {
    Q_OBJECT

public:
    TrialList(const QString& path, TrialTable table, QWidget* parent);

signals:
    void chosen(const OpenRequest& request, double at);

private:
    void choose(int row);

    std::vector<TrialRow> rows_;
    QTableWidget* list_;
};

}  // namespace mrose::gui
