#include "reality/overlay_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QItemSelectionModel>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QProgressBar>
#include <QScrollBar>
#include <QShortcut>
#include <QSignalBlocker>
#include <QToolButton>
#include <QTreeView>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/other_models.h"
#include "io/format.h"
#include "reality/whole_rows.h"
#include "widgets/fixed_text.h"
#include "widgets/qt_text.h"
#include "workflow/open_model.h"

namespace mrose::gui {
namespace {

constexpr double longestLog = 1e6;   // s
constexpr int widestName = 84;       // pixels: tool tips show longer ones
constexpr int leastRows = 4;         // of the list
constexpr int leastListWidth = 404;  // pixels: all columns of five robots for half an hour

QString minutes(Nanoseconds time) {
    const auto seconds = static_cast<int>(toSeconds(time));
    if (seconds < 3600) return QString("%1:%2 min").arg(seconds / 60).arg(seconds % 60, 2, 10, QChar('0'));
    return QString("%1:%2 h").arg(seconds / 3600).arg(seconds / 60 % 60, 2, 10, QChar('0'));
}

QString counted(std::size_t count, const QString& one, const QString& several) {
    return QString::number(count) + ' ' + (count == 1 ? one : several);
}

/// "155 rollouts of 5 robots, 26:00 min"; of a log in parts: "..., 128 sessions, 8:32 min in all".
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
    parts << minutes(length) + (several ? QObject::tr(" in all") : QString());
    return parts.join(", ");
}

QString figuresTip(bool open) {
    return open ? QObject::tr(
                      "As mrose evaluate has them: of each model alone, open loop, through everything, on its windows")
                : QObject::tr(
                      "As mrose compare has them: of these rollouts, in which robots touch each other and walls");
}

/// "P 1.50 %, Hd 3.10 % with contacts, as mrose compare, over 155 windows".
QString figuresText(const Summary& summary, bool open) {
    return QObject::tr("P %1 %, Hd %2 % %3, over %4")
        .arg(fixedText(summary.p, 2), fixedText(summary.hd, 2),
             open ? QObject::tr("open loop, as mrose evaluate") : QObject::tr("with contacts, as mrose compare"),
             counted(summary.windows, QObject::tr("window"), QObject::tr("windows")));
}

/// "372 of 440 count: 40 have gaps, 28 stand still"; empty: all do.
QString countText(const std::vector<RolloutRow>& rows) {
    const auto with = [&](RolloutUse use) {
        return std::count_if(rows.begin(), rows.end(), [use](const RolloutRow& row) { return row.use == use; });
    };
    const auto gaps = with(RolloutUse::gap), still = with(RolloutUse::still);
    QStringList others;
    if (gaps > 0) others << QObject::tr("%1 have gaps").arg(gaps);
    if (still > 0) others << QObject::tr("%1 stand still").arg(still);
    if (others.isEmpty()) return {};
    const auto all = static_cast<std::int64_t>(rows.size());
    return QObject::tr("%1 of %2 count: %3")
        .arg(QString::number(all - gaps - still), QString::number(all), others.join(", "));
}

/// Rollouts that are walked through by keys are all seen. The current one stays in sight where room is taken, if it was
/// picked: then the list scrolls by itself.
class RolloutTable final : public WholeRows<QTreeView> {
protected:
    void resizeEvent(QResizeEvent* event) override {
        const QRect before = visualRect(currentIndex());
        const bool seen = before.isValid() && before.top() < event->oldSize().height() && before.bottom() >= 0;
        QTreeView::resizeEvent(event);
        if (seen && hasAutoScroll()) scrollTo(currentIndex());
    }
    void keyPressEvent(QKeyEvent* event) override {
        const QModelIndex before = currentIndex();
        setAutoScroll(true);
        QTreeView::keyPressEvent(event);
        if (currentIndex().isValid() && currentIndex().row() != before.row()) emit activated(currentIndex());
    }
};

QDoubleSpinBox* secondsBox(double least, double most, const QString& tip) {
    auto* box = new QDoubleSpinBox;
    box->setRange(least, most);
    box->setDecimals(1);
    box->setSuffix(" s");
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
      about_(new QLabel),
      causes_(new CausePanel(overlay)),
      cut_(new QComboBox),
      startLabel_(new QLabel(tr("from"))),
      restarts_(new QCheckBox(tr("Play on into the next rollout"))),
      progress_(makeProgress()),
      list_(new RolloutTable) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(8, 8, 8, 8);
    layout->setSpacing(6);
    layout->addWidget(makeHead());
    layout->addWidget(makePlan());
    layout->addWidget(progress_);
    layout->addWidget(makeModels());
    makeList();
    layout->addWidget(list_, 1);
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
    return head;
}

QWidget* OverlayPanel::makePlan() {
    auto* plan = new QWidget;
    auto* layout = new QVBoxLayout(plan);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(4);
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
    line->addWidget(startLabel_);
    line->addWidget(start_);
    line->addStretch(1);
    layout->addLayout(line);
    restarts_->setToolTip(tr("At the end of a rollout the next one begins, from where the real robots then are"));
    layout->addWidget(restarts_);
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

/// As wide as their titles and digits, so that all of them are seen at once. Rows come in the order of their rollouts:
/// those that were there before are measured already.
void OverlayPanel::fitColumns() {
    const std::vector<RolloutRow>& rows = overlay_.rollouts().rows();
    const QFontMetrics metrics = list_->fontMetrics();
    if (fitted_ == 0 || rows.size() < fitted_) {
        fitted_ = 0;
        const std::size_t sessions = overlay_.rollouts().log() ? overlay_.rollouts().world().sessions().size() : 1;
        list_->setColumnHidden(RolloutList::session, sessions == 1);
        list_->setColumnHidden(RolloutList::robot, sessions > 1 && overlay_.rollouts().world().robots().size() == 1);
    }
    for (int column = 0; column < RolloutList::columns; ++column) {
        if (list_->isColumnHidden(column)) continue;
        const QString title = rollouts_->headerData(column, Qt::Horizontal, Qt::DisplayRole).toString();
        int& wide = widths_[static_cast<std::size_t>(column)];
        if (fitted_ == 0) wide = metrics.size(0, title).width();
        for (std::size_t row = fitted_; row < rows.size(); ++row)
            wide = std::max(wide, metrics.horizontalAdvance(rollouts_->text(rows[row], column)));
        if (RolloutList::isName(column)) wide = std::min(wide, widestName);
        // The title that it is sorted by has an arrow.
        list_->setColumnWidth(column, wide + (column == RolloutList::error ? 24 : 7));
    }
    fitted_ = rows.size();
}

QWidget* OverlayPanel::makeModels() {
    auto* part = new QWidget;
    auto* layout = new QVBoxLayout(part);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(2);
    models_ = new QTreeWidget;
    models_->setObjectName("models");
    models_->setAccessibleName(tr("Motion models and their errors"));
    models_->setHeaderLabels(
        {tr("Model"), tr("Position\n% of way"), tr("Heading\n% of turn"), tr("At end\ncm"), tr("At end\n\u00b0")});
    models_->headerItem()->setToolTip(1,
                                      tr("P: mean distance to the real robot over its path, summed over all windows"));
    models_->headerItem()->setToolTip(2, tr("Hd: mean heading error over its rotation, summed over all windows"));
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
        overlay_.models().show(static_cast<std::size_t>(models_->indexOfTopLevelItem(item)),
                               item->checkState(0) == Qt::Checked);
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

void OverlayPanel::makeList() {
    list_->setModel(rollouts_);
    list_->setObjectName("rollouts");
    list_->setAccessibleName(tr("Rollouts, by their errors"));
    list_->setRootIsDecorated(false);
    list_->setUniformRowHeights(true);
    list_->setAllColumnsShowFocus(true);
    list_->setFrameShape(QFrame::NoFrame);
    list_->setSortingEnabled(true);
    list_->sortByColumn(RolloutList::error, Qt::DescendingOrder);
    list_->header()->setStretchLastSection(true);
    list_->header()->setMinimumSectionSize(20);
    list_->setMinimumWidth(leastListWidth);
    list_->setMinimumHeight(list_->header()->sizeHint().height() + leastRows * (list_->fontMetrics().height() + 2));
    list_->setIndentation(0);
    connect(list_, &QTreeView::clicked, this, &OverlayPanel::openLine);
    connect(list_, &QTreeView::activated, this, &OverlayPanel::openLine);
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
    const QString counts = countText(overlay_.rollouts().rows());
    about_->setToolTip(counts.isEmpty()
                           ? QString()
                           : tr("In the models' errors: a robot must drive, and its ground truth be known throughout"));
    about_->setText(world ? aboutText(overlay_) + (counts.isEmpty() ? "" : '\n' + counts)
                          : tr("File \u2192 Open a real log\u2026"));
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
    fitColumns();
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
