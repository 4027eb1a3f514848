#include "overlay.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "evaluation/format.h"
#include "main_window.h"
#include "shared/motion_models.h"
#include "widgets/field_view.h"
#include "widgets/message_bar.h"
#include "window_files.h"
#include "window_memory.h"

namespace mrose::gui {
namespace {

constexpr const char* overlayTopic = "overlay";

std::string courseName(const OverlayWorld& overlay, const CourseRequest& course) {
    const std::string& take = overlay.world().takes()[course.take].name;
    return overlay.name() + (take.empty() ? "" : ", " + take) + ", from " + fixed(toSeconds(course.start), 1) + " s";
}

}  // namespace

Overlay::Overlay(MainWindow& window) : QObject(&window), window_(window) {
    connect(&window, &MainWindow::updated, this, &Overlay::watchPlaying);
}

Overlay::~Overlay() = default;

void Overlay::open(const OverlayRequest& request, const OverlayPlan& plan) {
    if (!window_.files().mayLeave([this, request, plan] { open(request, plan); })) return;
    close();
    plan_ = plan;
    showsFirst_ = true;
    opener_.post([this, request](const JobQueue::GoesOn& goesOn) -> JobQueue::Answer {
        OpenProgress progress;
        progress.goesOn = goesOn;
        auto world = std::make_shared<Expected<OverlayWorldPointer>>(openOverlayWorld(request, progress));
        return [this, world] { take(std::move(*world)); };
    });
}

Expected<void> Overlay::openNow(const OverlayRequest& request, const OverlayPlan& plan) {
    opening_.reset();
    open(request, plan);
    opener_.settle();
    window_.session().settle();
    if (opening_) return tl::unexpected(*opening_);
    return {};
}

void Overlay::follow(const OpenRun& run) {
    close();
    if (!follows_ || run.course->scenario->parts().players.empty()) return;
    OverlayRequest request{run.source.log, run.source.file};
    request.seed = run.source.seed;
    request.pluginLimit = run.source.pluginLimit;
    if (run.recorded()) request.kept = run.course->descriptions;
    plan_ = {};
    showsFirst_ = false;
    opener_.post([this, request](const JobQueue::GoesOn& goesOn) -> JobQueue::Answer {
        OpenProgress progress;
        progress.goesOn = goesOn;
        auto world = std::make_shared<Expected<OverlayWorldPointer>>(openOverlayWorld(request, progress));
        return [this, world] {
            if (*world) return take(std::move(*world));
            const QString why = QString::fromStdString(world->error().message());
            window_.messages().add({MessageBar::Kind::note, tr("The run is shown alone: %1").arg(why), overlayTopic});
        };
    });
}

void Overlay::reload(const QString& why) {
    if (!world_ || !shownCourse_) return;
    opener_.post([this, request = world_->request, course = requests_[*shownCourse_], goesOn = goesOn(),
                  why](const JobQueue::GoesOn&) -> JobQueue::Answer {
        auto world = std::make_shared<Expected<OverlayWorldPointer>>(openOverlayWorld(request));
        auto run = std::make_shared<Expected<OpenRun>>(tl::unexpected(Error{}));
        if (*world)
            *run = openCourse(***world, course, goesOn);
        else
            *run = tl::unexpected(world->error());
        return [this, world, run, why] {
            if (*run) {
                world_ = std::move(**world);
                models_.front() = ownModel(*world_);
                compareAll();
            }
            window_.files().takeReloaded(std::move(*run), why);
        };
    });
}

void Overlay::close() {
    opener_.drop();
    computing_.drop();
    looking_.drop();
    world_ = nullptr;
    models_.clear();
    loading_.clear();
    modelCourses_.clear();
    reality_ = nullptr;
    robot_.reset();
    finding_.reset();
    cause_.reset();
    requests_.clear();
    rows_.clear();
    comparison_ = nullptr;
    shownCourse_.reset();
    share_ = 1;
    error_.clear();
    emit changed();
}

void Overlay::sayError(const Error& error) {
    opening_ = error;
    window_.messages().add({MessageBar::Kind::error, QString::fromStdString(error.message()), overlayTopic});
}

void Overlay::take(Expected<OverlayWorldPointer> world) {
    if (!world) return sayError(world.error());
    auto courses = plannedCourses(**world, plan_);
    if (!courses) return sayError(courses.error());
    world_ = std::move(*world);
    requests_ = std::move(*courses);
    models_ = {ownModel(*world_)};
    bound_ = {DivergenceBound{}.constant, knowsHeldOut(world_->world())};
    loading_ = world_->request.models;
    window_.messages().remove(overlayTopic);
    for (const std::string& note : world_->notes)
        window_.messages().add({MessageBar::Kind::note, QString::fromStdString(note)});
    if (showsFirst_) {
        window_.memory().addRecent(QString::fromStdString(world_->place));
        show(0);
    } else if (window_.shown()) {
        const Reality reality = realityOf(world_->world(), world_->log, 0, 0);
        window_.session().setReality(window_.shown()->run, std::make_shared<const Reality>(reality));
    }
    compareAll();
}

Expected<void> Overlay::setPlan(const OverlayPlan& plan) {
    if (!world_ || plan == plan_) return {};
    auto courses = plannedCourses(*world_, plan);
    if (!courses) return tl::unexpected(courses.error());
    plan_ = plan;
    requests_ = std::move(*courses);
    shownCourse_.reset();
    show(0);
    compareAll();
    return {};
}

DivergenceOptions Overlay::divergenceOptions() const {
    DivergenceOptions options;
    options.bound.constant = bound_.at;
    options.fromHeldOut = bound_.fromHeldOut;
    return options;
}

void Overlay::setBound(const Bound& bound) {
    if (bound == bound_) return;
    bound_ = bound;
    finding_.reset();
    cause_.reset();
    if (comparison_)
        rows_ = overlayRows(world_->world(), comparison_->courses, requests_, divergenceOptions());
    else if (world_)
        compareAll();
    tellDivergences();
    findCause();
    emit changed();
}

void Overlay::compareAll() {
    computing_.drop();
    rows_.clear();
    comparison_ = nullptr;
    share_ = 0;
    error_.clear();
    emit changed();
    computing_.post([this, world = world_, requests = requests_,
                     bounds = divergenceOptions()](const JobQueue::GoesOn& goesOn) {
        ComparisonOptions options;
        options.seed = world->seed;
        options.progress = [&](std::span<const ComparedCourse> part, double share) {
            auto rows = std::make_shared<std::vector<OverlayRow>>(overlayRows(world->world(), part, requests, bounds));
            computing_.tell([this, rows, share] {
                share_ = std::min(share, 0.999);
                rows_.insert(rows_.end(), rows->begin(), rows->end());
                if (finding_ || !shownRow()) return emit changed();
                tellDivergences();
                findCause();
                emit changed();
            });
            return goesOn();
        };
        auto compared = std::make_shared<Expected<Comparison>>(compare(world->world(), requests, options));
        return JobQueue::Answer([this, compared] {
            share_ = 1;
            if (!*compared) {
                sayError(compared->error());
            } else {
                comparison_ = std::make_shared<const Comparison>(std::move(**compared));
                models_.front().compared = comparison_->all;
            }
            emit changed();
        });
    });
    compareModels();
}

/// How true each model is, the scenario's own first.
void Overlay::compareModels() {
    for (std::size_t model = 0; model < models_.size(); ++model) compareModel(model);
    for (const std::string& named : loading_) loadModel(named);
}

void Overlay::compareModel(std::size_t model) {
    OverlayModel& judged = models_[model];
    judged.compared.reset();
    judged.evaluated.reset();
    const double horizon = plan_.cut == OverlayPlan::Cut::windows ? plan_.length : OverlayPlan{}.length;
    computing_.post([this, world = world_, judged, requests = requests_, own = model == 0,
                     horizon = fromSeconds(horizon)](const JobQueue::GoesOn& goesOn) {
        std::optional<ComparedSummary> compared;
        std::optional<Summary> evaluated;
        ComparisonOptions options;
        options.seed = world->seed;
        options.progress = [&](std::span<const ComparedCourse>, double) { return goesOn(); };
        if (!own)
            if (const auto comparison = compare(*judged.world, requests, options)) compared = comparison->all;
        if (goesOn())
            if (const auto summary = evaluatedModel(*world, judged, horizon)) evaluated = *summary;
        return JobQueue::Answer([this, name = judged.name, own, compared, evaluated] {
            for (OverlayModel& known : models_) {
                if (known.name != name) continue;
                if (!own) known.compared = compared;
                known.evaluated = evaluated;
            }
            emit changed();
        });
    });
}

void Overlay::addModel(const std::string& named) {
    if (!world_ || std::find(loading_.begin(), loading_.end(), named) != loading_.end()) return;
    loading_.push_back(named);
    loadModel(named);
}

void Overlay::loadModel(const std::string& named) {
    computing_.post([this, world = world_, named](const JobQueue::GoesOn&) {
        auto model = std::make_shared<Expected<OverlayModel>>(overlayModel(*world, named));
        return JobQueue::Answer([this, model, named] {
            std::erase(loading_, named);
            if (!*model) return sayError(model->error());
            for (const OverlayModel& known : models_)
                if (known.name == (*model)->name) return;
            models_.push_back(std::move(**model));
            compareModel(models_.size() - 1);
            lookAtCourse();
            emit changed();
        });
    });
}

void Overlay::removeModel(std::size_t model) {
    if (model == 0 || model >= models_.size()) return;
    models_.erase(models_.begin() + static_cast<std::ptrdiff_t>(model));
    layReality();
    emit changed();
}

void Overlay::showModel(std::size_t model, bool on) {
    if (model >= models_.size() || models_[model].shown == on) return;
    models_[model].shown = on;
    layReality();
    emit changed();
}

const OverlayRow* Overlay::rowOf(std::size_t request, std::size_t robot) const {
    const auto found = std::lower_bound(rows_.begin(), rows_.end(), std::pair(request, robot),
                                        [](const OverlayRow& row, const std::pair<std::size_t, std::size_t>& of) {
                                            return std::pair(row.request, row.robot) < of;
                                        });
    return found != rows_.end() && found->request == request && found->robot == robot ? &*found : nullptr;
}

/// What a robot is told does not end with a course after which no other begins.
bool Overlay::goesOn() const { return plan_.cut != OverlayPlan::Cut::every || !restarts_; }

void Overlay::show(std::size_t request, std::optional<std::size_t> robot, bool play) {
    if (!world_ || request >= requests_.size()) return;
    if (!window_.files().mayLeave([this, request, robot, play] { show(request, robot, play); })) return;
    // The newest wish counts.
    opener_.drop();
    opener_.post([this, world = world_, request, course = requests_[request], robot, play,
                  goesOn = goesOn()](const JobQueue::GoesOn&) -> JobQueue::Answer {
        auto run = std::make_shared<Expected<OpenRun>>(openCourse(*world, course, goesOn));
        if (*run) (*run)->name = courseName(*world, course);
        return [this, run, request, robot, play] { takeCourse(std::move(*run), request, robot, play); };
    });
}

void Overlay::takeCourse(Expected<OpenRun> run, std::size_t request, std::optional<std::size_t> robot, bool play) {
    if (!run) return sayError(run.error());
    std::string selected;
    if (robot)
        selected = world_->world().robots()[*robot].name;
    else if (const auto body = window_.field().selected(); body && window_.shown())
        selected = window_.shown()->frame->nameOf(*body);
    const Scene& scene = run->course->scene();
    std::optional<std::size_t> body;
    for (std::size_t i = 0; i < scene.bodyCount() && !selected.empty(); ++i)
        if (i < scene.robots.size() && scene.robots[i].name == selected) body = i;
    window_.messages().remove(overlayTopic);
    // Breakpoints go along from course to course.
    std::vector<Breakpoint> breakpoints;
    if (shownCourse_ && window_.shown())
        for (const BreakpointState& state : window_.shown()->breakpoints) breakpoints.push_back(state.breakpoint);
    shownCourse_ = request;
    reality_ = run->reality;
    if (robot) robot_ = robot;
    window_.files().takeCourse(*run);
    window_.session().settle();
    run_ = window_.shown()->run;
    if (!breakpoints.empty()) window_.session().setBreakpoints(breakpoints);
    if (body) window_.field().setSelected(*body);
    if (play) window_.session().play();
    lookAtCourse();
    emit changed();
}

bool Overlay::showNext(int by, bool play) {
    if (!world_ || !shownCourse_) return false;
    const auto next = static_cast<std::int64_t>(*shownCourse_) + by;
    if (next < 0 || next >= static_cast<std::int64_t>(requests_.size())) return false;
    show(static_cast<std::size_t>(next), {}, play);
    return true;
}

void Overlay::setRestarts(bool on) {
    if (restarts_ == on) return;
    restarts_ = on;
    emit changed();
}

/// A course that has been played to its end is followed by the next.
void Overlay::watchPlaying() {
    const Shown& shown = *window_.shown();
    // Who goes to the end by hand is told nothing there.
    const bool ended = !shown.playing && !shown.message.isEmpty() && !shown.atBreak;
    if (!ended || !restarts_ || !shownCourse_ || plan_.cut != OverlayPlan::Cut::every || opener_.busy()) return;
    if (shown.run != run_ || shown.branch != 0) return;
    const Nanoseconds end = requests_[*shownCourse_].steps * WindowOptions{}.step;
    if (shown.tick() != shown.frame->scene().ticksOf(end)) return;
    if (window_.files().hasUnsaved())
        return window_.say(tr("This course has branches that are not saved: the next one waits"));
    showNext(1, true);
}

bool Overlay::cancel() {
    const bool comparing = share_ < 1, looking = looking_.busy();
    if (!comparing && !opener_.busy() && !looking) return false;
    opener_.drop();
    looking_.drop();
    if (finding_ && finding_->share < 1) finding_.reset();
    if (!comparing) return emit changed(), true;
    computing_.drop();
    share_ = 1;
    if (world_) error_ = tr("Cancelled: not all courses are compared");
    emit changed();
    return true;
}

bool Overlay::busy() { return opener_.busy() || computing_.busy() || looking_.busy(); }

void Overlay::settle() {
    while (busy()) {
        opener_.settle();
        window_.session().settle();
        computing_.settle();
        looking_.settle();
    }
}

}  // namespace mrose::gui
