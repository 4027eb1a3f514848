#include "overlay_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QItemSelectionModel>
#include <QLabel>
#include <QMenu>
#include <QProgressBar>
#include <QSignalBlocker>
#include <QToolButton>
#include <QTreeView>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <cmath>
#include <numbers>

namespace mrose::gui {
namespace {

constexpr double longestLog = 1e6;  // s

QString figure(double value, int decimals) {
    return std::isfinite(value) ? QString::number(value, 'f', decimals) : QString::fromUtf8("\u2013");
}

QString minutes(Nanoseconds time) {
    const auto seconds = static_cast<int>(toSeconds(time));
    if (seconds < 3600) return QString("%1:%2 min").arg(seconds / 60).arg(seconds % 60, 2, 10, QChar('0'));
    return QString("%1:%2 h").arg(seconds / 3600).arg(seconds / 60 % 60, 2, 10, QChar('0'));
}

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
      courses_(new CourseList(this)),
      log_(new QLabel),
      about_(new QLabel),
      causes_(new CausePanel(overlay)),
      cut_(new QComboBox),
      startLabel_(new QLabel(tr("from"))),
      restarts_(new QCheckBox(tr("Play on into the next course"))),
      progress_(makeProgress()),
      list_(new QTreeView) {
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
    cut_->addItem(tr("Restart every"), static_cast<int>(OverlayPlan::Cut::every));
    cut_->addItem(tr("One course of"), static_cast<int>(OverlayPlan::Cut::once));
    cut_->addItem(tr("Windows of"), static_cast<int>(OverlayPlan::Cut::windows));
    cut_->setToolTip(tr("Where the simulated robots start: again and again, once, or as mrose evaluate cuts the log"));
    length_ = secondsBox(0.1, longestLog, tr("How long a course is"));
    start_ =
        secondsBox(0, longestLog, tr("Where in the log the first course begins, after all of its robots are there"));
    line->addWidget(cut_);
    line->addWidget(length_);
    line->addWidget(startLabel_);
    line->addWidget(start_);
    line->addStretch(1);
    layout->addLayout(line);
    restarts_->setToolTip(tr("At the end of a course the next one begins, from where the real robots then are"));
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
    bar_->setFormat(tr("comparing %p %"));
    auto* stop = new QToolButton;
    stop->setText(tr("Cancel"));
    stop->setToolTip(tr("Compare no more courses (Esc)"));
    connect(stop, &QToolButton::clicked, this, [this] { overlay_.cancel(); });
    layout->addWidget(bar_, 1);
    layout->addWidget(stop);
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
    models_->setHeaderLabels({tr("Model"), tr("P %"), tr("Hd %"), tr("end cm"), tr("end \u00b0")});
    models_->headerItem()->setToolTip(1, tr("Mean distance to the real robot over its path, summed over all windows"));
    models_->headerItem()->setToolTip(2, tr("Mean heading error over its rotation, summed over all windows"));
    models_->headerItem()->setToolTip(3, tr("Distance at the end of a course, the median"));
    models_->headerItem()->setToolTip(4, tr("Heading error at the end of a course, the median"));
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
        models_->header()->resizeSection(column, models_->fontMetrics().horizontalAdvance("end cm") + 14);
    }
    connect(models_, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item) {
        overlay_.showModel(static_cast<std::size_t>(models_->indexOfTopLevelItem(item)),
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
    free_ = new QCheckBox(tr("without contacts"));
    free_->setToolTip(tr("Robots go through everything, on the windows of mrose evaluate; otherwise as mrose compare"));
    connect(free_, &QCheckBox::toggled, this, &OverlayPanel::refreshModels);
    line->addWidget(add);
    line->addStretch(1);
    line->addWidget(free_);
    layout->addWidget(models_);
    layout->addLayout(line);
    return part;
}

void OverlayPanel::fillModelMenu(QMenu& menu) {
    menu.clear();
    if (!overlay_.world()) return;
    for (const std::string& known : modelNames(*overlay_.world()))
        menu.addAction(QString::fromStdString(known), this, [this, known] { overlay_.addModel(known); });
    menu.addSeparator();
    menu.addAction(tr("From a file\u2026"), this, [this] { emit modelFileWanted(); });
}

void OverlayPanel::makeList() {
    list_->setModel(courses_);
    list_->setObjectName("courses");
    list_->setAccessibleName(tr("Courses, by their errors"));
    list_->setRootIsDecorated(false);
    list_->setUniformRowHeights(true);
    list_->setAllColumnsShowFocus(true);
    list_->setFrameShape(QFrame::NoFrame);
    list_->setSortingEnabled(true);
    list_->sortByColumn(CourseList::error, Qt::DescendingOrder);
    list_->header()->setStretchLastSection(true);
    list_->header()->setMinimumSectionSize(20);
    list_->setIndentation(0);
    connect(list_, &QTreeView::clicked, this, &OverlayPanel::openLine);
    connect(list_, &QTreeView::activated, this, &OverlayPanel::openLine);
}

void OverlayPanel::openLine(const QModelIndex& index) {
    const OverlayRow& row = courses_->row(index.row());
    overlay_.show(row.request, row.robot);
}

void OverlayPanel::applyPlan() {
    if (filling_) return;
    OverlayPlan plan;
    plan.cut = static_cast<OverlayPlan::Cut>(cut_->currentData().toInt());
    plan.length = length_->value();
    plan.start = start_->value();
    if (const auto done = overlay_.setPlan(plan); !done) {
        about_->setText(QString::fromStdString(done.error().message()));
        return;
    }
    refresh();
}

void OverlayPanel::setTheme(const Theme& theme) {
    theme_ = theme;
    refresh();
}

void OverlayPanel::refresh() {
    const OverlayWorldPointer& world = overlay_.world();
    setEnabled(world != nullptr);
    filling_ = true;
    log_->setText(world ? QString::fromStdString(world->name()) : tr("No log is open"));
    log_->setToolTip(world ? QString::fromStdString(world->place) : QString());
    about_->setText(world ? tr("%n robot(s)", nullptr, static_cast<int>(world->world().robots().size())) + ", " +
                                tr("%n course(s)", nullptr, static_cast<int>(overlay_.requests().size())) + ", " +
                                minutes(world->world().takes().front().length)
                          : tr("File \u2192 Open a real log\u2026"));
    const OverlayPlan& plan = overlay_.plan();
    cut_->setCurrentIndex(cut_->findData(static_cast<int>(plan.cut)));
    length_->setValue(plan.length);
    start_->setValue(plan.start);
    const bool windows = plan.cut == OverlayPlan::Cut::windows;
    start_->setVisible(!windows);
    startLabel_->setVisible(!windows);
    restarts_->setVisible(plan.cut == OverlayPlan::Cut::every);
    restarts_->setChecked(overlay_.restarts());
    filling_ = false;
    progress_->setVisible(world && overlay_.share() < 1);
    bar_->setValue(static_cast<int>(100 * overlay_.share()));
    if (listedOf_ != world || listed_ != overlay_.rows().size() || overlay_.comparison()) {
        const bool first = listed_ == 0;
        courses_->setRows(world, overlay_.rows());
        listed_ = overlay_.rows().size();
        listedOf_ = world;
        if (first && listed_ > 0)
            for (int column = 0; column < CourseList::columns; ++column) list_->resizeColumnToContents(column);
    }
    models_->setVisible(world != nullptr);
    refreshModels();
    selectShown();
    causes_->refresh();
}

/// The models' figures: with contacts as `mrose compare` has them, or without as `mrose evaluate`.
void OverlayPanel::refreshModels() {
    const QSignalBlocker quiet(models_);
    models_->clear();
    std::size_t colour = 0;
    for (std::size_t i = 0; i < overlay_.models().size(); ++i) {
        const OverlayModel& model = overlay_.models()[i];
        auto* item = new QTreeWidgetItem({QString::fromStdString(model.name)});
        const auto set = [&](int column, double value, int decimals) {
            item->setText(column, figure(value, decimals));
            item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
        };
        const Summary* const through = free_->isChecked() && model.evaluated ? &*model.evaluated : nullptr;
        const ComparedSummary* const with = !free_->isChecked() && model.compared ? &*model.compared : nullptr;
        if (through != nullptr || with != nullptr) {
            const Summary& summary = through != nullptr ? *through : with->counted;
            set(1, summary.p, 2);
            set(2, summary.hd, 2);
            set(3, 100 * (through != nullptr ? summary.positionFinal : with->positionFinal).median, 1);
            set(4, (through != nullptr ? summary.headingFinal : with->headingFinal).median * 180 / std::numbers::pi, 1);
            item->setToolTip(1, tr("over %n window(s)", nullptr, static_cast<int>(summary.windows)));
        } else {
            item->setText(1, QString::fromUtf8("\u2026"));
        }
        if (i > 0) {
            item->setFlags(item->flags() | Qt::ItemIsUserCheckable);
            item->setCheckState(0, model.shown ? Qt::Checked : Qt::Unchecked);
            if (model.shown) item->setData(0, Qt::DecorationRole, modelColour(colour++));
        }
        item->setToolTip(0, i == 0 ? tr("The scenario's own model: the filled robots") : tr("Drawn in this colour"));
        models_->addTopLevelItem(item);
    }
    const int line = models_->fontMetrics().height() + 5;
    const int lines = std::clamp(models_->topLevelItemCount(), 1, 5);
    models_->setFixedHeight((lines + 1) * line + 4);
}

/// The shown course in the list.
void OverlayPanel::selectShown() {
    const OverlayRow* const row = overlay_.shownRow();
    const int line = row != nullptr ? courses_->lineOf(row->request, row->robot) : -1;
    if (line < 0) return list_->selectionModel()->clear();
    list_->selectionModel()->setCurrentIndex(courses_->index(line, 0),
                                             QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
}

}  // namespace mrose::gui
