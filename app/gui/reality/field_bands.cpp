#include "reality/field_bands.h"

#include <utility>

#include "debug/robot_bands.h"
#include "reality/overlay.h"
#include "widgets/field_view.h"

namespace mrose::gui {
namespace {

/// While a run plays, the next one is begun so long after the last.
constexpr Nanoseconds whilePlaying = nanosecondsPerSecond / 5;

}  // namespace

FieldBands::FieldBands(const WindowFrame& frame, FieldView& field, const Overlay& overlay)
    : QObject(&frame.window), frame_(frame), field_(field), overlay_(overlay), ahead_(MotionSampler::Options{}.ahead) {
    connect(&field, &FieldView::layersChanged, this, &FieldBands::follow);
    connect(&overlay, &Overlay::changed, this, &FieldBands::follow);
    connect(&frame.session, &Session::shown, this, &FieldBands::follow);
}

void FieldBands::setAhead(Nanoseconds ahead) {
    ahead_ = ahead;
    follow();
}

void FieldBands::follow() {
    const bool on = field_.layers().has(FieldLayer::uncertainty);
    if (std::exchange(on_, on) != on) says_ = on;
    if (!on) return forget();
    const std::shared_ptr<const Shown> shown = frame_.session.current();
    if (!shown) return;
    followRollout(*shown);
    if (!showsRollout(*shown)) return followTick(*shown);
    sampling_.drop();
    pending_.reset();
    known_.reset();
    field_.setBands({rollout_->bands, true});
}

void FieldBands::forget() {
    sampling_.drop();
    ofRollouts_.drop();
    pending_.reset();
    known_.reset();
    sampler_.reset();
    field_.setBands({});
    if (std::exchange(rollout_, std::nullopt)) emit rolloutChanged();
}

/// Another rollout may be on its way: until it is there, nothing changes.
void FieldBands::followRollout(const Shown& shown) {
    const LogRollouts& rollouts = overlay_.rollouts();
    const void* const log = rollouts.log().get();
    if (log != nullptr && !rollouts.shown()) return;
    if (rollout_ && rollout_->log == log && rollout_->run == shown.run) return;
    ofRollouts_.drop();
    const bool had = std::exchange(rollout_, std::nullopt).has_value();
    if (log != nullptr) {
        rollout_ = OfRollout{log, shown.run};
        const auto work = [log = rollouts.log(), request = rollouts.requests()[*rollouts.shown()]](
                              const GoesOn& goesOn) -> Expected<std::optional<MotionBands>> {
            return rolloutBands(*log, request, goesOn);
        };
        ofRollouts_.run(work, [this](Expected<std::optional<MotionBands>> bands) {
            if (!bands || !*bands) return;
            rollout_->bands = std::make_shared<const MotionBands>(std::move(**bands));
            sayWhatIsUnknown(*rollout_->bands);
            emit rolloutChanged();
            follow();
        });
    }
    if (had) emit rolloutChanged();
}

/// The run itself, and not what becomes of it after something was changed.
bool FieldBands::showsRollout(const Shown& shown) const {
    return rollout_ && rollout_->run == shown.run && shown.branch == overlay_.shown().comparedBranch();
}

void FieldBands::followTick(const Shown& shown) {
    const OfTick wish{shown.run, shown.branch, shown.tick(), ahead_};
    const Scene& scene = shown.frame->scene();
    const auto leadsHere = [&](const OfTick& from) {
        return from.run == wish.run && from.branch == wish.branch && from.tick <= wish.tick &&
               wish.tick <= from.tick + scene.ticksOf(from.ahead);
    };
    if (pending_ && !pending_->sameWish(wish) && !(shown.playing && leadsHere(*pending_))) {
        sampling_.drop();
        pending_.reset();
    }
    if (known_ && !leadsHere(*known_)) known_.reset();
    field_.setBands({known_ ? known_->bands : nullptr, false});
    if (pending_ || (known_ && known_->sameWish(wish))) return;
    if (shown.playing && known_ && wish.tick - known_->tick < scene.ticksOf(whilePlaying)) return;
    if (scene.bodyCount() > FrameOptions{}.mostBodiesAhead) {
        if (std::exchange(says_, false))
            frame_.say(tr("Where so many robots may be is not computed: at most %1 bodies")
                           .arg(FrameOptions{}.mostBodiesAhead));
        return;
    }
    sample(wish, shown.frame);
}

void FieldBands::sample(const OfTick& wish, std::shared_ptr<const FieldFrame> frame) {
    struct Sampled {
        std::shared_ptr<const Sampler> by;
        std::optional<MotionBands> bands;
    };
    pending_ = wish;
    const auto work = [frame = std::move(frame), by = sampler_,
                       ahead = wish.ahead](const GoesOn& goesOn) -> Expected<Sampled> {
        Sampled sampled{by, {}};
        if (!by || by->of != frame->scenario)
            sampled.by = std::make_shared<const Sampler>(
                Sampler{frame->scenario, std::make_shared<const MotionSampler>(samplerOf(frame->scenario))});
        MotionSampler::Options options;
        options.ahead = ahead;
        sampled.bands = sampled.by->sampler->bands(frame->state, options, goesOn);
        return sampled;
    };
    sampling_.run(work, [this](Expected<Sampled> sampled) {
        if (!pending_) return;
        known_ = *std::exchange(pending_, std::nullopt);
        if (!sampled || !sampled->bands) return;
        sampler_ = sampled->by;
        known_->bands = std::make_shared<const MotionBands>(std::move(*sampled->bands));
        sayWhatIsUnknown(*known_->bands);
        follow();
    });
}

void FieldBands::sayWhatIsUnknown(const MotionBands& bands) {
    if (std::exchange(says_, false) && bands.empty())
        frame_.say(tr("No noise is known of the motion of any robot here"));
}

void FieldBands::settle() {
    while (busy()) {
        sampling_.settle();
        ofRollouts_.settle();
    }
}

}  // namespace mrose::gui
