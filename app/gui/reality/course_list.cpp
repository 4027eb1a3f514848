#include "reality/course_list.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "evaluation/format.h"
#include "widgets/value_catalogue.h"

namespace mrose::gui {
namespace {

struct CourseColumn {
    const char *title, *tip;
};
constexpr CourseColumn courseColumns[] = {
    {QT_TR_NOOP("Robot"), QT_TR_NOOP("The simulated robot")},
    {QT_TR_NOOP("Take"), QT_TR_NOOP("Which of the log's trajectories")},
    {QT_TR_NOOP("From\ns"), QT_TR_NOOP("Where in the log the course begins")},
    {QT_TR_NOOP("Error\ncm"), QT_TR_NOOP("Distance to the real robot, the mean over the course")},
    {QT_TR_NOOP("% of\npath"), QT_TR_NOOP("The same in percent of the way that the real robot drove")},
    {QT_TR_NOOP("Head.\n\u00b0"), QT_TR_NOOP("Heading error, the mean over the course")},
    {QT_TR_NOOP("Leaves\ns"), QT_TR_NOOP("When it first leaves the real course by more than the bound")},
    {QT_TR_NOOP("Drives"), QT_TR_NOOP("What it is told to do; or why the course does not count in P and Hd")},
};

/// What lines are sorted by; what nobody knows comes last in either order.
double keyOf(const OverlayRow& row, int column) {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    switch (column) {
        case CourseList::robot:
            return static_cast<double>(row.robot);
        case CourseList::take:
            return static_cast<double>(row.take);
        case CourseList::start:
            return toSeconds(row.start);
        case CourseList::error:
            return row.position.value_or(unknown);
        case CourseList::path:
            return row.share.value_or(unknown);
        case CourseList::heading:
            return row.heading.value_or(unknown);
        case CourseList::leaves:
            return row.divergence ? toSeconds(row.divergence->time) : unknown;
        default:
            return row.manoeuvre ? static_cast<double>(*row.manoeuvre) : unknown;
    }
}

/// In another unit; a dash where it is unknown.
QString figure(const std::optional<double>& value, double unit = 1) {
    return fixedText(unit * value.value_or(std::numeric_limits<double>::quiet_NaN()), 1);
}

}  // namespace

CourseList::CourseList(QObject* parent) : QAbstractTableModel(parent) {}

void CourseList::setRows(OverlayWorldPointer world, std::vector<OverlayRow> rows) {
    beginResetModel();
    world_ = std::move(world);
    rows_ = std::move(rows);
    arrange();
    endResetModel();
}

void CourseList::arrange() {
    order_.resize(rows_.size());
    std::vector<double> keys;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        order_[i] = i;
        keys.push_back(keyOf(rows_[i], sortedBy_));
    }
    const bool falls = sense_ == Qt::DescendingOrder;
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
        if (std::isnan(keys[a]) || std::isnan(keys[b])) return !std::isnan(keys[a]) && std::isnan(keys[b]);
        return falls ? keys[a] > keys[b] : keys[a] < keys[b];
    });
}

void CourseList::sort(int column, Qt::SortOrder order) {
    emit layoutAboutToBeChanged();
    sortedBy_ = column;
    sense_ = order;
    arrange();
    emit layoutChanged();
}

int CourseList::lineOf(std::size_t course, std::size_t which) const {
    for (std::size_t line = 0; line < order_.size(); ++line)
        if (rows_[order_[line]].course == course && rows_[order_[line]].robot == which) return static_cast<int>(line);
    return -1;
}

int CourseList::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(order_.size());
}

int CourseList::columnCount(const QModelIndex& parent) const { return parent.isValid() ? 0 : columns; }

QString CourseList::text(const OverlayRow& row, int column) const {
    switch (column) {
        case robot:
            return QString::fromStdString(world_->world().robots()[row.robot].name);
        case take:
            return QString::fromStdString(world_->world().takes()[row.take].name);
        case start:
            return figure(toSeconds(row.start));
        case error:
            return figure(row.position, 100);
        case path:
            return figure(row.share);
        case heading:
            return figure(row.heading, degrees);
        case leaves:
            return row.divergence ? figure(toSeconds(row.divergence->time)) : QString();
        default:
            break;
    }
    if (row.use == CourseUse::gap) return tr("gap in truth");
    if (row.use == CourseUse::still) return tr("stands");
    const std::string_view manoeuvre = row.manoeuvre ? name(*row.manoeuvre) : "";
    return QString::fromUtf8(manoeuvre.data(), static_cast<int>(manoeuvre.size()));
}

QString CourseList::tip(const OverlayRow& row) const {
    QString words = tr("A click opens this course");
    if (!row.position) words += tr("; there is no ground truth in it");
    if (row.touched) words += tr("; the simulated robot touches something in it");
    if (row.use == CourseUse::gap) words += tr("; the ground truth has a gap in it: it is not counted in P and Hd");
    if (row.use == CourseUse::still) words += tr("; the robot hardly moves: it is not counted in P and Hd");
    return words;
}

QVariant CourseList::data(const QModelIndex& index, int role) const {
    const OverlayRow& shown = row(index.row());
    switch (role) {
        case Qt::DisplayRole:
            return text(shown, index.column());
        case Qt::ToolTipRole:
            return isName(index.column()) ? text(shown, index.column()) + '\n' + tip(shown) : tip(shown);
        case Qt::TextAlignmentRole:
            return static_cast<int>(Qt::AlignVCenter) |
                   static_cast<int>(index.column() == robot || index.column() == drives ? Qt::AlignLeft
                                                                                        : Qt::AlignRight);
        default:
            return {};
    }
}

QVariant CourseList::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal) return {};
    if (role == Qt::DisplayRole) return tr(courseColumns[section].title);
    if (role == Qt::ToolTipRole) return tr(courseColumns[section].tip);
    if (role == Qt::TextAlignmentRole)
        return static_cast<int>(Qt::AlignVCenter) |
               static_cast<int>(section == robot || section == drives ? Qt::AlignLeft : Qt::AlignRight);
    return {};
}

}  // namespace mrose::gui
