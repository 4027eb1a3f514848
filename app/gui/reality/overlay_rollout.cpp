// What an overlay knows of the rollout that the window shows.
#include <algorithm>

#include "debug/plotted_value.h"
#include "frame/actions.h"
#include "frame/status_line.h"
#include "reality/overlay.h"
#include "session/session.h"
#include "widgets/field_view.h"
#include "widgets/qt_text.h"

namespace mrose::gui {

/// What the models make of the shown rollout, and why it leaves the real one.
void Overlay::lookAtRollout() {
    forgetRollout();
    if (!shownRollout_) return;
    for (std::size_t model = 1; model < models_.size(); ++model) {
        const auto job = [this, world = world_, drives = models_[model],
                          request = requests_[*shownRollout_]](const JobQueue::GoesOn& goesOn) {
            auto driven = std::make_shared<Reality::ModelRollout>(modelRollout(*world, drives, request, goesOn));
            return JobQueue::Answer([this, driven] {
                modelRollouts_.push_back(std::move(*driven));
                layReality();
            });
        };
        driving_.post(job, [this](const Error& error) { sayError(error); });
    }
    layReality();
    reportDivergences();
    findCause();
}

void Overlay::forgetRollout() {
    driving_.drop();
    diagnosing_.drop();
    modelRollouts_.clear();
    finding_.reset();
    cause_.reset();
}

/// What really happened, with the rollouts of the models that are shown and of a cause.
void Overlay::layReality() {
    if (!reality_ || !shownRollout_) return;
    auto laid = std::make_shared<Reality>(*reality_);
    for (const OverlayModel& model : models_)
        for (const Reality::ModelRollout& rollout : modelRollouts_)
            if (model.shown && rollout.name == model.name) laid->models.push_back(rollout);
    if (cause_ && finding_ && finding_->diagnosis) {
        const CauseTrial& trial = finding_->diagnosis->trials[*cause_];
        Reality::ModelRollout ghost{trial.what, WindowOptions{}.step, {}};
        ghost.poses.resize(reality_->robots.size());
        std::vector<Pose>& poses = ghost.poses[finding_->robot];
        const RolloutRequest& request = requests_[finding_->rollout];
        const LogSession::Part& part = world_->world().sessions()[request.session].parts[finding_->robot];
        const Trajectory& real = world_->world().trajectory(request.session, finding_->robot);
        if (const auto start = measureStart(real, part.origin + request.start, 0)) {
            poses.push_back(start->pose);
            poses.insert(poses.end(), trial.simulated.begin(), trial.simulated.end());
        }
        laid->models.push_back(std::move(ghost));
    }
    frame_.session.setReality(run_, std::move(laid));
}

/// In another rollout it has another number. A robot that is not in it is selected in the next rollout that has it.
void Overlay::selectAgain(const std::string& name) {
    if (name.empty()) return;
    const std::uint32_t body = bodyNamed(frame_.session.current()->frame->scene(), name);
    const bool there = body != noBody;
    absent_ = there ? std::string() : name;
    field_.setSelected(there ? std::optional<std::size_t>(body) : std::nullopt);
}

void Overlay::setRobot(std::optional<std::size_t> robot) {
    // The selection goes and comes back with the run.
    if (robot == robot_ || coming_) return;
    const auto before = shownRobot();
    robot_ = robot;
    if (shownRobot() != before) {
        findCause();
        emit divergencesChanged();
    }
    emit changed();
}

std::optional<std::size_t> Overlay::shownRobot() const {
    if (!shownRollout_) return {};
    if (robot_ && rowOf(*shownRollout_, *robot_) != nullptr) return robot_;
    const OverlayRow* worst = nullptr;
    for (std::size_t robot = 0; robot < world_->world().robots().size(); ++robot) {
        const OverlayRow* row = rowOf(*shownRollout_, robot);
        // Unknown numbers are below all others.
        if (row != nullptr && (worst == nullptr || row->position > worst->position)) worst = row;
    }
    return worst != nullptr ? std::optional(worst->robot) : std::nullopt;
}

const OverlayRow* Overlay::shownRow() const {
    const auto robot = shownRobot();
    return robot ? rowOf(*shownRollout_, *robot) : nullptr;
}

void Overlay::findCause() {
    diagnosing_.drop();
    cause_.reset();
    finding_.reset();
    const OverlayRow* const row = shownRow();
    if (row == nullptr || !row->divergence) return;
    finding_ = Finding{row->rollout, row->robot, 0, {}, {}};
    const CauseQuestion question{requests_[row->rollout], *row, divergenceOptions(), models_};
    const auto job = [this, world = world_, question](const JobQueue::GoesOn& goesOn) -> JobQueue::Answer {
        const auto progress = [&](double share) {
            diagnosing_.report([this, share] {
                finding_->share = share;
                emit changed();
            });
            return goesOn();
        };
        auto found = std::make_shared<Expected<Diagnosis>>(whyItLeaves(*world, question, progress));
        return [this, found] { takeDiagnosis(std::move(*found)); };
    };
    diagnosing_.post(job, [this](const Error& error) { takeDiagnosis(tl::unexpected(error)); });
}

void Overlay::takeDiagnosis(Expected<Diagnosis> found) {
    finding_->share = 1;
    if (found)
        finding_->diagnosis = std::move(*found);
    else
        finding_->error = qtText(found.error().message());
    emit changed();
}

void Overlay::showCause(std::optional<std::size_t> trial) {
    if (trial && (!finding_ || !finding_->diagnosis || *trial >= finding_->diagnosis->trials.size())) return;
    cause_ = trial;
    layReality();
    emit changed();
}

/// The shown robot's rollout, real and simulated: errors are small beside the place.
void Overlay::showNear() {
    constexpr double margin = 0.25, least = 1.2;  // of its size; m
    const OverlayRow* const row = shownRow();
    if (row == nullptr || row->area.empty()) return;
    const LogWorld& world = world_->world();
    Area area = row->area;
    const double reach = world.parts().scene.shapeOf(world.robots()[row->robot].body).reach;
    const Point middle = area.middle();
    const auto half = [&](double size) { return std::max(least / 2, (1 + margin) * (size / 2 + reach)); };
    const Point reaches{half(area.most.x - area.least.x), half(area.most.y - area.least.y)};
    field_.fit({middle - reaches, middle + reaches});
}

/// Whether the rollout of the robot that is asked about lies outside of the view.
bool Overlay::isAside() const {
    const OverlayRow* const row = shownRow();
    if (row == nullptr) return false;
    const Area seen = field_.transform().shown();
    return row->area.most.x < seen.least.x || row->area.least.x > seen.most.x || row->area.most.y < seen.least.y ||
           row->area.least.y > seen.most.y;
}

/// As before it: the same part of the place, where the rollout lies in it.
void Overlay::showAsBefore(const Coming& come) {
    if (come.view) field_.setView(*come.view);
    if (come.near || isAside()) showNear();
}

}  // namespace mrose::gui
