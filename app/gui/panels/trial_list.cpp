#include "panels/trial_list.h"

#include <QFileInfo>
#include <QHeaderView>
#include <QLabel>
#include <QTableWidget>
#include <QVBoxLayout>
#include <charconv>
#include <map>

#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

/// The columns that every batch begins with, of any version; how long the ball lay still, and those of its goals
/// follow.
constexpr std::size_t leadingColumns = 9;
constexpr const char* ballStill = "ball_still_s";

constexpr int columnGap = 18;  // pixels, beyond what a column needs

/// Leading columns, and goals.
std::vector<std::size_t> shownColumns(const std::vector<std::string>& titles) {
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < titles.size(); ++i)
        if (i < leadingColumns || titles[i] == ballStill || titles[i].starts_with("goals")) shown.push_back(i);
    return shown;
}

/// Numbers as a table needs them.
std::string shortened(const std::string& cell) {
    double number = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
    if (error != std::errc() || end != cell.data() + cell.size() || cell.find('.') == std::string::npos) return cell;
    return QString::number(number, 'f', 2).toStdString();
}

/// "driven_m" as a person reads it.
QString titleOf(const std::string& column) {
    static const std::map<std::string, const char*> titles{{"trial", "Trial"},
                                                           {"seed", "Seed"},
                                                           {"end", "Ended by"},
                                                           {"time_s", "Time (s)"},
                                                           {"touches", "Touches"},
                                                           {"kicks", "Kicks"},
                                                           {"hits", "Hits"},
                                                           {"faults", "Faults"},
                                                           {"driven_m", "Driven (m)"},
                                                           {ballStill, "Ball still (s)"},
                                                           {"unfamiliar", "Unfamiliar (share)"}};
    if (const auto known = titles.find(column); known != titles.end()) return QObject::tr(known->second);
    // "goals.left"; of earlier versions "goals left"
    constexpr std::string_view goals = "goals.";
    if (column.starts_with("goals") && column.size() > goals.size())
        return QObject::tr("Goals in %1").arg(qtText(column.substr(goals.size())));
    return qtText(column);
}

/// Numbers are ordered by their values.
class TrialCell final : public QTableWidgetItem {
public:
    explicit TrialCell(const std::string& text) : QTableWidgetItem(qtText(text)) {}
    bool operator<(const QTableWidgetItem& other) const override {
        bool mine = false, its = false;
        const double a = text().toDouble(&mine), b = other.text().toDouble(&its);
        return mine && its ? a < b : QTableWidgetItem::operator<(other);
    }
};

}  // namespace

TrialList::TrialList(const QString& path, TrialTable table, QWidget* parent)
    : QDialog(parent), rows_(std::move(table.rows)), list_(new QTableWidget) {
    setAttribute(Qt::WA_DeleteOnClose);
    setWindowTitle(tr("%1 \u2013 runs: %2").arg(QFileInfo(path).fileName()).arg(rows_.size()));
    auto* layout = new QVBoxLayout(this);
    auto* hint = new QLabel(tr("Choose a run to open it at the tick where it ended; a column's title sorts by it."));
    hint->setWordWrap(true);
    layout->addWidget(hint);
    layout->addWidget(list_, 1);
    list_->setAccessibleName(tr("Runs of the batch"));
    const std::vector<std::size_t> shown = shownColumns(table.columns);
    list_->setColumnCount(static_cast<int>(shown.size()));
    list_->setRowCount(static_cast<int>(rows_.size()));
    QStringList titles;
    for (const std::size_t column : shown) titles << titleOf(table.columns[column]);
    list_->setHorizontalHeaderLabels(titles);
    list_->setSelectionBehavior(QAbstractItemView::SelectRows);
    list_->setSelectionMode(QAbstractItemView::SingleSelection);
    list_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    list_->verticalHeader()->hide();
    for (int row = 0; row < list_->rowCount(); ++row)
        for (int column = 0; column < list_->columnCount(); ++column) {
            const TrialRow& trial = rows_[static_cast<std::size_t>(row)];
            auto* item = new TrialCell(shortened(trial.cells[shown[static_cast<std::size_t>(column)]]));
            item->setTextAlignment((column == 2 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
            item->setData(Qt::UserRole, row);
            list_->setItem(row, column, item);
        }
    list_->setSortingEnabled(true);
    list_->sortItems(0);
    list_->resizeColumnsToContents();
    for (int column = 0; column < list_->columnCount(); ++column)
        list_->setColumnWidth(column, list_->columnWidth(column) + columnGap);
    resize(list_->horizontalHeader()->length() + 64, 480);
    connect(list_, &QTableWidget::cellActivated, this, [this](int row, int) { choose(row); });
    connect(list_, &QTableWidget::cellDoubleClicked, this, [this](int row, int) { choose(row); });
}

void TrialList::choose(int row) {
    const TrialRow& trial = rows_[static_cast<std::size_t>(list_->item(row, 0)->data(Qt::UserRole).toInt())];
    emit chosen(trial.request, trial.end);
}

}  // namespace mrose::gui
