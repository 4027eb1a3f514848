// What an overlay knows of the course that the window shows.
#include <algorithm>

#include "main_window.h"
#include "overlay.h"
#include "overlay_marks.h"
#include "shared/motion_models.h"

namespace mrose::gui {

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
    markDivergences(window_, *this);
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
    if (shownRobot() != before) {
        findCause();
        markDivergences(window_, *this);
    }
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
            asked.bound = courseBound(world->world(), course, bounds);
            asked.models = modelsToTry(world->world(), {}).value_or(std::vector<OtherModel>{});
            for (const OverlayModel& other : others)
                if (!other.moves.byRobot.empty() &&
                    std::none_of(asked.models.begin(), asked.models.end(),
                                 [&](const OtherModel& model) { return model.name == other.name; }))
                    asked.models.push_back(other.moves);
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

}  // namespace mrose::gui
