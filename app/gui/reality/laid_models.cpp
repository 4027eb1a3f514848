#include "reality/laid_models.h"

#include <algorithm>

#include "widgets/message_bar.h"
#include "widgets/qt_text.h"
#include "workflow/open_model.h"

namespace mrose::gui {
namespace {

/// Of the messages that speak of a model.
QString topicOf(const std::string& model) { return "model " + qtText(model); }

}  // namespace

LaidModels::LaidModels(const WindowFrame& frame, const LogRollouts& rollouts, JobQueue& computing)
    : frame_(frame), rollouts_(rollouts), computing_(computing) {}

void LaidModels::enter(const std::vector<std::string>& more) {
    // Models move in the world that they were made of.
    std::vector<Wanted> wanted;
    for (const JudgedModel& model : models_)
        if (!model.named.empty()) wanted.push_back({model.named, model.shown});
    for (const std::string& named : more) loading_.push_back({named});
    loading_.insert(loading_.begin(), wanted.begin(), wanted.end());
    models_ = {ownModel(*rollouts_.log())};
}

void LaidModels::clear() {
    for (const JudgedModel& model : models_) frame_.messages.remove(topicOf(model.name));
    models_.clear();
    loading_.clear();
}

/// The scenario's own first.
void LaidModels::judge() {
    for (std::size_t model = 0; model < models_.size(); ++model) judge(model);
    for (const Wanted& wanted : loading_) load(wanted);
}

void LaidModels::judge(std::size_t model) {
    JudgedModel& judged = models_[model];
    judged.figures = {};
    judged.judged = 0;
    const RolloutPlan& plan = rollouts_.plan();
    const double horizon = plan.cut == RolloutPlan::Cut::windows ? plan.length : RolloutPlan{}.length;
    const auto report = [this, name = judged.name](double share) {
        if (JudgedModel* const known = named(name)) known->judged = std::min(share, 0.999);
        emit changed();
    };
    computing_.run(
        [&queue = computing_, log = rollouts_.log(), judged, requests = rollouts_.requests(),
         horizon = fromSeconds(horizon), report](const GoesOn& goesOn) -> Expected<JudgedModel::Figures> {
            return mrose::judge(*log, judged, requests, horizon, queue.progress(goesOn, report));
        },
        [this, name = judged.name](const Expected<JudgedModel::Figures>& figures) {
            const auto none = [&] { return tl::unexpected(figures.error()); };
            take(name, figures ? *figures : JudgedModel::Figures{none(), none()});
        });
}

void LaidModels::setOwnFigures(const Expected<ComparedSummary>& compared) {
    models_.front().figures.compared = compared;
}

void LaidModels::take(const std::string& name, const JudgedModel::Figures& figures) {
    if (JudgedModel* const known = named(name)) {
        if (figures.compared) known->figures.compared = figures.compared;
        known->figures.evaluated = figures.evaluated;
        known->judged = 1;
    }
    emit changed();
}

JudgedModel* LaidModels::named(const std::string& name) {
    const auto found =
        std::find_if(models_.begin(), models_.end(), [&](const JudgedModel& model) { return model.name == name; });
    return found == models_.end() ? nullptr : &*found;
}

void LaidModels::add(const std::string& named) {
    const auto isIt = [&](const Wanted& wanted) { return wanted.named == named; };
    if (!rollouts_.log() || std::any_of(loading_.begin(), loading_.end(), isIt)) return;
    loading_.push_back({named});
    load(loading_.back());
    emit changed();
}

void LaidModels::load(const Wanted& wanted) {
    computing_.run([log = rollouts_.log(), wanted](const GoesOn&) { return openModel(*log, wanted.named); },
                   [this, wanted](Expected<JudgedModel> model) { take(wanted, std::move(model)); });
}

void LaidModels::take(const Wanted& wanted, Expected<JudgedModel> model) {
    std::erase_if(loading_, [&](const Wanted& other) { return other.named == wanted.named; });
    if (!model) {
        emit failed(model.error());
    } else if (named(model->name) == nullptr) {
        model->shown = wanted.shown;
        if (!model->note.empty())
            frame_.messages.add(
                {MessageBar::Kind::note, qtText(model->name + ": " + model->note), topicOf(model->name)});
        models_.push_back(std::move(*model));
        judge(models_.size() - 1);
        drive();
    }
    emit changed();
}

void LaidModels::remove(std::size_t model) {
    if (model == 0 || model >= models_.size()) return;
    std::erase_if(driven_, [&](const auto& rollout) { return rollout.name == models_[model].name; });
    frame_.messages.remove(topicOf(models_[model].name));
    models_.erase(models_.begin() + static_cast<std::ptrdiff_t>(model));
    emit laid();
    emit changed();
}

void LaidModels::show(std::size_t model, bool on) {
    if (model >= models_.size() || models_[model].shown == on) return;
    models_[model].shown = on;
    emit laid();
    emit changed();
}

void LaidModels::forgetDriven() {
    driving_.drop();
    driven_.clear();
}

void LaidModels::drive() {
    forgetDriven();
    if (!rollouts_.shown()) return;
    for (std::size_t model = 1; model < models_.size(); ++model)
        driving_.run(
            [log = rollouts_.log(), drives = models_[model], request = rollouts_.requests()[*rollouts_.shown()]](
                const GoesOn& goesOn) -> Expected<Reality::ModelRollout> {
                return modelRollout(*log, drives, request, goesOn);
            },
            [this](Expected<Reality::ModelRollout> driven) {
                if (!driven) return emit failed(driven.error());
                driven_.push_back(std::move(*driven));
                emit laid();
            });
}

std::vector<Reality::ModelRollout> LaidModels::drivenRollouts() const {
    std::vector<Reality::ModelRollout> shown;
    for (const JudgedModel& model : models_)
        for (const Reality::ModelRollout& rollout : driven_)
            if (model.shown && rollout.name == model.name) shown.push_back(rollout);
    return shown;
}

void LaidModels::giveUp() {
    driving_.drop();
    loading_.clear();
    const auto cancelled = fail({}, "cancelled");
    for (JudgedModel& model : models_) {
        model.judged = 1;
        if (!model.figures.compared) model.figures.compared = cancelled;
        if (!model.figures.evaluated) model.figures.evaluated = cancelled;
    }
}

std::optional<LaidModels::Work> LaidModels::work() const {
    for (const JudgedModel& model : models_)
        if (model.judged < 1) return Work{tr("judging %1").arg(qtText(model.name)), model.judged};
    if (!loading_.empty()) return Work{tr("reading %1").arg(qtText(loading_.front().named)), 0};
    return {};
}

}  // namespace mrose::gui
