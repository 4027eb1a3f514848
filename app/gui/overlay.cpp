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

namespace mrose::gui {
namespace {

constexpr const char* overlayTopic = "overlay";

/// The courses of a plan. Error: none fits in.
Expected<std::vector<CourseRequest>> plannedCourses(const OverlayWorld& overlay, const OverlayPlan& plan) {
    const Nanoseconds step = WindowOptions{}.step;
    const Nanoseconds length = std::max<Nanoseconds>(1, std::llround(plan.length / toSeconds(step))) * step;
    if (plan.cut == OverlayPlan::Cut::windows) {
        WindowOptions options;
        options.horizon = length;
        std::vector<std::string> robots;
        for (const ComparedRobot& robot : overlay.world().robots()) robots.push_back(robot.realName);
        const auto windows = findWindows(*overlay.log, robots, options);
        if (!windows) return tl::unexpected(windows.error());
        auto courses = coursesOfWindows(overlay.world(), *windows);
        if (courses.empty()) return fail(overlay.place, "has no window of the scenario's robots");
        return courses;
    }
    StretchOptions options;
    options.start = fromSeconds(plan.start);
    if (plan.cut == OverlayPlan::Cut::every)
        options.every = length;
    else
        options.duration = length;
    auto courses = coursesOf(overlay.world(), options);
    // Said of what the window has, not of flags.
    if (!courses && plan.cut == OverlayPlan::Cut::every)
        courses.error().cause = "no course of " + secondsText(length) + " s fits in from " +
                                secondsText(options.start) + " s on; expected an earlier start or shorter courses";
    else if (!courses)
        courses.error().cause =
            "the ground truth ends before " + secondsText(options.start) + " s; expected an earlier start";
    return courses;
}

OverlayRow overlayRow(const LogWorld& world, const ComparedCourse& course, const std::vector<CourseRequest>& requests,
                      const DivergenceOptions& options) {
    OverlayRow row;
    row.request = course.request;
    row.robot = course.robot;
    row.start = requests[course.request].start;
    row.use = course.use;
    row.position = knownMean(course);
    row.share = course.real.path > 0 && course.use != CourseUse::still ? 100 * row.position / course.real.path
                                                                       : std::numeric_limits<double>::quiet_NaN();
    row.heading = course.errors.headingMean;
    if (course.use == CourseUse::counted || course.use == CourseUse::still) row.manoeuvre = course.real.manoeuvre;
    if (const auto bound = boundFor(world, course, options, WindowOptions{}.step))
        row.divergence = firstDivergence(course, WindowOptions{}.step, *bound);
    row.touched = course.touched.has_value();
    return row;
}

std::vector<OverlayRow> overlayRows(const LogWorld& world, std::span<const ComparedCourse> courses,
                                    const std::vector<CourseRequest>& requests, const DivergenceOptions& options) {
    std::vector<Window> windows;
    for (const ComparedCourse& course : courses) windows.push_back(course.real);
    classifyManoeuvres(world.log(), windows, WindowOptions{}.step);
    std::vector<OverlayRow> rows;
    for (std::size_t i = 0; i < courses.size(); ++i) {
        if (courses[i].use == CourseUse::absent) continue;
        rows.push_back(overlayRow(world, courses[i], requests, options));
        if (rows.back().manoeuvre) rows.back().manoeuvre = windows[i].manoeuvre;
    }
    return rows;
}

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
    loading_ = world_->request.models;
    window_.messages().remove(overlayTopic);
    for (const std::string& note : world_->notes)
        window_.messages().add({MessageBar::Kind::note, QString::fromStdString(note)});
    if (showsFirst_) {
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

/// What the models make of the shown course, and why it leaves the real one.
void Overlay::lookAtCourse() {
    looking_.drop();
    modelCourses_.clear();
    finding_.reset();
    cause_.reset();
    if (!shownCourse_) return;
    for (std::size_t model = 1; model < models_.size(); ++model)
        looking_.post([this, world = world_, judged = models_[model],
                       course = requests_[*shownCourse_]](const JobQueue::GoesOn& goesOn) {
            auto driven = std::make_shared<Reality::ModelCourse>(modelCourse(*world, judged, course, goesOn));
            return JobQueue::Answer([this, driven] {
                modelCourses_.push_back(std::move(*driven));
                layReality();
            });
        });
    layReality();
    tellDivergences();
    findCause();
}

/// What really happened, with the courses of the models that are shown and of a cause.
void Overlay::layReality() {
    if (!reality_ || !shownCourse_) return;
    auto laid = std::make_shared<Reality>(*reality_);
    for (const OverlayModel& model : models_)
        for (const Reality::ModelCourse& course : modelCourses_)
            if (model.shown && course.name == model.name) laid->models.push_back(course);
    if (cause_ && finding_ && finding_->diagnosis) {
        const CauseTrial& trial = finding_->diagnosis->trials[*cause_];
        Reality::ModelCourse ghost{trial.what, WindowOptions{}.step, {}};
        ghost.poses.resize(reality_->robots.size());
        std::vector<Pose>& poses = ghost.poses[finding_->robot];
        const Take::Part& part = world_->world().takes()[requests_[finding_->request].take].parts[finding_->robot];
        const Trajectory& real = world_->world().trajectory(requests_[finding_->request].take, finding_->robot);
        if (const auto start = measureStart(real, part.origin + requests_[finding_->request].start, 0)) {
            poses.push_back(start->pose);
            poses.insert(poses.end(), trial.simulated.begin(), trial.simulated.end());
        }
        laid->models.push_back(std::move(ghost));
    }
    window_.session().setReality(run_, std::move(laid));
}

/// Breakpoints wait for the divergences of the course itself: what a branch would do, nobody has compared.
void Overlay::tellDivergences() {
    if (!shownCourse_ || !window_.shown()) return;
    const Scene& scene = window_.shown()->frame->scene();
    std::vector<std::int64_t> ticks;
    for (std::size_t robot = 0; robot < world_->world().robots().size(); ++robot)
        if (const OverlayRow* row = rowOf(*shownCourse_, robot); row != nullptr && row->divergence)
            ticks.push_back(scene.ticksOf(row->divergence->time));
    window_.session().setDivergence([ticks](const TimeTravel&, std::uint32_t branch, std::int64_t tick) {
        return branch == 0 && std::find(ticks.begin(), ticks.end(), tick) != ticks.end();
    });
}

void Overlay::setRobot(std::optional<std::size_t> robot) {
    if (robot == robot_) return;
    const auto before = shownRobot();
    robot_ = robot;
    if (shownRobot() != before) findCause();
    emit changed();
}

std::optional<std::size_t> Overlay::shownRobot() const {
    if (!shownCourse_) return {};
    if (robot_ && rowOf(*shownCourse_, *robot_) != nullptr) return robot_;
    const OverlayRow* worst = nullptr;
    for (std::size_t robot = 0; robot < world_->world().robots().size(); ++robot) {
        const OverlayRow* row = rowOf(*shownCourse_, robot);
        if (row != nullptr && (worst == nullptr || row->position > worst->position)) worst = row;
    }
    return worst != nullptr ? std::optional(worst->robot) : std::nullopt;
}

const OverlayRow* Overlay::shownRow() const {
    const auto robot = shownRobot();
    return robot ? rowOf(*shownCourse_, *robot) : nullptr;
}

void Overlay::findCause() {
    const OverlayRow* const row = shownRow();
    cause_.reset();
    finding_.reset();
    if (row == nullptr || !row->divergence) return;
    finding_ = Finding{row->request, row->robot, 0, {}, {}};
    const auto isOurs = [this, request = row->request, robot = row->robot] {
        return finding_ && finding_->request == request && finding_->robot == robot;
    };
    looking_.post([this, world = world_, request = requests_[row->request], row = *row, bounds = divergenceOptions(),
                   others = models_, isOurs](const JobQueue::GoesOn& goesOn) -> JobQueue::Answer {
        ComparisonOptions options;
        options.seed = world->seed;
        CourseRequest alone = request;
        alone.robot = row.robot;
        auto comparison = compare(world->world(), {&alone, 1}, options);
        auto found = std::make_shared<Expected<Diagnosis>>();
        if (!comparison) {
            *found = tl::unexpected(comparison.error());
        } else {
            const ComparedCourse& course = comparison->courses.front();
            DiagnosisOptions asked;
            asked.seed = world->seed;
            if (const auto bound = boundFor(world->world(), course, bounds, asked.step)) asked.bound = *bound;
            for (const OverlayModel& other : others)
                if (!other.moves.byRobot.empty()) asked.models.push_back(other.moves);
            for (OtherModel& model : modelsToTry(world->world(), {}).value_or(std::vector<OtherModel>{}))
                asked.models.push_back(std::move(model));
            asked.progress = [&](double share) {
                looking_.tell([this, share, isOurs] {
                    if (!isOurs()) return;
                    finding_->share = share;
                    emit changed();
                });
                return goesOn();
            };
            *found = diagnose(world->world(), alone, course, *row.divergence, asked);
        }
        return [this, found, isOurs] {
            if (!isOurs()) return;
            finding_->share = 1;
            if (*found)
                finding_->diagnosis = std::move(**found);
            else
                finding_->error = QString::fromStdString(found->error().message());
            emit changed();
        };
    });
}

void Overlay::showCause(std::optional<std::size_t> trial) {
    if (trial && (!finding_ || !finding_->diagnosis || *trial >= finding_->diagnosis->trials.size())) return;
    cause_ = trial;
    layReality();
    emit changed();
}

bool Overlay::goToDivergence() {
    const OverlayRow* const row = shownRow();
    if (row == nullptr || !row->divergence || !window_.shown()) return false;
    window_.session().seek(window_.shown()->frame->scene().ticksOf(row->divergence->time), false);
    return true;
}

const OverlayRow* Overlay::rowOf(std::size_t request, std::size_t robot) const {
    const auto found = std::lower_bound(rows_.begin(), rows_.end(), std::pair(request, robot),
                                        [](const OverlayRow& row, const std::pair<std::size_t, std::size_t>& of) {
                                            return std::pair(row.request, row.robot) < of;
                                        });
    return found != rows_.end() && found->request == request && found->robot == robot ? &*found : nullptr;
}

void Overlay::show(std::size_t request, std::optional<std::size_t> robot, bool play) {
    if (!world_ || request >= requests_.size()) return;
    if (!window_.files().mayLeave([this, request, robot, play] { show(request, robot, play); })) return;
    // The newest wish counts.
    opener_.drop();
    const bool goesOn = plan_.cut == OverlayPlan::Cut::once || !restarts_;
    opener_.post([this, world = world_, request, course = requests_[request], robot, play,
                  goesOn](const JobQueue::GoesOn&) -> JobQueue::Answer {
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
    wasPlaying_ = false;
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
    const bool ended = wasPlaying_ && !shown.playing;
    wasPlaying_ = shown.playing;
    if (!ended || !restarts_ || !shownCourse_ || plan_.cut != OverlayPlan::Cut::every) return;
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
