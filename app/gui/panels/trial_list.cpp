#include "panels/trial_list.h"

#include <QFileInfo>
#include <QHeaderView>
#include <QLabel>
#include <QTableWidget>
#include <QVBoxLayout>
#include <charconv>
#include <filesystem>
#include <map>

#include "experiment/results_row.h"
#include "io/file.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

/// The columns that every batch begins with; those of its goals follow. Where the end stands.
constexpr std::size_t leadingColumns = 9, endColumn = 3;
constexpr const char* firstColumns = "trial,seed,end,time_s,touches,kicks,hits,faults,driven_m";

constexpr int columnGap = 18;  // pixels, beyond what a column needs

/// Leading columns, and goals.
std::vector<std::size_t> shownColumns(const std::vector<std::string>& titles) {
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < titles.size(); ++i)
        if (i < leadingColumns || titles[i].starts_with("goals")) shown.push_back(i);
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
    static const std::map<std::string, const char*> titles{
        {"trial", "Trial"}, {"seed", "Seed"}, {"end", "Ended by"},  {"time_s", "Time (s)"},    {"touches", "Touches"},
        {"kicks", "Kicks"}, {"hits", "Hits"}, {"faults", "Faults"}, {"driven_m", "Driven (m)"}};
    if (const auto known = titles.find(column); known != titles.end()) return QObject::tr(known->second);
    // "goals.left"; of earlier versions "goals left"
    constexpr std::string_view goals = "goals.";
    if (column.starts_with("goals") && column.size() > goals.size())
        return QObject::tr("Goals in %1").arg(qtText(column.substr(goals.size())));
    return qtText(column);
}

/// As a shell takes a line apart that was quoted for it by apostrophes.
std::vector<std::string> wordsOf(const std::string& command) {
    std::vector<std::string> words(1);
    bool quoted = false;
    for (std::size_t i = 0; i < command.size(); ++i) {
        if (command[i] == '\'')
            quoted = !quoted;
        else if (command[i] == '\\' && !quoted && i + 1 < command.size())
            words.back() += command[++i];
        else if (command[i] == ' ' && !quoted)
            words.emplace_back();
        else
            words.back() += command[i];
    }
    return words;
}

/// Where a file lies that a command named, which was typed in a folder that is not known.
std::string found(const std::string& name, const std::filesystem::path& results) {
    std::error_code ignored;
    std::filesystem::path folder = std::filesystem::absolute(results, ignored).parent_path();
    if (std::filesystem::exists(name, ignored)) return name;
    for (; folder.has_relative_path(); folder = folder.parent_path())
        if (std::filesystem::exists(folder / name, ignored)) return (folder / name).string();
    return name;
}

template <class Number>
bool parse(const std::string& text, Number& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

std::optional<TrialRow> rowOf(const std::vector<std::string>& cells, const std::vector<std::size_t>& shown,
                              std::size_t command, const std::string& path) {
    TrialRow row;
    std::uint64_t seed = 0;
    if (cells.size() <= command || !parse(cells[0], row.request.trial) || !parse(cells[1], seed) ||
        !parse(cells[endColumn], row.end))
        return {};
    row.request.seed = seed;
    const std::vector<std::string> words = wordsOf(cells[command]);
    if (words.size() < 3 || words[1] != "run") return {};
    row.request.file = found(words[2], path);
    for (std::size_t i = 3; i + 1 < words.size(); ++i)
        if (words[i] == "--log") row.request.log = found(words[i + 1], path);
    for (const std::size_t column : shown) row.cells.push_back(shortened(cells[column]));
    return row;
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

Expected<TrialTable> readTrials(const std::string& path) {
    const auto text = readFile(path);
    if (!text) return tl::unexpected(text.error());
    if (!text->starts_with(firstColumns)) return fail(path, "is no results.csv of mrose batch", 1);
    TrialTable table;
    std::size_t command = 0, columns = 0;
    std::vector<std::size_t> shown;
    int line = 0;
    for (std::size_t begin = 0; begin < text->size();) {
        const std::size_t end = std::min(text->find('\n', begin), text->size());
        std::vector<std::string> cells = resultsCells(std::string_view(*text).substr(begin, end - begin));
        begin = end + 1;
        if (++line == 1) {
            columns = cells.size();
            while (command < cells.size() && cells[command] != "command") ++command;
            shown = shownColumns(cells);
            for (const std::size_t column : shown) table.columns.push_back(cells[column]);
            continue;
        }
        // A table is as wide as its first line: no row is filled up to that.
        auto row = cells.size() == columns ? rowOf(cells, shown, command, path) : std::nullopt;
        if (!row) return fail(path, "is no row of a batch; expected trial, seed and the command that runs it", line);
        table.rows.push_back(std::move(*row));
    }
    if (table.rows.empty()) return fail(path, "holds no runs");
    return table;
}

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
    list_->setColumnCount(static_cast<int>(table.columns.size()));
    list_->setRowCount(static_cast<int>(rows_.size()));
    QStringList titles;
    for (const std::string& column : table.columns) titles << titleOf(column);
    list_->setHorizontalHeaderLabels(titles);
    list_->setSelectionBehavior(QAbstractItemView::SelectRows);
    list_->setSelectionMode(QAbstractItemView::SingleSelection);
    list_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    list_->verticalHeader()->hide();
    for (int row = 0; row < list_->rowCount(); ++row)
        for (int column = 0; column < list_->columnCount(); ++column) {
            const TrialRow& trial = rows_[static_cast<std::size_t>(row)];
            auto* item = new TrialCell(trial.cells[static_cast<std::size_t>(column)]);
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
