#include "panels/branch_panel.h"

#include <QAction>
#include <QHeaderView>
#include <QLabel>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "widgets/fixed_text.h"
#include "widgets/qt_text.h"
#include "widgets/whole_rows.h"

namespace mrose::gui {
namespace {

constexpr int branchRole = Qt::UserRole;
constexpr int rowsAlwaysSeen = 6;
constexpr int indentation = 12;  // pixels

QTreeWidget* quietTree(const QStringList& header) {
    auto* tree = new WholeRows<QTreeWidget>;
    tree->setColumnCount(static_cast<int>(header.size()));
    tree->setHeaderLabels(header);
    tree->setFrameShape(QFrame::NoFrame);
    tree->setUniformRowHeights(true);
    tree->header()->setStretchLastSection(false);
    tree->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    for (int column = 1; column < header.size(); ++column)
        tree->header()->setSectionResizeMode(column, QHeaderView::ResizeToContents);
    return tree;
}

constexpr double leastMoved = 0.0005;   // m
constexpr double leastTurned = 0.05;    // degrees
constexpr std::size_t mostBodies = 32;  // of more, those farthest apart

QString distanceText(double metres) {
    if (metres < leastMoved) return QObject::tr("same");
    return metres < 1 ? QString::number(100 * metres, 'f', 1) + " cm" : QString::number(metres, 'f', 2) + " m";
}

/// What is compared, as the table shows it.
struct Difference {
    QString what, here, there;
    bool same = false;
    double apart = 0;  ///< m, of bodies
};

/// The body of that name; nullopt where the other scenario has none.
std::optional<std::size_t> bodyNamed(const FieldFrame& frame, const std::string& name, std::size_t likely) {
    const std::size_t count = frame.scene().bodyCount();
    if (likely < count && frame.nameOf(likely) == name) return likely;
    for (std::size_t body = 0; body < count; ++body)
        if (frame.nameOf(body) == name) return body;
    return {};
}

/// How far a body lies from where it is in the other branch, or if it lies there, how far it is turned.
Difference distanceOf(const FieldFrame& here, std::size_t body, const FieldFrame& there, std::size_t other) {
    const Pose &a = here.poseOf(body), &b = there.poseOf(other);
    const double apart = std::hypot(a.x - b.x, a.y - b.y);
    const double turned = std::abs(wrapAngle(a.heading - b.heading)) * 180 / std::numbers::pi;
    const bool moved = apart >= leastMoved, robot = body < here.state.robots.size();
    const bool onlyTurned = robot && !moved && turned >= leastTurned;
    return {QObject::tr("%1 apart").arg(qtText(here.nameOf(body))),
            onlyTurned ? QString::number(turned, 'f', 1) + QString::fromUtf8("\u00b0") : distanceText(apart),
            {},
            !moved && !onlyTurned,
            apart};
}

std::vector<Difference> differencesOf(const Shown& shown) {
    const FieldFrame &here = *shown.frame, &there = *shown.beside;
    const BranchInfo::Events& ours = shown.branches[shown.branch].events;
    const BranchInfo::Events& theirs = shown.branches[*shown.besideBranch].events;
    std::vector<Difference> rows;
    const auto count = [&](const QString& what, int a, int b) {
        rows.push_back({what, QString::number(a), QString::number(b), a == b});
    };
    for (std::size_t goal = 0; goal < std::min(here.state.goals.size(), there.state.goals.size()); ++goal)
        count(QObject::tr("in the %1 goal").arg(qtText(here.scene().environment.goals[goal].name)),
              here.state.goals[goal], there.state.goals[goal]);
    count(QObject::tr("kicks"), ours.kicks, theirs.kicks);
    count(QObject::tr("contacts"), ours.contacts, theirs.contacts);
    std::vector<Difference> bodies;
    for (std::size_t body = 0; body < here.scene().bodyCount(); ++body)
        if (const auto other = bodyNamed(there, here.nameOf(body), body))
            bodies.push_back(distanceOf(here, body, there, *other));
    if (bodies.size() > mostBodies) {
        const auto farther = [](const Difference& a, const Difference& b) { return a.apart > b.apart; };
        std::partial_sort(bodies.begin(), bodies.begin() + mostBodies, bodies.end(), farther);
        bodies.resize(mostBodies);
    }
    rows.insert(rows.end(), bodies.begin(), bodies.end());
    std::stable_partition(rows.begin(), rows.end(), [](const Difference& row) { return !row.same; });
    return rows;
}

}  // namespace

BranchPanel::BranchPanel(QWidget* parent)
    : QWidget(parent),
      tree_(quietTree({tr("Branch"), tr("from")})),
      heading_(new QLabel),
      differences_(quietTree({tr("Compared"), tr("here"), tr("there")})) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(tree_, 2);
    heading_->setContentsMargins(8, 8, 8, 4);
    heading_->setWordWrap(true);
    heading_->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    heading_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);  // a long name does not widen it
    layout->addWidget(heading_);
    layout->addWidget(differences_, 3);
    tree_->setAccessibleName(tr("Branches"));
    tree_->setIndentation(indentation);
    tree_->setEditTriggers(QAbstractItemView::EditKeyPressed | QAbstractItemView::DoubleClicked);
    tree_->setContextMenuPolicy(Qt::ActionsContextMenu);
    differences_->setAccessibleName(tr("Differences to the branch beside"));
    differences_->setRootIsDecorated(false);
    differences_->hide();
    differences_->setSelectionMode(QAbstractItemView::NoSelection);
    differences_->setFocusPolicy(Qt::NoFocus);
    const auto branchOf = [](const QTreeWidgetItem* item) { return item->data(0, branchRole).toUInt(); };
    connect(tree_, &QTreeWidget::itemClicked, this,
            [this, branchOf](QTreeWidgetItem* item, int) { emit branchRequested(branchOf(item)); });
    connect(tree_, &QTreeWidget::itemActivated, this,
            [this, branchOf](QTreeWidgetItem* item, int) { emit branchRequested(branchOf(item)); });
    connect(tree_, &QTreeWidget::itemChanged, this, [this, branchOf](QTreeWidgetItem* item, int column) {
        if (filling_ || column != 0) return;
        if (const QString name = item->text(0).simplified(); !name.isEmpty()) return emit renamed(branchOf(item), name);
        setShown(*shown_);  // it keeps its name
    });
    const auto offer = [this](const QString& text, auto run) {
        auto* action = new QAction(text, tree_);
        connect(action, &QAction::triggered, this, run);
        tree_->addAction(action);
        return action;
    };
    show_ = offer(tr("Show"), [this] {
        if (const auto branch = current()) emit branchRequested(*branch);
    });
    compare_ = offer(tr("Compare with the shown one"), [this] {
        if (const auto branch = current()) emit besideRequested(*branch);
    });
    rename_ = offer(tr("Rename"), [this] { editName(); });
    delete_ = offer(tr("Delete"), [this] {
        if (const auto branch = current()) emit removalRequested(*branch);
    });
    delete_->setShortcut(QKeySequence::Delete);
    delete_->setShortcutContext(Qt::WidgetShortcut);
    connect(tree_, &QTreeWidget::currentItemChanged, this, &BranchPanel::enableOffers);
    enableOffers();
}

void BranchPanel::enableOffers() {
    const auto branch = current();
    const bool other = shown_ && branch && *branch != shown_->branch;
    show_->setEnabled(other);
    compare_->setEnabled(other && branch != shown_->besideBranch);
    rename_->setEnabled(branch.has_value());
    delete_->setEnabled(branch && *branch != 0);  // not the run itself
}

std::optional<std::uint32_t> BranchPanel::current() const {
    const QTreeWidgetItem* item = tree_->currentItem();
    return item == nullptr ? std::nullopt : std::optional(item->data(0, branchRole).toUInt());
}

void BranchPanel::editName() {
    if (QTreeWidgetItem* item = tree_->currentItem()) tree_->editItem(item, 0);
}

QString BranchPanel::nameOf(const Shown& shown, std::uint32_t branch) {
    const QString name = qtText(shown.branches[branch].name);
    return name.isEmpty() ? tr("the run") : name;
}

void BranchPanel::setTheme(const Theme& theme) {
    theme_ = theme;
    if (shown_) setShown(*shown_);
}

void BranchPanel::setShown(const Shown& shown) {
    shown_ = shown;
    filling_ = true;
    std::vector<std::uint32_t> parents;
    for (const BranchInfo& branch : shown.branches) parents.push_back(branch.parent);
    if (parents != parents_) rebuild(shown);
    refresh(shown);
    compare(shown);
    enableOffers();
    filling_ = false;
}

void BranchPanel::rebuild(const Shown& shown) {
    tree_->clear();
    items_.clear();
    parents_.clear();
    for (std::uint32_t i = 0; i < shown.branches.size(); ++i) {
        const std::uint32_t parent = shown.branches[i].parent;
        auto* item = parent < i ? new QTreeWidgetItem(items_[parent]) : new QTreeWidgetItem(tree_);
        item->setData(0, branchRole, i);
        item->setFlags(item->flags() | Qt::ItemIsEditable);
        items_.push_back(item);
        parents_.push_back(parent);
    }
    tree_->expandAll();
    const int rows = std::min(listedBranches(shown.branches), rowsAlwaysSeen);
    tree_->setMinimumHeight(tree_->header()->sizeHint().height() + rows * tree_->sizeHintForRow(0));
    current_ = noBody;
}

void BranchPanel::refresh(const Shown& shown) {
    if (std::exchange(current_, shown.branch) != shown.branch) tree_->setCurrentItem(items_[shown.branch]);
    const Scene& scene = shown.setup->scene();
    for (std::uint32_t i = 0; i < shown.branches.size(); ++i) {
        const BranchInfo& branch = shown.branches[i];
        QTreeWidgetItem& item = *items_[i];
        const bool isShown = i == shown.branch;
        const QString name = nameOf(shown, i);
        if (item.text(0) != name) item.setText(0, name);
        if (item.isHidden() != branch.hidden) item.setHidden(branch.hidden);
        item.setText(1, i == 0 ? QString() : clockText(branch.departed * scene.tickLength));
        item.setToolTip(
            0, tr("%1: from %2 to %3%4\nEnter shows it, F2 names it%5")
                   .arg(name, clockText(branch.first * scene.tickLength), clockText(branch.last * scene.tickLength),
                        branch.undone ? tr("\nUndone: Ctrl+Shift+Z makes it again, another change removes it") : "",
                        i == 0 ? "" : tr(", Delete deletes it")));
        QFont font = tree_->font();
        font.setBold(isShown);
        font.setItalic(shown.besideBranch == i);
        item.setFont(0, font);
        item.setForeground(0, isShown ? theme_.accent : branch.undone ? theme_.quietText : theme_.text);
    }
}

void BranchPanel::compare(const Shown& shown) {
    const auto otherName = [&] {
        constexpr int widestName = 300;  // pixels: two lines
        return heading_->fontMetrics().elidedText(nameOf(shown, *shown.besideBranch), Qt::ElideMiddle, widestName);
    };
    const bool beside = shown.beside != nullptr && shown.besideBranch;
    const bool any = beside && shown.beside->state.tick == shown.tick();
    heading_->setText(
        beside && !any
            ? tr("\u201c%1\u201d has not come to this tick: it lies between %2 and %3")
                  .arg(otherName(),
                       clockText(shown.branches[*shown.besideBranch].first * shown.setup->scene().tickLength),
                       clockText(shown.branches[*shown.besideBranch].last * shown.setup->scene().tickLength))
        : any ? tr("At this tick, beside \u201c%1\u201d").arg(otherName())
              : tr("Drag a robot or change its command while the run stands, and a branch begins."));
    heading_->setStyleSheet("color: " + theme_.quietText.name());
    differences_->setVisible(any);
    // The list takes what it needs then, and the differences or the hint have the rest.
    const bool alone = listedBranches(shown.branches) <= 1;
    tree_->setMaximumHeight(any || alone ? tree_->minimumHeight() + tree_->sizeHintForRow(0) : QWIDGETSIZE_MAX);
    if (!any) return;
    const std::vector<Difference> rows = differencesOf(shown);
    while (differences_->topLevelItemCount() > static_cast<int>(rows.size()))
        delete differences_->takeTopLevelItem(differences_->topLevelItemCount() - 1);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        QTreeWidgetItem* item = differences_->topLevelItem(static_cast<int>(i));
        if (item == nullptr) item = new QTreeWidgetItem(differences_);
        item->setText(0, rows[i].what);
        item->setText(1, rows[i].here);
        item->setText(2, rows[i].there);
        for (const int column : {1, 2}) item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
        for (int column = 0; column < 3; ++column)
            item->setForeground(column, rows[i].same ? theme_.quietText : theme_.text);
    }
}

}  // namespace mrose::gui
