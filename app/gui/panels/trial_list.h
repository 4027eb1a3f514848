#pragma once

#include <QDialog>
#include <vector>

#include "workflow/read_trials.h"

class QTableWidget;

namespace mrose::gui {

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
