#include "overlay_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QItemSelectionModel>
#include <QLabel>
#include <QProgressBar>
#include <QToolButton>
#include <QTreeView>
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
      figures_(new QLabel),
      shown_(new QLabel),
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
    figures_->setTextFormat(Qt::RichText);
    figures_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    layout->addWidget(figures_);
    makeList();
    layout->addWidget(list_, 1);
    shown_->setTextFormat(Qt::RichText);
    shown_->setWordWrap(true);
    shown_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    layout->addWidget(shown_);
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
    robot_ = row.robot;
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

void OverlayPanel::setRobot(std::optional<std::size_t> robot) {
    if (robot) robot_ = robot;
    refreshShown();
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
    refreshFigures();
    refreshShown();
}

void OverlayPanel::refreshFigures() {
    const Comparison* comparison = overlay_.comparison();
    if (comparison == nullptr) return figures_->setText(overlay_.error());
    const ComparedSummary& all = comparison->all;
    figures_->setText(tr("<b>P %1 %</b> &nbsp; <b>Hd %2 %</b> over %3; typically %4 cm, %5\u00b0 off at the end")
                          .arg(figure(all.counted.p, 2), figure(all.counted.hd, 2),
                               tr("%n window(s)", nullptr, static_cast<int>(all.of(CourseUse::counted))),
                               figure(100 * all.positionFinal.median, 1),
                               figure(all.headingFinal.median * 180 / std::numbers::pi, 1)));
    figures_->setWordWrap(true);
}

std::optional<std::size_t> OverlayPanel::robotShown() const {
    const auto course = overlay_.shownCourse();
    if (!course) return {};
    if (robot_ && overlay_.rowOf(*course, *robot_) != nullptr) return robot_;
    // Otherwise the one that is farthest off.
    const OverlayRow* worst = nullptr;
    for (std::size_t robot = 0; robot < overlay_.world()->world().robots().size(); ++robot) {
        const OverlayRow* row = overlay_.rowOf(*course, robot);
        if (row != nullptr && (worst == nullptr || row->position > worst->position)) worst = row;
    }
    return worst != nullptr ? std::optional(worst->robot) : std::nullopt;
}

void OverlayPanel::refreshShown() {
    const auto robot = robotShown();
    if (!robot) return shown_->clear();
    const OverlayRow& row = *overlay_.rowOf(*overlay_.shownCourse(), *robot);
    const int line = courses_->lineOf(row.request, row.robot);
    if (line >= 0) {
        list_->selectionModel()->setCurrentIndex(courses_->index(line, 0),
                                                 QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Rows);
    }
    shown_->setText(tr("<b>%1</b> from %2 s: %3 cm and %4\u00b0 off on average")
                        .arg(QString::fromStdString(overlay_.world()->world().robots()[*robot].name).toHtmlEscaped(),
                             figure(toSeconds(row.start), 1), figure(100 * row.position, 1),
                             figure(row.heading * 180 / std::numbers::pi, 1)));
}

}  // namespace mrose::gui
