#include "reality/error_plot.h"

#include <QAction>
#include <QDockWidget>
#include <QEvent>
#include <algorithm>
#include <numbers>

#include "frame/window_memory.h"
#include "reality/expected_numbers.h"
#include "reality/field_bands.h"
#include "reality/overlay.h"
#include "session/session.h"
#include "widgets/field_view.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

constexpr std::int64_t mostPoints = 2000;  // of a model's rollout: more than there are pixels

bool has(const std::vector<ValueKey>& keys, const ValueKey& key) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

/// In the unit that is plotted.
double plottedError(const PoseError& error, const std::string& quantity) {
    const bool position = quantity == positionErrorQuantity || quantity == modelPositionErrorQuantity;
    return position ? 100 * error.position : error.heading * 180 / std::numbers::pi;
}

QVector<QPointF> errorsAlong(const ComparedRollout& rollout, const std::string& quantity, Nanoseconds tickLength) {
    QVector<QPointF> points;
    const double ticks = static_cast<double>(WindowOptions{}.step) / static_cast<double>(tickLength);
    for (std::size_t k = 0; k < rollout.errors.position.size(); ++k)
        points.append({static_cast<double>(k + 1) * ticks,
                       plottedError({rollout.errors.position[k], rollout.errors.heading[k]}, quantity)});
    return points;
}

QVector<QPointF> errorsAlong(const Reality& reality, const Reality::ModelRollout& model, std::size_t robot,
                             const std::string& quantity, std::int64_t end, Nanoseconds tickLength) {
    QVector<QPointF> points;
    for (std::int64_t tick = 0; tick <= end; tick += std::max<std::int64_t>(1, end / mostPoints)) {
        const auto error = reality.modelError(model, robot, tick * tickLength);
        points.append({static_cast<double>(tick),
                       error ? plottedError(*error, quantity) : std::numeric_limits<double>::quiet_NaN()});
    }
    return points;
}

}  // namespace

std::vector<ValueKey> errorKeysOf(const Reality& reality, const std::string& robot) {
    std::vector<ValueKey> keys;
    for (const auto& [own, ofModel] : {std::pair{positionErrorQuantity, modelPositionErrorQuantity},
                                       {headingErrorQuantity, modelHeadingErrorQuantity}}) {
        keys.push_back({own, robot});
        for (const Reality::ModelRollout& model : reality.models) keys.push_back({ofModel, robot, model.name});
    }
    return keys;
}

ErrorPlot::ErrorPlot(const WindowFrame& frame, const FieldView& field, PlotPanel& plots, QDockWidget& dock,
                     Overlay& overlay, FieldBands& bands)
    : QObject(&frame.window),
      frame_(frame),
      field_(field),
      plots_(plots),
      dock_(dock),
      overlay_(overlay),
      bands_(bands) {
    connect(&bands, &FieldBands::rolloutChanged, this, &ErrorPlot::follow);
    connect(&overlay, &Overlay::changed, this, &ErrorPlot::follow);
    connect(&overlay, &Overlay::closed, &plots, &PlotPanel::removeReal);
    connect(&frame.session, &Session::shown, this, &ErrorPlot::follow);
    connect(&field, &FieldView::bodySelected, this, &ErrorPlot::follow);
    connect(&frame.memory, &WindowMemory::layoutReset, this, [this] {
        if (overlay_.isOpen()) showDock();
    });
    connect(&plots, &PlotPanel::changed, this, [this] {
        const std::vector<ValueKey>& keys = plots_.keys();
        const auto removed = [&](const ValueKey& key) { return !has(keys, key); };
        if (!changing_ && std::any_of(own_.begin(), own_.end(), removed)) {
            on_ = false;
            own_.clear();
        }
    });
    dock.installEventFilter(this);
    connect(dock.toggleViewAction(), &QAction::triggered, this, [this](bool shown) {
        if (!shown) return;
        frame_.memory.setErrorPlot(true);
        follow();
    });
}

void ErrorPlot::setOn(bool on) {
    on_ = on;
    if (on) frame_.memory.setErrorPlot(true);
    follow();
}

void ErrorPlot::showDock() {
    if (!frame_.memory.errorPlot()) return;
    dock_.show();
    dock_.raise();
}

/// The user closed the plots.
bool ErrorPlot::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Close && rollout_) frame_.memory.setErrorPlot(false);
    return QObject::eventFilter(watched, event);
}

void ErrorPlot::follow() {
    const Overlay& overlay = overlay_;
    if (world_ != overlay.rollouts().log().get()) {
        world_ = overlay.rollouts().log().get();
        // A log that is read again is the same one.
        on_ = on_ || frame_.session.current() == nullptr || frame_.session.current()->run != run_;
        run_ = 0;
        rollout_ = nullptr;
        computing_.drop();
    }
    // Another rollout may be on its way: until it is there, nothing changes.
    if (world_ != nullptr && (!overlay.rollouts().shown() || frame_.session.current() == nullptr)) return;
    if (world_ != nullptr && run_ != frame_.session.current()->run) lookAtRollout();
    plot();
}

void ErrorPlot::lookAtRollout() {
    run_ = frame_.session.current()->run;
    computing_.drop();
    showDock();
    computing_.run(
        [log = overlay_.rollouts().log(),
         request = overlay_.rollouts().requests()[*overlay_.rollouts().shown()]](const GoesOn& goesOn) {
            ComparisonOptions options;
            options.seed = log->seed;
            options.progress = [&](std::span<const ComparedRollout>, double) { return goesOn(); };
            return compare(log->world(), {&request, 1}, options);
        },
        [this](Expected<Comparison> compared) {
            rollout_ = compared ? std::make_shared<const Comparison>(std::move(*compared)) : nullptr;
            plot();
        });
}

/// In Comparison::rollouts: the one that is asked about; until that is known the selected one, or the worst.
std::optional<std::size_t> ErrorPlot::robot() const {
    if (!rollout_) return {};
    const auto asked = overlay_.rollouts().robot();
    const auto selected = field_.selected();
    const FieldFrame& frame = *frame_.session.current()->frame;
    std::optional<std::size_t> worst;
    for (std::size_t i = 0; i < rollout_->rollouts.size(); ++i) {
        const ComparedRollout& rollout = rollout_->rollouts[i];
        if (rollout.use == RolloutUse::absent) continue;
        if (asked && *asked == rollout.robot) return i;
        if (!asked && selected && frame.nameOf(*selected) == rollout_->robots[rollout.robot].name) return i;
        if (!worst || knownMean(rollout) > knownMean(rollout_->rollouts[*worst])) worst = i;
    }
    return worst;
}

void ErrorPlot::plot() {
    const std::shared_ptr<const Shown> shown = frame_.session.current();
    const auto which = robot();
    Plotted now{rollout_, shown ? shown->frame->reality : nullptr, which,
                shown && shown->branch == overlay_.shown().comparedBranch(), on_ && frame_.memory.errorPlot()};
    if (now.compared) now.bands = bands_.ofRollout();
    if (plotted_ == now) return;
    plotted_ = now;
    std::vector<ValueKey> wanted;
    if (now.on && which && now.reality)
        wanted = errorKeysOf(*now.reality, rollout_->robots[rollout_->rollouts[*which].robot].name);
    changing_ = true;
    plots_.setForesight(foresight(which));
    plots_.replace(own_, wanted);
    changing_ = false;
    own_ = std::move(wanted);
}

PlotPanel::Foresight ErrorPlot::foresight(std::optional<std::size_t> which) const {
    PlotPanel::Foresight known;
    if (!which || !plotted_->reality) return known;
    const ComparedRollout& rollout = rollout_->rollouts[*which];
    const std::string& name = rollout_->robots[rollout.robot].name;
    const Reality& reality = *plotted_->reality;
    const Scene& scene = frame_.session.current()->frame->scene();
    known.run = frame_.session.current()->run;
    known.end = scene.ticksOf(rollout_->requests.front().steps * WindowOptions{}.step);
    known.model = qtText(overlay_.models().all().front().name);
    const auto real = std::find_if(reality.robots.begin(), reality.robots.end(),
                                   [&](const Reality::Robot& robot) { return robot.name == name; });
    for (const ValueKey& key : errorKeysOf(reality, name)) {
        const auto model = std::find_if(reality.models.begin(), reality.models.end(),
                                        [&](const Reality::ModelRollout& one) { return one.name == key.of; });
        // What becomes of a branch has not been compared.
        if (key.of.empty() && plotted_->compared)
            known.ahead[key] = errorsAlong(rollout, key.quantity, scene.tickLength);
        else if (model != reality.models.end() && real != reality.robots.end())
            known.ahead[key] = errorsAlong(reality, *model, static_cast<std::size_t>(real - reality.robots.begin()),
                                           key.quantity, known.end, scene.tickLength);
    }
    if (plotted_->bands) known.expected = expectedOf(*plotted_->bands, scene);
    return known;
}

void ErrorPlot::settle() {
    bands_.settle();
    computing_.settle();
}

}  // namespace mrose::gui
