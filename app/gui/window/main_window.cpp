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
#include "panels/branch_panel.h"
#include "panels/breakpoint_panel.h"
#include "panels/command_panel.h"
#include "panels/error_plot.h"
#include "panels/plot_panel.h"
#include "panels/side_view.h"
#include "reality/overlay.h"
#include "reality/overlay_panel.h"
#include "session/background_work.h"
#include "widgets/eliding_label.h"
#include "widgets/field_view.h"
#include "widgets/icons.h"
#include "widgets/inspector.h"
#include "widgets/message_bar.h"
#include "widgets/qt_text.h"
#include "widgets/rollout_strip.h"
#include "widgets/timeline_bar.h"
#include "window/dock_sizes.h"
#include "window/dock_toggle.h"
#include "window/fault_messages.h"
#include "window/focus_ring.h"
#include "window/input_keys.h"
#include "window/quiet_message.h"
#include "window/shrinking_area.h"
#include "window/theme_palette.h"
#include "window/window_memory.h"
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
      session_(new Session(this)),
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
      message_(new ElidingLabel),
      messages_(new MessageBar),
      focusRing_(new FocusRing(*this)),
      files_(new WindowFiles(*this, *messages_)),
      memory_(new WindowMemory(*this)),
      background_(new BackgroundWork(this)),
      overlay_(new Overlay(*this)),
      progress_(new WorkProgress(*this, *messages_)),
      reality_(new OverlayPanel(*overlay_)),
      strip_(new RolloutStrip),
      quiet_(new QuietMessage(view_->field())) {
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
    errors_ = new ErrorPlot(*this);
    new FaultMessages(*this, *messages_);
    new DockSizes(*this);
    new InputKeys(*this);
    setTheme(Theme::light());
    field().setEmptyText(tr("Nothing is open: Ctrl+O opens a scenario or a recording, or drop one here"));
    memory_->keepAsNew();
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
    connect(session_, &Session::shown, this, &MainWindow::update);
    // Who scrubs is not stopped.
    connect(timeline_, &TimelineBar::tickRequested, session_,
            [this](std::int64_t tick) { session_->seek(tick, false); });
    connect(&field(), &FieldView::bodySelected, inspector_, &Inspector::setBody);
    connect(&field(), &FieldView::bodySelected, command_, &CommandPanel::setRobot);
    connect(&field(), &FieldView::bodySelected, this, &MainWindow::updateTimeline);
    connect(inspector_, &Inspector::commandActivated, this, [this](qint64 issued) {
        // The state after the decision is the first that shows it.
        if (shown_) session_->seek(shown_->frame->scene().ticksOf(issued) + 1);
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
        if (shown_ && branch != shown_->branch) session_->show(branch, shown_->tick());
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
    message_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    statusBar()->addWidget(clock_);
    statusBar()->addWidget(message_, 1);
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
    const auto draw = [this](auto&... parts) { (parts->setTheme(theme_), ...); };
    draw(view_, branches_, breakpoints_, timeline_, messages_, inspector_, plots_, reality_, strip_, quiet_);
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
    say(reported_ = QString());  // what was said is about what was open before
    title_ = qtText(run.name);
    setWindowTitle(title_ + " \u2013 mrose");
    plannedTicks_ = run.setup->scene().ticksOf(run.setup->scenario->parts().duration);
    field().setSelected(std::nullopt);
    realityMarks_.setNoted({});
    plots_->setReferences({}, {});
    return session_->open(run);
}

void MainWindow::update(std::shared_ptr<const Shown> what) {
    shown_ = std::move(what);
    view_->setShown(*shown_);
    inspector_->setFrame(shown_->frame);
    plots_->setShown(shown_);
    updateTimeline();
    branches_->setShown(*shown_);
    command_->setShown(*shown_);
    if (shown_->subject) lookAtKick(*shown_->subject);
    // With nothing to be beside, it is off, and does not wait for the next branch.
    if (!shown_->beside && actions_["side_by_side"].isChecked()) {
        actions_["side_by_side"].setChecked(false);
        view_->setSideBySide(false);
    }
    updateStatus();
    emit updated();
}

/// The robot that decided to kick, and what it kicked: the object nearest to it.
void MainWindow::lookAtKick(std::size_t robot) {
    const FieldFrame& frame = *shown_->frame;
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
    if (!shown_) return;
    TimelineBar::Content content;
    content.first = shown_->first;
    content.last = shown_->last;
    content.now = shown_->tick();
    content.end = std::max(plannedTicks_, shown_->last);
    content.tickLength = shown_->frame->scene().tickLength;
    content.marks = shown_->marks;
    content.scenario = shown_->frame->scenario;
    for (const BreakpointState& state : shown_->breakpoints)
        content.breakpoints[state.breakpoint.id] = qtText(state.breakpoint.text);
    if (shown_->branch != 0) content.departed = shown_->branches[shown_->branch].departed;
    for (const BranchInfo& branch : shown_->branches)
        if (branch.parent == shown_->branch && branch.departed > 0 && !branch.superseded)
            content.branches.push_back(branch.departed);
    realityMarks_.addTo(content, *shown_, field().selected());
    timeline_->setContent(std::move(content));
}

void MainWindow::note(std::vector<TimelineBar::Content::Noted> marks) {
    realityMarks_.setNoted(std::move(marks));
    updateTimeline();
}

void MainWindow::updateStatus() {
    const bool playing = shown_ && shown_->playing;
    actions_["play"].setIcon(icon(playing ? Icon::pause : Icon::play, theme_));
    actions_["play"].setText(playing ? tr("&Pause") : tr("&Play"));
    // Keys and scripts ask for it themselves; a button that does nothing looks so.
    auto* bar = findChild<QToolBar*>("time_bar");
    for (QAction* action : bar->actions())
        if (auto* button = qobject_cast<QToolButton*>(bar->widgetForAction(action)))
            button->setEnabled(shown_ != nullptr);
    if (!shown_) return seed_->setText(tr("seed \u2013"));
    const auto offer = [&](const char* name, const QString& does, bool possible, const QString& what) {
        constexpr int widestName = 400;  // pixels
        QString quoted = fontMetrics().elidedText(what, Qt::ElideMiddle, widestName);
        actions_[name].setText(possible && !what.isEmpty() ? tr("%1: %2").arg(does, quoted.replace('&', "&&")) : does);
    };
    offer("undo", tr("&Undo"), shown_->canUndo, qtText(shown_->undoName));
    offer("redo", tr("&Redo"), shown_->canRedo, qtText(shown_->redoName));
    seed_->setText(tr("seed %1").arg(shown_->frame->state.seed));
    const Nanoseconds now = shown_->frame->scene().timeOf(shown_->tick());
    const auto& reality = shown_->frame->reality;
    clock_->setText(tr("%1   tick %2").arg(clockText(now)).arg(shown_->tick()) +
                    (reality ? tr("   log %1").arg(clockText(reality->start + now)) : QString()));
    factor_->setText(
        playing ? tr("real-time factor %1").arg(shown_->realTimeFactor, 0, 'f', shown_->realTimeFactor < 10 ? 2 : 0)
                : tr("paused"));
    if (const QString message = qtText(shown_->message); message != reported_)
        say(reported_ = message);
    else if (shown_->tick() != saidAt_)
        say(reported_);
}

void MainWindow::moveBody(std::size_t body, const Pose& pose) {
    if (!shown_) return;
    const QString name = qtText(shown_->frame->nameOf(body));
    const Pose& before = shown_->frame->poseOf(body);
    const bool turned = before.x == pose.x && before.y == pose.y;
    Edit edit{(turned ? tr("%1 turned") : tr("%1 moved")).arg(name).toStdString()};
    edit.change = [body, pose](const Scenario&, WorldState& state) {
        if (body < state.robots.size()) {
            RobotState& robot = state.robots[body];
            const Pose shift = pose * inverse(robot.pose);
            robot.pose = pose;
            robot.segment.start = shift * robot.segment.start;
            robot.segment.direction = {std::cos(robot.segment.start.heading), std::sin(robot.segment.start.heading)};
        } else {
            ObjectState& object = state.objects[body - state.robots.size()];
            object.pose = pose;
            object.velocity_W = {};
            object.roll_W = {};
        }
    };
    session_->branchOff(edit);
}

FieldView& MainWindow::field() const { return view_->field(); }

FieldView& MainWindow::besideField() const { return view_->beside(); }

void MainWindow::setSideBySide(bool on) {
    view_->setSideBySide(on);
    if (shown_) view_->setShown(*shown_);
}

QString MainWindow::askText(const QString& title, const QString& label, const QString& suggestion) {
    return QInputDialog::getText(this, title, label, QLineEdit::Normal, suggestion);
}

void MainWindow::say(const QString& text) {
    saidAt_ = shown_ ? shown_->tick() : 0;
    // While a script runs it is not shown, so that pictures are the same at any speed.
    if (text.isEmpty()) quiet_->hide();
    if (!text.isEmpty() && text != said_ && !actions_.unattended()) quiet_->say(text);
    said_ = text;
    message_->setText(text);
    message_->setToolTip(text);
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
    message_->setText(tip.isEmpty() ? said_ : tip);
    return true;
}

void MainWindow::closeEvent(QCloseEvent* event) {
    if (!files_->mayLeave([this] { close(); })) return event->ignore();
    memory_->save();
    session_->pause();
    QMainWindow::closeEvent(event);
}

}  // namespace mrose::gui
