#include "overlay.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "evaluation/format.h"
#include "main_window.h"
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

OverlayRow overlayRow(const ComparedCourse& course, const std::vector<CourseRequest>& requests,
                      const DivergenceBound& bound) {
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
    row.divergence = firstDivergence(course, WindowOptions{}.step, bound);
    row.touched = course.touched.has_value();
    return row;
}

std::vector<OverlayRow> overlayRows(const Log& log, std::span<const ComparedCourse> courses,
                                    const std::vector<CourseRequest>& requests, const DivergenceBound& bound) {
    std::vector<Window> windows;
    for (const ComparedCourse& course : courses) windows.push_back(course.real);
    classifyManoeuvres(log, windows, WindowOptions{}.step);
    std::vector<OverlayRow> rows;
    for (std::size_t i = 0; i < courses.size(); ++i) {
        if (courses[i].use == CourseUse::absent) continue;
        rows.push_back(overlayRow(courses[i], requests, bound));
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
    if (run.course->scenario->parts().players.empty() || run.recorded()) return;
    OverlayRequest request{run.source.log, run.source.file, {}, {}, run.source.seed, run.source.pluginLimit};
    plan_ = {};
    showsFirst_ = false;
    opener_.post([this, request](const JobQueue::GoesOn& goesOn) -> JobQueue::Answer {
        OpenProgress progress;
        progress.goesOn = goesOn;
        auto world = std::make_shared<Expected<OverlayWorldPointer>>(openOverlayWorld(request, progress));
        return [this, world] { take(std::move(*world)); };
    });
}

void Overlay::close() {
    opener_.drop();
    computing_.drop();
    world_ = nullptr;
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

void Overlay::setBound(const DivergenceBound& bound) {
    bound_ = bound;
    if (comparison_)
        rows_ = overlayRows(*world_->log, comparison_->courses, requests_, bound_);
    else if (world_)
        compareAll();
    emit changed();
}

void Overlay::compareAll() {
    computing_.drop();
    rows_.clear();
    comparison_ = nullptr;
    share_ = 0;
    error_.clear();
    emit changed();
    computing_.post([this, world = world_, requests = requests_, bound = bound_](const JobQueue::GoesOn& goesOn) {
        ComparisonOptions options;
        options.seed = world->seed;
        options.progress = [&](std::span<const ComparedCourse> part, double share) {
            auto rows = std::make_shared<std::vector<OverlayRow>>(overlayRows(*world->log, part, requests, bound));
            computing_.tell([this, rows, share] {
                share_ = std::min(share, 0.999);
                rows_.insert(rows_.end(), rows->begin(), rows->end());
                emit changed();
            });
            return goesOn();
        };
        auto compared = std::make_shared<Expected<Comparison>>(compare(world->world(), requests, options));
        return JobQueue::Answer([this, compared] {
            share_ = 1;
            if (*compared)
                comparison_ = std::make_shared<const Comparison>(std::move(**compared));
            else
                sayError(compared->error());
            emit changed();
        });
    });
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
    shownCourse_ = request;
    wasPlaying_ = false;
    window_.files().takeCourse(*run);
    window_.session().settle();
    if (body) window_.field().setSelected(*body);
    if (play) window_.session().play();
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
    if (share_ >= 1 && !opener_.busy()) return false;
    opener_.drop();
    computing_.drop();
    share_ = 1;
    if (world_) error_ = tr("Cancelled: not all courses are compared");
    emit changed();
    return true;
}

bool Overlay::busy() { return opener_.busy() || computing_.busy(); }

void Overlay::settle() {
    while (busy()) {
        opener_.settle();
        window_.session().settle();
        computing_.settle();
    }
}

}  // namespace mrose::gui
