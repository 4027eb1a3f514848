#include "reality/rollout_list.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/format.h"
#include "widgets/fixed_text.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

struct RolloutColumn {
    const char *title, *tip;
};
constexpr RolloutColumn rolloutColumns[] = {
    {QT_TR_NOOP("Robot"), QT_TR_NOOP("The simulated robot")},
    {QT_TR_NOOP("Session"), QT_TR_NOOP("Which of the log's trajectories")},
    {QT_TR_NOOP("From"), QT_TR_NOOP("Where in the log the rollout begins, min:s")},
    {QT_TR_NOOP("Error\ncm"), QT_TR_NOOP("Distance to the robot of the log, the mean over the rollout")},
    {QT_TR_NOOP("% of\npath"),
     QT_TR_NOOP("The same in percent of the path that the robot of the log drove; not where that is short")},
    {QT_TR_NOOP("Head.\n\u00b0"), QT_TR_NOOP("Heading error, the mean over the rollout")},
    {QT_TR_NOOP("Leaves\ns"), QT_TR_NOOP("When it first leaves the trajectory of the log by more than the bound")},
    {QT_TR_NOOP("Drives"), QT_TR_NOOP("What it is commanded; or why the rollout does not count in the models' errors")},
};

/// What lines are sorted by; unknown numbers come last in either order.
double keyOf(const RolloutRow& row, int column) {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    switch (column) {
        case RolloutList::robot:
            return static_cast<double>(row.robot);
        case RolloutList::session:
            return static_cast<double>(row.session);
        case RolloutList::start:
            return toSeconds(row.start);
        case RolloutList::error:
            return row.position.value_or(unknown);
        case RolloutList::path:
            return row.share.value_or(unknown);
        case RolloutList::heading:
            return row.heading.value_or(unknown);
        case RolloutList::leaves:
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

RolloutList::RolloutList(QObject* parent) : QAbstractTableModel(parent) {}

void RolloutList::setRows(PlayedLogPointer world, std::vector<RolloutRow> rows) {
    beginResetModel();
    world_ = std::move(world);
    rows_ = std::move(rows);
    arrange();
    endResetModel();
}

void RolloutList::arrange() {
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

void RolloutList::sort(int column, Qt::SortOrder order) {
    emit layoutAboutToBeChanged();
    sortedBy_ = column;
    sense_ = order;
    arrange();
    emit layoutChanged();
}

int RolloutList::lineOf(std::size_t rollout, std::size_t which) const {
    for (std::size_t line = 0; line < order_.size(); ++line)
        if (rows_[order_[line]].rollout == rollout && rows_[order_[line]].robot == which) return static_cast<int>(line);
    return -1;
}

int RolloutList::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(order_.size());
}

int RolloutList::columnCount(const QModelIndex& parent) const { return parent.isValid() ? 0 : columns; }

QString RolloutList::text(const RolloutRow& row, int column) const {
    switch (column) {
        case robot:
            return qtText(world_->world().robots()[row.robot].name);
        case session:
            return qtText(world_->world().sessions()[row.session].name);
        case start:
            return logTimeText(row.start);
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
    if (row.use == RolloutUse::gap) return tr("gap in truth");
    if (row.use == RolloutUse::still) return tr("moves little");
    const std::string_view manoeuvre = row.manoeuvre ? name(*row.manoeuvre) : "";
    return QString::fromUtf8(manoeuvre.data(), static_cast<int>(manoeuvre.size()));
}

QString RolloutList::tip(const RolloutRow& row) const {
    QString words = tr("A click opens this rollout");
    if (row.position) {
        // Columns for which there is no room are left out.
        QStringList numbers{tr("%1 cm").arg(figure(row.position, 100))};
        if (row.share) numbers << tr("%1 % of the path").arg(figure(row.share));
        if (row.heading) numbers << tr("%1\u00b0").arg(figure(row.heading, degrees));
        words += tr(": off by %1 on average").arg(numbers.join(", "));
    }
    if (!row.position) words += tr("; there is no ground truth in it");
    if (row.touched) words += tr("; the simulated robot touches something in it");
    if (row.use == RolloutUse::gap)
        words += tr("; the ground truth has a gap in it: it does not count in the models' errors");
    if (row.use == RolloutUse::still) {
        const double part = toSeconds(row.length) / 10;
        words += tr("; the %1 robot drives %2 cm and turns %3\u00b0 in it, less than %4 cm and %5\u00b0: too little to "
                    "divide errors by, so that it does not count in the models' errors")
                     .arg(world_->world().log().real(), fixedText(100 * row.path, 0),
                          fixedText(degrees * row.rotation, 0), fixedText(100 * part * WindowOptions{}.leastPath, 0),
                          fixedText(degrees * part * WindowOptions{}.leastRotation, 0));
    }
    return words;
}

QVariant RolloutList::data(const QModelIndex& index, int role) const {
    const RolloutRow& shown = row(index.row());
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

QVariant RolloutList::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal) return {};
    if (role == Qt::DisplayRole) return tr(rolloutColumns[section].title);
    if (role == Qt::ToolTipRole) return tr(rolloutColumns[section].tip);
    if (role == Qt::TextAlignmentRole)
        return static_cast<int>(Qt::AlignVCenter) |
               static_cast<int>(section == robot || section == drives ? Qt::AlignLeft : Qt::AlignRight);
    return {};
}

}  // namespace mrose::gui
