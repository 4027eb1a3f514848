#include "frame/fault_messages.h"

#include <QFileInfo>
#include <QStringList>

#include "plugin/isolated_controller.h"
#include "session/session.h"
#include "widgets/fixed_text.h"
#include "widgets/message_bar.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

constexpr int lookEvery = 500, patience = 1000;  // ms
constexpr const char *faultTopic = "fault", *hangTopic = "hang", *failureTopic = "failure";

/// The names of those in a setup, each once.
QString pluginsOf(const BranchSetup& setup) {
    QStringList names;
    for (const auto& controller : setup.scenario->parts().controllers)
        if (const auto* plugin = dynamic_cast<const IsolatedController*>(controller.get()))
            names << QFileInfo(qtText(plugin->path())).fileName();
    names.removeDuplicates();
    return names.join(", ");
}

/// What to do about a plug-in's fault; empty for others.
QString adviceFor(const std::string& fault) {
    if (fault.find("its plug-in ") != 0) return {};
    if (fault.find("took longer than") != std::string::npos)
        return QObject::tr(". Rebuild it and press F5, or start with a larger --plugin-limit");
    return QObject::tr(". Mend and rebuild it, then press F5");
}

}  // namespace

FaultMessages::FaultMessages(Session& session, MessageBar& messages)
    : QObject(&session), session_(session), messages_(messages) {
    connect(&session, &Session::shown, this, [this] {
        sinceShown_.start();
        messages_.remove(hangTopic);
        showFaults();
    });
    connect(&session, &Session::failed, this, [this](const QString& error) {
        messages_.add({MessageBar::Kind::error, error, failureTopic});
    });
    look_.setInterval(lookEvery);
    connect(&look_, &QTimer::timeout, this, &FaultMessages::lookForHang);
    look_.start();
}

/// Those up to the shown tick: one that a user dismissed stays so, until there is another.
void FaultMessages::showFaults() {
    const Shown& shown = *session_.current();
    if (shown.faults == reported_) return;
    reported_ = shown.faults;
    messages_.remove(faultTopic);
    if (reported_.empty()) return;
    const BranchRecord::FirstFault& first = reported_.front();
    const Scene& scene = shown.frame->scene();
    QString text =
        tr("%1 at %2: %3")
            .arg(qtText(scene.robots[first.robot].name), clockText(scene.timeOf(first.tick)), qtText(first.what));
    text += adviceFor(first.what);
    if (reported_.size() > 1)
        text += tr("; and %n more, marked on the timeline", nullptr, static_cast<int>(reported_.size()) - 1);
    messages_.add({MessageBar::Kind::error,
                   text,
                   faultTopic,
                   {{tr("Go there"), tr("To the tick at which it happened"),
                     [this, tick = first.tick] { session_.seek(tick); }}}});
}

void FaultMessages::lookForHang() {
    if (!session_.current() || !sinceShown_.isValid() || sinceShown_.elapsed() < patience || !session_.busy()) return;
    const QString plugins = pluginsOf(*session_.current()->setup);
    if (plugins.isEmpty() || messages_.has(hangTopic)) return;
    messages_.add({MessageBar::Kind::progress,
                   tr("Waiting for a decision of %1; who takes too long is stopped").arg(plugins), hangTopic});
}

}  // namespace mrose::gui
