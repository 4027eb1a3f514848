#include "reality/overlay_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QItemSelectionModel>
#include <QLabel>
#include <QMenu>
#include <QProgressBar>
#include <QScrollBar>
#include <QShortcut>
#include <QSignalBlocker>
#include <QToolButton>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/other_models.h"
#include "io/format.h"
#include "reality/folding_lines.h"
#include "widgets/eliding_text.h"
#include "widgets/fixed_text.h"
#include "widgets/qt_text.h"
#include "workflow/open_model.h"

namespace mrose::gui {
namespace {

constexpr double longestLog = 1e6;  // s
constexpr int leastBox = 72;        // pixels
constexpr int narrow = 470;         // pixels, of the panel: a model's name has no room beside all of its figures
constexpr int lowPart = 740;        // pixels, of what is seen of the panel: the list needs all room that can be had

QString counted(std::size_t count, const QString& one, const QString& several) {
    return QString::number(count) + ' ' + (count == 1 ? one : several);
}

/// "155 rollouts of 5 robots, 26:00.0"; of a log in parts: "..., 128 sessions, 8:32.0 in all".
QString aboutText(const Overlay& overlay) {
    const LogWorld& world = overlay.rollouts().world();
    const auto stretch = overlay.rollouts().plan().stretch;
    Nanoseconds length = 0;
    for (const LogSession& session : world.sessions()) length += std::max<Nanoseconds>(0, session.length);
    QStringList parts{
        QObject::tr("%1 of %2")
            .arg(counted(overlay.rollouts().requests().size(), QObject::tr("rollout"), QObject::tr("rollouts")),
                 counted(world.robots().size(), QObject::tr("robot"), QObject::tr("robots"))) +
        (stretch ? QObject::tr(" in %1 s").arg(fixedText(*stretch, 1)) : QString())};
    const bool several = world.sessions().size() > 1;
    if (several) parts << counted(world.sessions().size(), QObject::tr("session"), QObject::tr("sessions"));
    parts << logTimeText(length) + (several ? QObject::tr(" in all") : QString());
    return parts.join(", ");
}

QString figuresTip(bool open) {
    return open ? QObject::tr(
                      "As mrose evaluate has them: of each model alone, open loop, through everything,\n"
                      "on its windows")
                : QObject::tr(
                      "As mrose compare has them: of these rollouts, in which robots touch each other and walls.\n"
                      "They begin elsewhere than the windows of mrose evaluate, and so their figures differ;\n"
                      "with \u201cWindows of\u201d 10 s they begin where those do");
}

/// "P 1.50 %, Hd 3.10 % with contacts, as mrose compare, over 155 windows".
QString figuresText(const Summary& summary, bool open) {
    return QObject::tr("P %1 %, Hd %2 % %3, over %4")
        .arg(fixedText(summary.p, 2), fixedText(summary.hd, 2),
             open ? QObject::tr("open loop, as mrose evaluate") : QObject::tr("with contacts, as mrose compare"),
             counted(summary.windows, QObject::tr("window"), QObject::tr("windows")));
}

/// "372 of 440 count: 40 have gaps, 16 move little, 12 begin unseen"; empty: all do.
QString countText(const LogRollouts& rollouts) {
    const std::vector<RolloutRow>& rows = rollouts.rows();
    const auto with = [&](RolloutUse use) {
        return std::count_if(rows.begin(), rows.end(), [use](const RolloutRow& row) { return row.use == use; });
    };
    // They have no rows.
    const auto* all = rollouts.comparison();
    const auto absent = all == nullptr ? 0 : static_cast<std::int64_t>(all->all.of(RolloutUse::absent));
    const auto gaps = with(RolloutUse::gap), still = with(RolloutUse::still);
    QStringList others;
    if (gaps > 0) others << QObject::tr("%1 have gaps").arg(gaps);
    if (still > 0) others << QObject::tr("%1 move little").arg(still);
    if (absent > 0) others << QObject::tr("%1 begin unseen").arg(absent);
    if (others.isEmpty()) return {};
    const auto known = static_cast<std::int64_t>(rows.size());
    return QObject::tr("%1 of %2 count: %3")
        .arg(QString::number(known - gaps - still), QString::number(known + absent), others.join(", "));
}

QDoubleSpinBox* secondsBox(double least, double most, const QString& tip) {
    auto* box = new QDoubleSpinBox;
    box->setRange(least, most);
    box->setDecimals(1);
    box->setSuffix(" s");
    box->setMinimumWidth(leastBox);
    box->setKeyboardTracking(false);
    box->setAccelerated(true);
    box->setToolTip(tip);
    return box;
}

}  // namespace

OverlayPanel::OverlayPanel(Overlay& overlay, QWidget* parent)
    : QWidget(parent),
      overlay_(overlay),
      rollouts_(new RolloutList(this)),
      log_(new QLabel),
      about_(new ElidingText(1)),
      counts_(new ElidingText(2)),
      causes_(new CausePanel(overlay)),
      cut_(new QComboBox),
      startLabel_(new QLabel(tr("from"))),
      restarts_(new QCheckBox(tr("Play into the next"))),
      progress_(makeProgress()),
      list_(new RolloutTable(*rollouts_)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(8, 8, 8, 8);
    layout->setSpacing(6);
    layout->addWidget(makeHead());
    layout->addWidget(makePlan());
    layout->addWidget(progress_);
    layout->addWidget(makeModels());
    layout->addWidget(list_, 1);
    connect(list_, &QTreeView::clicked, this, &OverlayPanel::openLine);
    connect(list_, &QTreeView::activated, this, &OverlayPanel::openLine);
    layout->addWidget(causes_);
    connect(&overlay_, &Overlay::changed, this, &OverlayPanel::refresh);
    refresh();
}

QWidget* OverlayPanel::makeHead() {
    auto* head = new QWidget;
    auto* layout = new QVBoxLayout(head);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    QFont bold = log_->font();
    bold.setBold(true);
    log_->setFont(bold);
    layout->addWidget(log_);
    layout->addWidget(about_);
    layout->addWidget(counts_);
    counts_->setToolTip(
        tr("Of each robot in each rollout. In the models\u2019 errors count those in which the robot is "
           "seen at the start,\nits ground truth has no gap, and it drives %1 cm or turns %2\u00b0 "
           "in 10 s at least")
            .arg(fixedText(100 * WindowOptions{}.leastPath, 0), fixedText(degrees * WindowOptions{}.leastRotation, 0)));
    return head;
}

QWidget* OverlayPanel::makePlan() {
    auto* plan = new QWidget;
    planLines_ = new QBoxLayout(QBoxLayout::TopToBottom, plan);
    planLines_->setContentsMargins(0, 0, 0, 0);
    planLines_->setSpacing(4);
    auto* line = new QHBoxLayout;
    cut_->addItem(tr("Restart every"), static_cast<int>(RolloutPlan::Cut::every));
    cut_->addItem(tr("One rollout of"), static_cast<int>(RolloutPlan::Cut::once));
    cut_->addItem(tr("Windows of"), static_cast<int>(RolloutPlan::Cut::windows));
    cut_->setToolTip(tr("Where the simulated robots start: again and again, once, or as mrose evaluate cuts the log"));
    length_ = secondsBox(0.1, longestLog, tr("How long a rollout is"));
    start_ =
        secondsBox(0, longestLog, tr("Where in the log the first rollout begins, after all of its robots are there"));
    line->addWidget(cut_);
    line->addWidget(length_);
    line->addStretch(1);
    planLines_->addLayout(line);
    auto* where = new QHBoxLayout;
    where->addWidget(startLabel_);
    where->addWidget(start_);
    where->addWidget(restarts_);
    where->addStretch(1);
    planLines_->addLayout(where);
    restarts_->setToolTip(tr("At the end of a rollout the next one begins, from where the robots of the log then are"));
    connect(cut_, QOverload<int>::of(&QComboBox::activated), this, &OverlayPanel::applyPlan);
    connect(length_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, &OverlayPanel::applyPlan);
    connect(start_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, &OverlayPanel::applyPlan);
    connect(restarts_, &QCheckBox::toggled, this, [this](bool on) {
        if (!filling_) overlay_.setRestarts(on);
    });
    return plan;
}

QWidget* OverlayPanel::makeProgress() {
    auto* progress = new QWidget;
    auto* layout = new QHBoxLayout(progress);
    layout->setContentsMargins(0, 0, 0, 0);
    bar_ = new QProgressBar;
    stop_ = new QToolButton;
    stop_->setObjectName("compare_or_cancel");
    connect(stop_, &QToolButton::clicked, this, [this] {
        if (overlay_.work())
            overlay_.cancel();
        else
            overlay_.compareAll();
    });
    layout->addWidget(bar_, 1);
    layout->addWidget(stop_);
    return progress;
}

QWidget* OverlayPanel::makeModels() {
    auto* part = new QWidget;
    auto* layout = new QVBoxLayout(part);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(2);
    models_ = new QTreeWidget;
    models_->setObjectName("models");
    models_->setAccessibleName(tr("Motion models and their errors"));
    models_->setHeaderLabels({tr("Model"), tr("Position\n% of path"), tr("Heading\n% of turn"), tr("End, cm\n(median)"),
                              tr("End, \u00b0\n(median)")});
    models_->headerItem()->setToolTip(
        1, tr("P: mean distance to the robot of the log, in percent of the path that it drove, over all windows"));
    models_->headerItem()->setToolTip(
        2, tr("Hd: mean heading error, in percent of how far that turned, over all windows"));
    models_->headerItem()->setToolTip(3, tr("Distance at the end of a rollout, the median"));
    models_->headerItem()->setToolTip(4, tr("Heading error at the end of a rollout, the median"));
    models_->setRootIsDecorated(false);
    models_->setIndentation(0);
    models_->setUniformRowHeights(true);
    models_->setFrameShape(QFrame::NoFrame);
    models_->setVerticalScrollBarPolicy(Qt::ScrollBarAsNeeded);
    models_->header()->setStretchLastSection(false);
    models_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
    for (int column = 1; column < 5; ++column) {
        models_->headerItem()->setTextAlignment(column, Qt::AlignRight);
        models_->header()->setSectionResizeMode(column, QHeaderView::Fixed);
        models_->header()->resizeSection(
            column, models_->fontMetrics().size(0, models_->headerItem()->text(column)).width() + 10);
    }
    models_->setContextMenuPolicy(Qt::ActionsContextMenu);
    auto* remove = new QAction(tr("Remove this model"), models_);
    remove->setShortcut(QKeySequence::Delete);
    remove->setShortcutContext(Qt::WidgetShortcut);
    connect(remove, &QAction::triggered, this, [this] { emit modelRemovalWanted(); });
    models_->addAction(remove);
    connect(models_, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item) {
        const auto model = static_cast<std::size_t>(models_->indexOfTopLevelItem(item));
        const bool shown = item->checkState(0) == Qt::Checked;
        // Once the item has changed: refreshing the list deletes it.
        QMetaObject::invokeMethod(
            this, [this, model, shown] { overlay_.models().show(model, shown); }, Qt::QueuedConnection);
    });
    auto* line = new QHBoxLayout;
    auto* add = new QToolButton;
    add->setText(tr("Add a model"));
    add->setToolTip(tr("Lay what another motion model makes of the same commands over it"));
    add->setPopupMode(QToolButton::InstantPopup);
    auto* menu = new QMenu(add);
    connect(menu, &QMenu::aboutToShow, this, [this, menu] { fillModelMenu(*menu); });
    add->setMenu(menu);
    figures_ = new QComboBox;
    figures_->setObjectName("figures");
    figures_->setAccessibleName(tr("Whose figures"));
    figures_->addItem(tr("with contacts"));
    figures_->addItem(tr("without contacts"));
    for (int i = 0; i < 2; ++i) figures_->setItemData(i, figuresTip(i == 1), Qt::ToolTipRole);
    connect(figures_, QOverload<int>::of(&QComboBox::currentIndexChanged), this, &OverlayPanel::refreshModels);
    line->addWidget(add);
    line->addStretch(1);
    line->addWidget(figures_);
    layout->addWidget(models_);
    layout->addLayout(line);
    return part;
}

void OverlayPanel::fillModelMenu(QMenu& menu) {
    menu.clear();
    if (!overlay_.rollouts().log()) return;
    for (const std::string& known : modelNames(*overlay_.rollouts().log()))
        menu.addAction(qtText(known), this, [this, known] { overlay_.models().add(known); });
    menu.addSeparator();
    menu.addAction(tr("From a file\u2026"), this, [this] { emit modelFileWanted(); });
}

/// What does not fit beside the models' names is left out; lines fold where there is little room across.
void OverlayPanel::resizeEvent(QResizeEvent* event) {
    const int across = event->size().width(), seen = parentWidget() != nullptr ? parentWidget()->height() : height();
    for (const int column : {3, 4}) models_->setColumnHidden(column, across < narrow);
    layBeside(*planLines_, across >= narrow);
    counts_->setLines(across < narrow ? 2 : 1);
    causes_->setLow(seen < lowPart);
    QWidget::resizeEvent(event);
}

void OverlayPanel::openLine(const QModelIndex& index) {
    const RolloutRow& row = rollouts_->row(index.row());
    if (!overlay_.shown().show(row.rollout, row.robot)) selectShown();
}

void OverlayPanel::applyPlan() {
    if (filling_) return;
    RolloutPlan plan;
    plan.cut = static_cast<RolloutPlan::Cut>(cut_->currentData().toInt());
    plan.length = length_->value();
    plan.start = start_->value();
    if (const auto done = overlay_.setPlan(plan); !done) {
        about_->setText(qtText(done.error().message()));
        return;
    }
    refresh();
}

void OverlayPanel::setTheme(const Theme& theme) {
    theme_ = theme;
    refresh();
}

void OverlayPanel::refresh() {
    const PlayedLogPointer& world = overlay_.rollouts().log();
    setEnabled(world != nullptr);
    filling_ = true;
    log_->setText(world ? qtText(world->name()) : tr("No log is open"));
    log_->setToolTip(world ? qtText(world->place) : QString());
    about_->setText(world ? aboutText(overlay_) : tr("File \u2192 Open a real log\u2026"));
    counts_->setText(countText(overlay_.rollouts()));
    counts_->setVisible(!counts_->text().isEmpty());
    const RolloutPlan& plan = overlay_.rollouts().plan();
    cut_->setCurrentIndex(cut_->findData(static_cast<int>(plan.cut)));
    length_->setValue(plan.length);
    start_->setValue(plan.start);
    const bool windows = plan.cut == RolloutPlan::Cut::windows;
    start_->setVisible(!windows);
    startLabel_->setVisible(!windows);
    restarts_->setVisible(plan.cut == RolloutPlan::Cut::every);
    restarts_->setChecked(overlay_.rollouts().restarts());
    filling_ = false;
    const auto work = overlay_.work();
    const bool ended = world != nullptr && !work && !overlay_.comparing().error().isEmpty();
    progress_->setVisible(work.has_value() || ended);
    bar_->setFormat(work ? work->what + " %p %" : overlay_.comparing().error());
    bar_->setValue(work ? static_cast<int>(100 * work->share) : 0);
    stop_->setText(ended ? tr("Compare") : tr("Cancel"));
    stop_->setToolTip(ended ? tr("Compare all rollouts") : tr("End this here (Esc)"));
    models_->setVisible(world != nullptr);
    refreshModels();
    refreshList();
    causes_->refresh();
}

/// The line chosen by keys is left alone until another rollout is shown. A log opens with the worst in sight, wherever
/// the rollout is that is shown first.
void OverlayPanel::refreshList() {
    if (listed_ != overlay_.rollouts().rowsVersion()) fillList();
    const RolloutRow* const row = overlay_.rollouts().shownRow();
    const auto shown = row != nullptr ? std::optional(std::pair(row->rollout, row->robot)) : std::nullopt;
    if (shown == selected_ || overlay_.opening()) return;
    list_->setAutoScroll(std::exchange(selected_, shown).has_value());
    selectShown();
}

/// Scrolled to where it was, with the same current line.
void OverlayPanel::fillList() {
    const int scrolled = list_->verticalScrollBar()->value();
    const QModelIndex current = list_->currentIndex();
    std::optional<RolloutRow> kept;
    if (current.isValid()) kept = rollouts_->row(current.row());
    rollouts_->setRows(overlay_.rollouts().log(), overlay_.rollouts().rows());
    listed_ = overlay_.rollouts().rowsVersion();
    if (overlay_.rollouts().rows().empty()) selected_.reset();
    list_->fitColumns(overlay_.rollouts());
    const bool picked = list_->hasAutoScroll();
    list_->setAutoScroll(false);
    if (kept) select(kept->rollout, kept->robot);
    list_->setAutoScroll(picked);
    list_->doItemsLayout();
    list_->verticalScrollBar()->setValue(scrolled);
}

bool OverlayPanel::showsEvaluated() const { return figures_->currentIndex() == 1; }

/// The models' figures: with contacts as `mrose compare` has them, or without as `mrose evaluate`.
void OverlayPanel::refreshModels() {
    const bool open = showsEvaluated();
    figures_->setToolTip(figuresTip(open));
    const QSignalBlocker quiet(models_);
    const QString current = models_->currentItem() != nullptr ? models_->currentItem()->text(0) : QString();
    models_->clear();
    std::size_t colour = 0;
    for (std::size_t i = 0; i < overlay_.models().all().size(); ++i) {
        const JudgedModel& model = overlay_.models().all()[i];
        auto* item = new QTreeWidgetItem({qtText(briefName(model.name))});
        const auto set = [&](int column, double value, int decimals) {
            item->setText(column, fixedText(value, decimals));
            item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
        };
        const auto show = [&](const Summary& summary, const Distribution& position, const Distribution& heading) {
            set(1, summary.p, 2);
            set(2, summary.hd, 2);
            set(3, 100 * position.median, 1);
            set(4, degrees * heading.median, 1);
            item->setToolTip(1, figuresText(summary, open));
        };
        const auto showUnknown = [&](const Error* why) {
            for (int column = 1; column < 5 && why != nullptr; ++column) {
                set(column, std::numeric_limits<double>::quiet_NaN(), 1);
                item->setToolTip(column, qtText(why->message()));
            }
            if (why == nullptr) item->setText(1, QString::fromUtf8("\u2026"));
        };
        const auto& [compared, evaluated] = model.figures;
        if (open && evaluated && *evaluated)
            show(**evaluated, (*evaluated)->positionFinal, (*evaluated)->headingFinal);
        else if (open)
            showUnknown(evaluated ? &evaluated->error() : nullptr);
        else if (compared && *compared)
            show((*compared)->counted, (*compared)->positionFinal, (*compared)->headingFinal);
        else
            showUnknown(compared ? &compared->error() : nullptr);
        // The others' are at hand, too.
        if (compared && *compared && evaluated && *evaluated)
            item->setToolTip(1, figuresText((*compared)->counted, false) + '\n' + figuresText(**evaluated, true));
        if (i > 0) {
            item->setFlags(item->flags() | Qt::ItemIsUserCheckable);
            item->setCheckState(0, model.shown ? Qt::Checked : Qt::Unchecked);
            if (model.shown) item->setData(0, Qt::DecorationRole, modelColour(colour++));
        }
        item->setToolTip(0, qtText(model.name) + (i == 0 ? tr(": the scenario's own, by which the filled robots move")
                                                         : tr(": drawn in this colour")));
        models_->addTopLevelItem(item);
        if (item->text(0) == current) models_->setCurrentItem(item);
    }
    const int lines = std::clamp(models_->topLevelItemCount(), 1, 5);
    const int line = std::max(models_->sizeHintForRow(0), models_->fontMetrics().height() + 1);
    models_->setFixedHeight(models_->header()->sizeHint().height() + lines * line + 2);
}

/// The shown rollout in the list.
void OverlayPanel::selectShown() {
    const RolloutRow* const row = overlay_.rollouts().shownRow();
    if (row == nullptr) return list_->selectionModel()->clear();
    select(row->rollout, row->robot);
}

void OverlayPanel::select(std::size_t rollout, std::size_t robot) {
    const int line = rollouts_->lineOf(rollout, robot);
    if (line < 0) return list_->selectionModel()->clear();
    list_->selectionModel()->setCurrentIndex(rollouts_->index(line, RolloutList::error),
                                             QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
}

}  // namespace mrose::gui
