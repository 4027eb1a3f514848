#include "course_list.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mrose::gui {
namespace {

constexpr double inDegrees = 180 / std::numbers::pi;

struct CourseColumn {
    const char *title, *tip;
};
constexpr CourseColumn courseColumns[] = {
    {QT_TR_NOOP("Robot"), QT_TR_NOOP("The simulated robot")},
    {QT_TR_NOOP("From"), QT_TR_NOOP("Where in the log the course begins")},
    {QT_TR_NOOP("Error"), QT_TR_NOOP("Distance to the real robot, the mean over the course")},
    {QT_TR_NOOP("of path"), QT_TR_NOOP("The same in percent of the way that the real robot drove")},
    {QT_TR_NOOP("Heading"), QT_TR_NOOP("Heading error, the mean over the course")},
    {QT_TR_NOOP("Leaves"), QT_TR_NOOP("When it first leaves the real course by more than the bound")},
    {QT_TR_NOOP("Drives"), QT_TR_NOOP("What it is told to do")},
};

/// What lines are sorted by; what nobody knows comes last in either order.
double keyOf(const OverlayRow& row, int column) {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    switch (column) {
        case CourseList::robot:
            return static_cast<double>(row.robot);
        case CourseList::start:
            return toSeconds(row.start);
        case CourseList::error:
            return row.position < 0 ? unknown : row.position;
        case CourseList::path:
            return row.share;
        case CourseList::heading:
            return row.heading;
        case CourseList::leaves:
            return row.divergence ? toSeconds(row.divergence->time) : unknown;
        default:
            return row.manoeuvre ? static_cast<double>(*row.manoeuvre) : unknown;
    }
}

QString number(double value, int decimals, const char* unit) {
    if (!std::isfinite(value)) return QString::fromUtf8("\u2013");
    return QString::number(value, 'f', decimals) + QString::fromUtf8(unit);
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

int CourseList::lineOf(std::size_t request, std::size_t which) const {
    for (std::size_t line = 0; line < order_.size(); ++line)
        if (rows_[order_[line]].request == request && rows_[order_[line]].robot == which) return static_cast<int>(line);
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
        case start:
            return number(toSeconds(row.start), 1, " s");
        case error:
            return number(row.position < 0 ? std::numeric_limits<double>::quiet_NaN() : 100 * row.position, 1, " cm");
        case path:
            return number(row.share, row.share < 99.95 ? 1 : 0, " %");
        case heading:
            return number(inDegrees * row.heading, 1, "\u00b0");
        case leaves:
            return row.divergence ? number(toSeconds(row.divergence->time), 1, " s") : QString();
        default:
            break;
    }
    if (row.use == CourseUse::gap) return tr("gap");
    if (row.use == CourseUse::still) return tr("stands");
    const std::string_view manoeuvre = row.manoeuvre ? name(*row.manoeuvre) : "";
    return QString::fromUtf8(manoeuvre.data(), static_cast<int>(manoeuvre.size()));
}

QString CourseList::tip(const OverlayRow& row) const {
    QString words = tr("A click opens this course");
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
            return tip(shown);
        case Qt::DecorationRole:
            if (index.column() == robot) return robotColour(world_->world().robots()[shown.robot].body);
            return {};
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
