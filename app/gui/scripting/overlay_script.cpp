#include "scripting/overlay_script.h"

#include <cmath>
#include <map>

#include "reality/overlay.h"
#include "reality/overlay_panel.h"
#include "workflow/resources.h"

namespace mrose::gui {
namespace {

using ScriptValue = std::variant<std::monostate, bool, double, std::string>;

ScriptValue known(double value) { return std::isfinite(value) ? ScriptValue(value) : ScriptValue(); }
ScriptValue known(const std::optional<double>& value) { return value ? ScriptValue(*value) : ScriptValue(); }

ScriptValue causeValue(const Overlay& overlay, bool explained) {
    const auto& finding = overlay.causes().finding();
    if (!finding || !finding->diagnosis || finding->diagnosis->trials.empty()) return {};
    const Diagnosis& diagnosis = *finding->diagnosis;
    const CauseTrial& best = diagnosis.trials[diagnosis.likely.value_or(0)];
    if (explained) return best.explained;
    return diagnosis.likely ? best.what : std::string("none of these");
}

using Ask = ScriptValue (*)(const Overlay& overlay);

const std::map<std::string, Ask>& questions() {
    static const std::map<std::string, Ask> all{
        {"rollouts", [](const Overlay& o) { return ScriptValue(static_cast<double>(o.rollouts().requests().size())); }},
        {"windows",
         [](const Overlay& o) {
             return ScriptValue(static_cast<double>(o.rollouts().comparison()->all.of(RolloutUse::counted)));
         }},
        {"p", [](const Overlay& o) { return known(o.rollouts().comparison()->all.counted.p); }},
        {"hd", [](const Overlay& o) { return known(o.rollouts().comparison()->all.counted.hd); }},
        {"start",
         [](const Overlay& o) {
             return o.rollouts().shownRow() ? ScriptValue(toSeconds(o.rollouts().shownRow()->start)) : ScriptValue();
         }},
        {"session",
         [](const Overlay& o) {
             return o.rollouts().shownRow()
                        ? ScriptValue(o.rollouts().world().sessions()[o.rollouts().shownRow()->session].name)
                        : ScriptValue();
         }},
        {"robot",
         [](const Overlay& o) {
             return o.rollouts().shownRow()
                        ? ScriptValue(o.rollouts().world().robots()[o.rollouts().shownRow()->robot].name)
                        : ScriptValue();
         }},
        {"error",
         [](const Overlay& o) {
             return o.rollouts().shownRow() ? known(o.rollouts().shownRow()->position) : ScriptValue();
         }},
        {"heading",
         [](const Overlay& o) {
             return o.rollouts().shownRow() ? known(o.rollouts().shownRow()->heading) : ScriptValue();
         }},
        {"path_share",
         [](const Overlay& o) {
             return o.rollouts().shownRow() ? known(o.rollouts().shownRow()->share) : ScriptValue();
         }},
        {"divergence",
         [](const Overlay& o) {
             const RolloutRow* const row = o.rollouts().shownRow();
             return row != nullptr && row->divergence ? ScriptValue(toSeconds(row->divergence->time)) : ScriptValue();
         }},
        {"cause", [](const Overlay& o) { return causeValue(o, false); }},
        {"explained", [](const Overlay& o) { return causeValue(o, true); }},
    };
    return all;
}

}  // namespace

ScriptValue overlayValue(const ScriptedWindow& window, const std::string& name, Expected<void>& done) {
    Overlay& overlay = window.overlay;
    const auto question = questions().find(name);
    if (question == questions().end()) {
        std::string names;
        for (const auto& [known, ask] : questions()) names += (names.empty() ? "" : ", ") + known;
        done = fail("", "expected one of " + names);
        return {};
    }
    overlay.settle();
    if (!overlay.rollouts().log() || overlay.rollouts().comparison() == nullptr) {
        done = fail("", "no log is laid over this run; open_log() comes first");
        return {};
    }
    return question->second(overlay);
}

Expected<void> openLogByScript(const ScriptedWindow& window, const std::string& log, const std::string& robotFile) {
    PlayedLogRequest request{placeOfLog(log), ""};
    request.robotFile = robotFile;
    return window.overlay.openNow(request);
}

Expected<void> openWorst(const ScriptedWindow& window, int place) {
    window.overlay.settle();
    const QAbstractItemModel& list = *window.reality.rollouts();
    if (place < 1 || place > list.rowCount())
        return fail("", "the list has " + std::to_string(list.rowCount()) + " rollouts");
    window.reality.openLine(list.index(place - 1, 0));
    window.overlay.settle();
    return {};
}

}  // namespace mrose::gui
