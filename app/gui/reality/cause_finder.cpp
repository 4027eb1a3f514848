#include "reality/cause_finder.h"

#include "widgets/qt_text.h"
#include "workflow/open_model.h"

namespace mrose::gui {

CauseFinder::CauseFinder(const LogRollouts& rollouts, const LaidModels& models)
    : rollouts_(rollouts), models_(models) {}

void CauseFinder::forget() {
    diagnosing_.drop();
    finding_.reset();
    shown_.reset();
}

void CauseFinder::find() {
    forget();
    const RolloutRow* const row = rollouts_.shownRow();
    if (row == nullptr || !row->divergence) return;
    finding_ = Finding{row->rollout, row->robot, 0, {}, {}};
    const auto report = [this](double share) {
        finding_->share = share;
        emit changed();
    };
    diagnosing_.run(
        [&queue = diagnosing_, log = rollouts_.log(), laidOver = models_.all(), report,
         question = CauseQuestion{rollouts_.requests()[row->rollout], *row, {}}](const GoesOn& goesOn) {
            CauseQuestion asked = question;
            asked.models = causeModels(*log, laidOver);
            return whyItLeaves(*log, asked, queue.progress(goesOn, report));
        },
        [this](Expected<Diagnosis> found) { take(std::move(found)); });
}

void CauseFinder::take(Expected<Diagnosis> found) {
    finding_->share = 1;
    if (found)
        finding_->diagnosis = std::move(*found);
    else
        finding_->error = qtText(found.error().message());
    emit changed();
}

void CauseFinder::show(std::optional<std::size_t> trial) {
    if (trial && (!finding_ || !finding_->diagnosis || *trial >= finding_->diagnosis->trials.size())) return;
    shown_ = trial;
    emit laid();
    emit changed();
}

std::optional<Reality::ModelRollout> CauseFinder::shownRerun() const {
    if (!shown_ || !finding_ || !finding_->diagnosis) return {};
    const CauseTrial& trial = finding_->diagnosis->trials[*shown_];
    Reality::ModelRollout rerun{trial.what, WindowOptions{}.step, {}};
    rerun.poses.resize(rollouts_.world().robots().size());
    std::vector<Pose>& poses = rerun.poses[finding_->robot];
    const RolloutRequest& request = rollouts_.requests()[finding_->rollout];
    const LogSession::Part& part = rollouts_.world().sessions()[request.session].parts[finding_->robot];
    const Trajectory& real = rollouts_.world().trajectory(request.session, finding_->robot);
    if (const auto start = measureStart(real, part.origin + request.start, 0)) {
        poses.push_back(start->pose);
        poses.insert(poses.end(), trial.simulated.begin(), trial.simulated.end());
    }
    return rerun;
}

void CauseFinder::giveUp() {
    diagnosing_.drop();
    if (finding_ && finding_->share < 1) finding_.reset();
}

}  // namespace mrose::gui
