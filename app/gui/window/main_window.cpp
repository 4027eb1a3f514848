#include "window/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QComboBox>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFileInfo>
#include <QInputDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QMimeData>
#include <QPainter>
#include <QStatusBar>
#include <QStatusTipEvent>
#include <QStyle>
#include <QTabWidget>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "actions/window_actions.h"
#include "export/view_export.h"
#include "files/window_files.h"
#include "frame/dock_sizes.h"
#include "frame/dock_toggle.h"
#include "frame/focus_ring.h"
#include "frame/input_keys.h"
#include "frame/shrinking_area.h"
#include "frame/theme_palette.h"
#include "frame/window_memory.h"
#include "panels/branch_panel.h"
#include "panels/breakpoint_panel.h"
#include "panels/command_panel.h"
#include "panels/plot_panel.h"
#include "panels/side_view.h"
#include "reality/error_plot.h"
#include "reality/overlay.h"
#include "reality/overlay_marks.h"
#include "reality/overlay_panel.h"
#include "session/background_work.h"
#include "widgets/field_view.h"
#include "widgets/icons.h"
#include "widgets/inspector.h"
#include "widgets/message_bar.h"
#include "widgets/qt_text.h"
#include "widgets/rollout_strip.h"
#include "widgets/timeline_bar.h"
#include "window/fault_messages.h"
#include "window/work_progress.h"

namespace mrose::gui {
namespace {

constexpr std::array speeds{0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 50.0, 0.0};

QString speedName(double speed) {
    if (speed == 0) return QObject::tr("as fast as possible");
    return QString::fromUtf8("\u00d7 ") + QString::number(speed, 'g', 3);
}

}  // namespace

MainWindow::MainWindow(QWidget* parent)
    : QMainWindow(parent),
      actions_(*this),
      session_(newSession()),
      view_(new SideView),
      timeline_(new TimelineBar),
      inspector_(new Inspector),
      plots_(new PlotPanel(*session_)),
      branches_(new BranchPanel),
      breakpoints_(new BreakpointPanel),
      command_(new CommandPanel),
      speed_(new QComboBox),
      seed_(new QToolButton),
      clock_(new QLabel),
      factor_(new QLabel),
      cursor_(new QLabel),
      status_(new StatusLine(*session_, actions_, view_->field())),
      messages_(new MessageBar),
      focusRing_(new FocusRing(*this)),
      memory_(new WindowMemory(*this, actions_, *session_)),
      files_(new WindowFiles(frame(), view_->field())),
      background_(new BackgroundWork(this)),
      overlay_(new Overlay(frame(), view_->field(), *files_)),
      progress_(new WorkProgress(frame(), *files_, *background_, *overlay_)),
      reality_(new OverlayPanel(*overlay_)),
      strip_(new RolloutStrip) {
    view_->setObjectName("field");
    timeline_->setObjectName("timeline");
    setWindowTitle("mrose");
    resize(1280, 800);
    setAcceptDrops(true);
    auto* middle = new QWidget;
    auto* layout = new QVBoxLayout(middle);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(view_, 1);
    messages_->standOver(*view_);
    layout->addWidget(strip_);
    layout->addWidget(timeline_);
    setCentralWidget(middle);
    makeDocks();
    makeActions();
    makeToolBar();
    makeStatusBar();
    connectAll();
    errors_ = new ErrorPlot(frame(), field(), *plots_, *findChild<QDockWidget*>("plots"), *overlay_);
    new FaultMessages(*session_, *messages_);
    new DockSizes(*this);
    connect(new InputKeys(*this), &InputKeys::takenBack, this, [this](QWidget* input) {
        if (command_->isAncestorOf(input)) command_->takeBack();
        field().setFocus(Qt::OtherFocusReason);
    });
    setTheme(Theme::light());
    field().setEmptyText(tr("Nothing is open: Ctrl+O opens a scenario or a recording, or drop one here"));
    memory_->keepAsNew();
}

/// The panels show what is shown before anyone else looks at it.
Session* MainWindow::newSession() {
    auto* session = new Session(this);
    connect(session, &Session::shown, this, &MainWindow::update);
    return session;
}

void MainWindow::makeActions() {
    actions_.setErrorHandler([this](const Error& error) {
        messages_->add({MessageBar::Kind::error, qtText(error.message())});
    });
    addFileActions(*this);
    addOverlayActions(*this);
    addEditActions(*this);
    addTimeActions(*this);
    addBranchActions(*this);
    addBreakActions(*this);
    addViewActions(*this);
    addLayerActions(*this);
    addPlotActions(*this);
    addExportActions(*this);
    actions_.addSeparator(tr("&View"));
    int number = 0;
    for (QDockWidget* dock : findChildren<QDockWidget*>()) {
        raiseInsteadOfHiding(*dock);
        actions_.adopt(
            tr("&View"),
            {"show_" + dock->objectName(), dock->windowTitle(), QKeySequence(QString("Ctrl+%1").arg(++number)),
             tr("Show or hide the panel \u201c%1\u201d").arg(dock->windowTitle())},
            dock->toggleViewAction());
    }
    addHelpActions(*this);
}

void MainWindow::connectAll() {
    // Who scrubs is not stopped.
    connect(timeline_, &TimelineBar::tickRequested, session_,
            [this](std::int64_t tick) { session_->seek(tick, false); });
    files_->setLog(*overlay_);
    connect(files_, &WindowFiles::opens, this, &MainWindow::prepare);
    connect(overlay_, &Overlay::divergencesChanged, this, &MainWindow::markDivergences);
    connect(memory_, &WindowMemory::layoutReset, this, [this] {
        if (!overlay_->isOpen()) return;
        showReality();
        errors_->showDock();
    });
    connect(&field(), &FieldView::bodySelected, inspector_, &Inspector::setBody);
    connect(&field(), &FieldView::bodySelected, command_, &CommandPanel::setRobot);
    connect(&field(), &FieldView::bodySelected, this, &MainWindow::updateTimeline);
    connect(inspector_, &Inspector::commandActivated, this, [this](qint64 issued) {
        // The state after the decision is the first that shows it.
        if (shown()) session_->seek(shown()->frame->scene().ticksOf(issued) + 1);
        command_->edit();
    });
    connect(command_, &CommandPanel::branchRequested, this, [this](const Edit& edit) {
        // To where its result is seen first; keys are the window's again.
        session_->branchOff(edit, *edit.tick + 1);
        field().setFocus();
    });
    connect(branches_, &BranchPanel::renamed, session_, [this](std::uint32_t branch, const QString& name) {
        session_->ask([branch, name = name.toStdString()](Debugger& debugger) { debugger.run().rename(branch, name); });
    });
    connect(branches_, &BranchPanel::besideRequested, session_, [this](std::uint32_t branch) {
        session_->ask([=](Debugger& debugger) { debugger.run().setBeside(branch); });
    });
    connect(branches_, &BranchPanel::branchRequested, this, [this](std::uint32_t branch) {
        if (shown() && branch != shown()->branch) session_->show(branch, shown()->tick());
    });
    connect(&field(), &FieldView::bodyMoved, this, &MainWindow::moveBody);
    connect(&field(), &FieldView::dragRefused, this,
            [this] { say(tr("Bodies are moved while the run stands: stop it first (Space)")); });
    connect(&field(), &FieldView::cursorMoved, this, [this](std::optional<Point> at) {
        cursor_->setText(at ? QString("x %1  y %2 m").arg(at->x, 0, 'f', 2).arg(at->y, 0, 'f', 2) : QString());
    });
}

/// What looks at the session from threads of its own ends before it.
MainWindow::~MainWindow() {
    delete errors_;
    delete background_;
    delete plots_;
}

void MainWindow::showReality() {
    auto* reality = findChild<QDockWidget*>("reality");
    if (!reality->isHidden()) return;
    reality->show();
    for (const char* const name : {"branches", "breakpoints", "command"})
        if (auto* dock = findChild<QDockWidget*>(name);
            !dock->isHidden() && !dock->isFloating() && dockWidgetArea(dock) == dockWidgetArea(reality))
            tabifyDockWidget(reality, dock);
    setTabPosition(Qt::LeftDockWidgetArea, QTabWidget::West);
    reality->raise();
}

void MainWindow::showDock(const char* name) {
    auto* dock = findChild<QDockWidget*>(name);
    dock->show();
    dock->raise();
}

void MainWindow::changeSpeed(int by) {
    speed_->setCurrentIndex(std::clamp(speed_->currentIndex() + by, 0, speed_->count() - 1));
}

void MainWindow::setSpeed(double speed) {
    const auto rank = [](double some) { return some > 0 ? some : std::numeric_limits<double>::infinity(); };
    int at = 0;
    while (at < speed_->count() && rank(speed_->itemData(at).toDouble()) < rank(speed)) ++at;
    if (at == speed_->count() || speed_->itemData(at).toDouble() != speed)
        speed_->insertItem(at, speedName(speed), speed);
    speed_->setCurrentIndex(at);
}

void MainWindow::makeToolBar() {
    QToolBar* bar = addToolBar(tr("Time"));
    bar->setObjectName("time_bar");
    bar->setMovable(false);
    bar->setIconSize({20, 20});
    for (const char* name :
         {"reset", "to_start", "period_back", "tick_back", "play", "tick_forward", "period_forward", "to_end"})
        bar->addAction(&actions_[name]);
    bar->addSeparator();
    for (const double speed : speeds) speed_->addItem(speedName(speed), speed);
    speed_->setCurrentIndex(3);
    speed_->setToolTip(tr("Simulated seconds per second"));
    speed_->setFocusPolicy(Qt::NoFocus);
    bar->addWidget(speed_);
    connect(speed_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
            [this](int index) { session_->setSpeed(speed_->itemData(index).toDouble()); });
    factor_->setMinimumWidth(190);
    factor_->setContentsMargins(10, 0, 0, 0);
    bar->addWidget(factor_);
    bar->addSeparator();
    seed_->setDefaultAction(&actions_["restart_with_seed"]);
    seed_->setToolButtonStyle(Qt::ToolButtonTextOnly);
    bar->addWidget(seed_);
    bar->addSeparator();
    bar->addAction(&actions_["fit"]);
    bar->addAction(&actions_["follow"]);
}

void MainWindow::makeDocks() {
    const auto dock = [this](const char* name, const QString& title, QWidget* content, Qt::DockWidgetArea area) {
        auto* made = new QDockWidget(title, this);
        made->setObjectName(name);
        made->setWidget(new ShrinkingArea(content));
        addDockWidget(area, made);
        return made;
    };
    dock("branches", tr("Branches"), branches_, Qt::LeftDockWidgetArea);
    dock("breakpoints", tr("Breakpoints"), breakpoints_, Qt::LeftDockWidgetArea);
    dock("command", tr("Change a command"), command_, Qt::LeftDockWidgetArea);
    dock("reality", tr("Reality"), reality_, Qt::LeftDockWidgetArea)->hide();
    dock("inspector", tr("Inspector"), inspector_, Qt::RightDockWidgetArea);
    dock("plots", tr("Plots"), plots_, Qt::BottomDockWidgetArea)->hide();
    setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
    setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
    resizeDocks({findChild<QDockWidget*>("branches"), findChild<QDockWidget*>("inspector")}, {250, 330},
                Qt::Horizontal);
    resizeDocks({findChild<QDockWidget*>("branches"), findChild<QDockWidget*>("breakpoints")}, {350, 160},
                Qt::Vertical);
}

void MainWindow::makeStatusBar() {
    statusBar()->setSizeGripEnabled(false);
    clock_->setMinimumWidth(170);
    cursor_->setMinimumWidth(140);
    statusBar()->addWidget(clock_);
    statusBar()->addWidget(status_, 1);
    auto* recording = new QLabel;
    recording->setObjectName("recording");
    recording->hide();
    connect(files_, &WindowFiles::recordingTo, recording, [recording](const QString& path) {
        constexpr int widestName = 200;  // pixels
        const QString name =
            recording->fontMetrics().elidedText(QFileInfo(path).fileName(), Qt::ElideMiddle, widestName);
        recording->setText("<span style='color:#d33'>\u25cf</span> " + tr("recording %1").arg(name.toHtmlEscaped()));
        recording->setToolTip(path);
        recording->setVisible(!path.isEmpty());
    });
    statusBar()->addPermanentWidget(recording);
    statusBar()->addPermanentWidget(cursor_);
}

void MainWindow::setTheme(const Theme& theme) {
    theme_ = theme;
    QApplication::setPalette(paletteOf(theme_));
    focusRing_->setTheme(theme_);
    const auto draw = [this](auto*... parts) { (parts->setTheme(theme_), ...); };
    draw(view_, branches_, breakpoints_, timeline_, messages_, inspector_, plots_, reality_, strip_,
         &status_->quietMessage());
    const std::initializer_list<std::pair<const char*, Icon>> icons{{"tick_forward", Icon::tickForward},
                                                                    {"tick_back", Icon::tickBack},
                                                                    {"period_forward", Icon::periodForward},
                                                                    {"period_back", Icon::periodBack},
                                                                    {"to_start", Icon::toStart},
                                                                    {"to_end", Icon::toEnd},
                                                                    {"reset", Icon::reset},
                                                                    {"fit", Icon::fit},
                                                                    {"follow", Icon::follow}};
    for (const auto& [name, which] : icons) actions_[name].setIcon(icon(which, theme_));
    updateStatus();
}

Expected<void> MainWindow::open(const QString& name) { return files_->openNow(OpenRequest{name.toStdString()}); }

std::uint64_t MainWindow::show(const OpenRun& run) {
    prepare(run);
    return session_->open(run);
}

void MainWindow::prepare(const OpenRun& run) {
    status_->forget();
    title_ = qtText(run.name);
    setWindowTitle(title_ + " \u2013 mrose");
    plannedTicks_ = run.setup->scene().ticksOf(run.setup->scenario->parts().duration);
    field().setSelected(std::nullopt);
    realityMarks_.setNoted({});
    plots_->setReferences({}, {});
}

void MainWindow::update() {
    const Shown& now = *shown();
    view_->setShown(now);
    inspector_->setFrame(now.frame);
    plots_->setShown(shownPointer());
    updateTimeline();
    branches_->setShown(now);
    command_->setShown(now);
    if (now.subject) lookAtKick(*now.subject);
    // With nothing to be beside, it is off, and does not wait for the next branch.
    if (!now.beside && actions_["side_by_side"].isChecked()) {
        actions_["side_by_side"].setChecked(false);
        view_->setSideBySide(false);
    }
    updateStatus();
}

/// The robot that decided to kick, and what it kicked: the object nearest to it.
void MainWindow::lookAtKick(std::size_t robot) {
    const FieldFrame& frame = *shown()->frame;
    const auto away = [&](std::size_t body) {
        return distance(position(frame.poseOf(body)), position(frame.poseOf(robot)));
    };
    std::vector<std::size_t> bodies{robot};
    for (std::size_t body = frame.state.robots.size(); body < frame.scene().bodyCount(); ++body)
        if (bodies.size() == 1 || away(body) < away(bodies[1])) bodies = {robot, body};
    field().setSelected(robot);
    field().lightUp(bodies);
}

void MainWindow::updateTimeline() {
    if (!shown()) return;
    TimelineBar::Content content;
    content.first = shown()->first;
    content.last = shown()->last;
    content.now = shown()->tick();
    content.end = std::max(plannedTicks_, shown()->last);
    content.tickLength = shown()->frame->scene().tickLength;
    content.marks = shown()->marks;
    content.scenario = shown()->frame->scenario;
    for (const BreakpointState& state : shown()->breakpoints)
        content.breakpoints[state.breakpoint.id] = qtText(state.breakpoint.text);
    if (shown()->branch != 0) content.departed = shown()->branches[shown()->branch].departed;
    for (const BranchInfo& branch : shown()->branches)
        if (branch.parent == shown()->branch && branch.departed > 0 && !branch.superseded)
            content.branches.push_back(branch.departed);
    realityMarks_.addTo(content, *shown(), field().selected());
    timeline_->setContent(std::move(content));
}

void MainWindow::note(std::vector<TimelineBar::Content::Noted> marks) {
    realityMarks_.setNoted(std::move(marks));
    updateTimeline();
}

void MainWindow::markDivergences() {
    OverlayMarks marks = shown() != nullptr ? marksOf(*overlay_, shown()->frame->scene()) : OverlayMarks{};
    note(std::move(marks.noted));
    plots_->setReferences(std::move(marks.levels), marks.instant);
}

void MainWindow::updateStatus() {
    const bool playing = shown() && shown()->playing;
    actions_["play"].setIcon(icon(playing ? Icon::pause : Icon::play, theme_));
    actions_["play"].setText(playing ? tr("&Pause") : tr("&Play"));
    // Keys and scripts ask for it themselves; a button that does nothing looks so.
    auto* bar = findChild<QToolBar*>("time_bar");
    for (QAction* action : bar->actions())
        if (auto* button = qobject_cast<QToolButton*>(bar->widgetForAction(action)))
            button->setEnabled(shown() != nullptr);
    if (!shown()) return seed_->setText(tr("seed \u2013"));
    const auto offer = [&](const char* name, const QString& does, bool possible, const QString& what) {
        constexpr int widestName = 400;  // pixels
        QString quoted = fontMetrics().elidedText(what, Qt::ElideMiddle, widestName);
        actions_[name].setText(possible && !what.isEmpty() ? tr("%1: %2").arg(does, quoted.replace('&', "&&")) : does);
    };
    offer("undo", tr("&Undo"), shown()->canUndo, qtText(shown()->undoName));
    offer("redo", tr("&Redo"), shown()->canRedo, qtText(shown()->redoName));
    seed_->setText(tr("seed %1").arg(shown()->frame->state.seed));
    const Nanoseconds now = shown()->frame->scene().timeOf(shown()->tick());
    const auto& reality = shown()->frame->reality;
    clock_->setText(tr("%1   tick %2").arg(clockText(now)).arg(shown()->tick()) +
                    (reality ? tr("   log %1").arg(clockText(reality->start + now)) : QString()));
    factor_->setText(
        playing ? tr("real-time factor %1").arg(shown()->realTimeFactor, 0, 'f', shown()->realTimeFactor < 10 ? 2 : 0)
                : tr("paused"));
}

void MainWindow::moveBody(std::size_t body, const Pose& pose) {
    if (shown()) session_->branchOff(mrose::moveBody(*shown()->frame, body, pose));
}

FieldView& MainWindow::field() const { return view_->field(); }

FieldView& MainWindow::besideField() const { return view_->beside(); }

void MainWindow::setSideBySide(bool on) {
    view_->setSideBySide(on);
    if (shown()) view_->setShown(*shown());
}

QString MainWindow::askText(const QString& title, const QString& label, const QString& suggestion) {
    return QInputDialog::getText(this, title, label, QLineEdit::Normal, suggestion);
}

Expected<void> MainWindow::saveImage(const QString& path, QWidget* part) {
    QWidget& drawn = part != nullptr ? *part : *this;
    return writePicture({drawn.size(), logicalDpiX(), windowTitle(),
                         [&drawn](QPainter& painter) {
                             drawn.render(&painter, {}, {}, QWidget::DrawWindowBackground | QWidget::DrawChildren);
                         }},
                        path, 1);
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event) {
    if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void MainWindow::dropEvent(QDropEvent* event) {
    event->acceptProposedAction();
    files_->drop(*event->mimeData());
}

/// What an action does stands in the place of the message for as long as it is pointed at, beside the clock.
bool MainWindow::event(QEvent* event) {
    if (event->type() != QEvent::StatusTip) return QMainWindow::event(event);
    const QString tip = static_cast<QStatusTipEvent*>(event)->tip();
    status_->showTip(tip);
    return true;
}

void MainWindow::closeEvent(QCloseEvent* event) {
    if (!files_->mayLeave([this] { close(); })) return event->ignore();
    memory_->save();
    session_->pause();
    QMainWindow::closeEvent(event);
}

}  // namespace mrose::gui
