#include "window/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFileInfo>
#include <QLabel>
#include <QMimeData>
#include <QStatusBar>
#include <QStatusTipEvent>
#include <QVBoxLayout>

#include "actions/window_actions.h"
#include "files/window_files.h"
#include "frame/docks.h"
#include "frame/fault_messages.h"
#include "frame/focus_ring.h"
#include "frame/input_keys.h"
#include "frame/theme_palette.h"
#include "frame/window_memory.h"
#include "frame/work_progress.h"
#include "panels/branch_panel.h"
#include "panels/breakpoint_panel.h"
#include "panels/command_panel.h"
#include "panels/plot_panel.h"
#include "panels/side_view.h"
#include "panels/time_bar.h"
#include "reality/error_plot.h"
#include "reality/field_bands.h"
#include "reality/overlay.h"
#include "reality/overlay_panel.h"
#include "reality/run_timeline.h"
#include "session/background_work.h"
#include "widgets/field_view.h"
#include "widgets/fixed_text.h"
#include "widgets/inspector.h"
#include "widgets/message_bar.h"
#include "widgets/qt_text.h"
#include "widgets/rollout_strip.h"
#include "widgets/timeline_bar.h"

namespace mrose::gui {

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
      clock_(new QLabel),
      cursor_(new QLabel),
      status_(new StatusLine(*session_, actions_, view_->field())),
      messages_(new MessageBar),
      focusRing_(new FocusRing(*this)),
      docks_(new Docks(*this, view_->field())),
      memory_(new WindowMemory(*this, actions_, *session_, *docks_)),
      frame_{*this, *session_, actions_, *messages_, *status_, *memory_},
      time_(new TimeBar(frame_)),
      files_(new WindowFiles(frame_, view_->field())),
      background_(new BackgroundWork(this)),
      overlay_(new Overlay(frame_, view_->field(), *files_)),
      progress_(new WorkProgress(frame_, *background_)),
      reality_(new OverlayPanel(*overlay_)),
      strip_(new RolloutStrip),
      runTimeline_(new RunTimeline(frame_, *timeline_, view_->field(), *plots_, *overlay_)),
      bands_(new FieldBands(frame_, view_->field(), *overlay_)),
      exports_{frame_, view_->field(), *plots_, *files_, *overlay_, *background_, *progress_} {
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
    errors_ = new ErrorPlot(frame_, field(), *plots_, (*docks_)["plots"], *overlay_, *bands_);
    makeActions();
    addToolBar(time_);
    time_->addActions();
    makeStatusBar();
    connectAll();
    new FaultMessages(*session_, *messages_);
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
    addFileActions(frame_, field(), *files_, *overlay_, *progress_);
    addOverlayActions(frame_, field(), *overlay_, *reality_, *strip_);
    addEditActions(frame_, field());
    addTimeActions(frame_, field(), *timeline_, *overlay_, *time_);
    addBranchActions(frame_, *view_, *branches_, *command_);
    addBreakActions(frame_, field(), *breakpoints_, *overlay_);
    addViewActions(frame_, field(), [this](const Theme& theme) { setTheme(theme); });
    addLayerActions(frame_, field(), *bands_);
    addPlotActions(frame_, field(), *plots_, *inspector_, *overlay_, *reality_, *errors_);
    addExportActions(exports_);
    actions_.addSeparator(tr("&View"));
    int number = 0;
    for (QDockWidget* dock : findChildren<QDockWidget*>()) {
        actions_.adopt(
            tr("&View"),
            {"show_" + dock->objectName(), dock->windowTitle(), QKeySequence(QString("Ctrl+%1").arg(++number)),
             tr("Show or hide the panel \u201c%1\u201d").arg(dock->windowTitle())},
            dock->toggleViewAction());
    }
    addHelpActions(frame_, field(), *plots_, *command_, *overlay_);
}

void MainWindow::connectAll() {
    files_->setLog(*overlay_);
    progress_->setEnds([this] { return files_->cancel(); }, [this] { return overlay_->cancel(); });
    connect(&overlay_->searcher(), &RolloutSearcher::searching, progress_, &WorkProgress::report);
    connect(session_, &Session::opening, this, [this](const OpenedRun& run) {
        setWindowTitle(qtText(run.name) + " \u2013 mrose");
        field().setSelected(std::nullopt);
        field().viewport().fit();
    });
    connect(&field(), &FieldView::bodySelected, inspector_, &Inspector::setBody);
    connect(&field(), &FieldView::bodySelected, status_, &StatusLine::done);
    connect(&field(), &FieldView::bodySelected, docks_, [this](auto body) { docks_->setEmpty("inspector", !body); });
    connect(&field(), &FieldView::bodySelected, command_, &CommandPanel::setRobot);
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
        session_->ask([branch, name = name.toStdString()](Debugger& debugger) {
            debugger.run().branches().rename(branch, name);
        });
    });
    connect(branches_, &BranchPanel::besideRequested, session_, [this](std::uint32_t branch) {
        session_->ask([=](Debugger& debugger) { debugger.run().setBeside(branch); });
    });
    connect(branches_, &BranchPanel::branchRequested, this, [this](std::uint32_t branch) {
        if (shown() && branch != shown()->branch) session_->show(branch, shown()->tick());
    });
    connect(&field(), &FieldView::cursorMoved, this, [this](std::optional<Point> at) {
        cursor_->setText(at ? QString("x %1  y %2 m").arg(at->x, 0, 'f', 2).arg(at->y, 0, 'f', 2) : QString());
    });
    connect(new InputKeys(*this), &InputKeys::takenBack, this, [this](QWidget* input) {
        if (command_->isAncestorOf(input)) command_->takeBack();
        field().setFocus(Qt::OtherFocusReason);
    });
}

/// What looks at the session from threads of its own ends before it.
MainWindow::~MainWindow() {
    delete errors_;
    delete background_;
    delete plots_;
}

void MainWindow::makeDocks() {
    docks_->add("branches", tr("Branches"), branches_, Qt::LeftDockWidgetArea, {250, 350}, 120);
    docks_->add("breakpoints", tr("Breakpoints"), breakpoints_, Qt::LeftDockWidgetArea, {250, 160});
    docks_->add("command", tr("Change a command"), command_, Qt::LeftDockWidgetArea, {250, 240});
    docks_->add("reality", tr("Reality"), reality_, Qt::LeftDockWidgetArea, {490, 600}).hide();
    docks_->add("inspector", tr("Inspector"), inspector_, Qt::RightDockWidgetArea, {330, 560});
    docks_->add("plots", tr("Plots"), plots_, Qt::BottomDockWidgetArea, {400, 240}).hide();
    docks_->setEmpty("inspector", true);
    connect(session_, &Session::shown, docks_,
            [this] { docks_->setEmpty("branches", listedBranches(shown()->branches) <= 1); });
    connect(overlay_, &Overlay::changed, docks_,
            [this] { docks_->setLayout(overlay_->rollouts().log() ? Docks::Layout::log : Docks::Layout::run); });
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
    connect(&files_->saver(), &RunSaver::recordingTo, recording, [recording](const QString& path) {
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
    QApplication::setPalette(paletteOf(theme));
    const auto draw = [&](auto*... parts) { (parts->setTheme(theme), ...); };
    draw(focusRing_, view_, branches_, breakpoints_, timeline_, messages_, inspector_, plots_, reality_, strip_, time_,
         &status_->quietMessage());
}

Expected<void> MainWindow::open(const QString& name) { return files_->openNow(OpenRequest{name.toStdString()}); }

void MainWindow::update() {
    const Shown& now = *shown();
    view_->setShown(now);
    inspector_->setFrame(now.frame);
    plots_->setShown(session_->current());
    branches_->setShown(now);
    command_->setShown(now);
    if (now.subject) lookAtKick(*now.subject);
    const Nanoseconds time = now.frame->scene().timeOf(now.tick());
    const auto& reality = now.frame->reality;
    clock_->setText(tr("%1   tick %2").arg(clockText(time)).arg(now.tick()) +
                    (reality ? tr("   log %1").arg(logTimeText(reality->start + time)) : QString()));
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

FieldView& MainWindow::field() const { return view_->field(); }

ScriptedWindow MainWindow::scripted() const {
    return {frame_, field(), *plots_, *errors_, *overlay_, *reality_, *time_, exports_};
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
    if (!files_->saver().mayLeave([this] { close(); })) return event->ignore();
    memory_->save();
    session_->pause();
    QMainWindow::closeEvent(event);
}

}  // namespace mrose::gui
