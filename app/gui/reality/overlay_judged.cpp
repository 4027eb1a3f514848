// The motion models of an overlay: added, taken away, and how true each of them is.
#include <algorithm>

#include "frame/actions.h"
#include "frame/status_line.h"
#include "reality/overlay.h"
#include "session/session.h"
#include "widgets/message_bar.h"
#include "widgets/qt_text.h"

namespace mrose::gui {

/// How true each model is, the scenario's own first.
void Overlay::compareModels() {
    for (std::size_t model = 0; model < models_.size(); ++model) compareModel(model);
    for (const WantedModel& wanted : loading_) loadModel(wanted);
}

void Overlay::compareModel(std::size_t model) {
    OverlayModel& judged = models_[model];
    judged.figures = {};
    judged.judged = 0;
    const double horizon = plan_.cut == OverlayPlan::Cut::windows ? plan_.length : OverlayPlan{}.length;
    const auto job = [this, world = world_, judged, requests = requests_,
                      horizon = fromSeconds(horizon)](const JobQueue::GoesOn& goesOn) -> JobQueue::Answer {
        const Progress progress = [&](double share) {
            computing_.report([this, name = judged.name, share] {
                if (OverlayModel* const known = modelNamed(name)) known->judged = std::min(share, 0.999);
                emit changed();
            });
            return goesOn();
        };
        const OverlayModel::Figures figures = judge(*world, judged, requests, horizon, progress);
        return [this, name = judged.name, figures] { takeFigures(name, figures); };
    };
    computing_.post(job, [this, name = judged.name](const Error& error) {
        takeFigures(name, {tl::unexpected(error), tl::unexpected(error)});
    });
}

void Overlay::takeFigures(const std::string& name, const OverlayModel::Figures& figures) {
    if (OverlayModel* const known = modelNamed(name)) {
        if (figures.compared) known->figures.compared = figures.compared;
        known->figures.evaluated = figures.evaluated;
        known->judged = 1;
    }
    emit changed();
}

OverlayModel* Overlay::modelNamed(const std::string& name) {
    const auto found =
        std::find_if(models_.begin(), models_.end(), [&](const OverlayModel& model) { return model.name == name; });
    return found == models_.end() ? nullptr : &*found;
}

void Overlay::addModel(const std::string& named) {
    const auto isIt = [&](const WantedModel& wanted) { return wanted.named == named; };
    if (!world_ || std::any_of(loading_.begin(), loading_.end(), isIt)) return;
    loading_.push_back({named});
    loadModel(loading_.back());
    emit changed();
}

void Overlay::loadModel(const WantedModel& wanted) {
    const auto job = [this, world = world_, wanted](const JobQueue::GoesOn&) -> JobQueue::Answer {
        auto model = std::make_shared<Expected<OverlayModel>>(overlayModel(*world, wanted.named));
        return [this, model, wanted] { takeModel(wanted, std::move(*model)); };
    };
    computing_.post(job, [this, wanted](const Error& error) { takeModel(wanted, tl::unexpected(error)); });
}

void Overlay::takeModel(const WantedModel& wanted, Expected<OverlayModel> model) {
    std::erase_if(loading_, [&](const WantedModel& other) { return other.named == wanted.named; });
    if (!model) {
        sayError(model.error());
    } else if (modelNamed(model->name) == nullptr) {
        model->shown = wanted.shown;
        if (!model->note.empty())
            frame_.messages.add(
                {MessageBar::Kind::note, qtText(model->name + ": " + model->note), modelTopic(model->name)});
        models_.push_back(std::move(*model));
        compareModel(models_.size() - 1);
        lookAtRollout();
    }
    emit changed();
}

void Overlay::removeModel(std::size_t model) {
    if (model == 0 || model >= models_.size()) return;
    std::erase_if(modelRollouts_, [&](const auto& rollout) { return rollout.name == models_[model].name; });
    frame_.messages.remove(modelTopic(models_[model].name));
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

std::optional<Overlay::Work> Overlay::work() const {
    if (!world_) return {};
    if (share_ < 1) return Work{tr("comparing"), share_};
    for (const OverlayModel& model : models_)
        if (model.judged < 1) return Work{tr("judging %1").arg(qtText(model.name)), model.judged};
    if (!loading_.empty()) return Work{tr("reading %1").arg(qtText(loading_.front().named)), 0};
    return {};
}

}  // namespace mrose::gui
