#include "export/sequence_export.h"

#include <QPainter>
#include <chrono>
#include <cmath>
#include <thread>

#include "export/export_outcome.h"
#include "export/film.h"
#include "export/frame_folder.h"
#include "frame/actions.h"
#include "panels/plot_panel.h"
#include "session/background_work.h"
#include "session/lineage_walk.h"
#include "widgets/field_view.h"

namespace mrose::gui {
namespace {

constexpr double mostFrames = 200'000, mostRate = 1000, mostTime = 1e7;
constexpr int leastPixels = 16, mostPixels = 8192;
constexpr auto shortPause = std::chrono::milliseconds(5);

/// A frame's picture; nullopt where it is not to go on.
using FramePicture = std::optional<Expected<QImage>>;
using FrameSource = std::function<FramePicture(std::int64_t tick, const GoesOn&)>;

/// Where the pixels of a frame come from: what is `shown` as large as asked for.
struct FrameSize {
    QSize shown, image;

    double ratio() const {
        return std::min(image.width() / static_cast<double>(shown.width()),
                        image.height() / static_cast<double>(shown.height()));
    }
    /// Where what is shown begins, in the middle of the image.
    QPoint corner() const {
        const QSizeF free = QSizeF(image) - ratio() * QSizeF(shown);
        return {static_cast<int>(free.width() / 2), static_cast<int>(free.height() / 2)};
    }
    /// A film's sides are even.
    FrameSize even() const { return {shown, {image.width() & ~1, image.height() & ~1}}; }
};

/// A frame on which `paint` draws in the pixels of what is shown, from `corner` on.
QImage frameOf(const FrameSize& asked, const QSize& image, const QColor& ground, const QPoint& corner,
               const std::function<void(QPainter&)>& paint) {
    QImage frame(image, QImage::Format_RGB32);
    frame.fill(ground);
    QPainter painter(&frame);
    painter.translate(corner);
    if (asked.ratio() != 1) painter.scale(asked.ratio(), asked.ratio());
    paint(painter);
    return frame;
}

/// What belongs to an export from its start to its end.
struct SequenceJob {
    std::vector<std::int64_t> ticks;
    double rate = 0;
    FrameSize asked;
    QSize image;
    std::uint64_t run = 0;
    std::uint32_t branch = 0;
    FrameSource source;
    std::function<Expected<std::unique_ptr<FrameSink>>(const SequenceJob&, const GoesOn&)> begin;
};

/// Paints the field beside the session and the window.
FrameSource fieldSource(const Exports& exports, const SequenceJob& job) {
    auto walk = std::make_shared<LineageWalk>(exports.frame.session, job.run, job.branch);
    auto picture = std::make_shared<FieldPicture>(exports.field.picture());
    return [&session = exports.frame.session, walk, picture, asked = job.asked, image = job.image](
               std::int64_t tick, const GoesOn& goesOn) -> FramePicture {
        std::optional<FieldFrame> frame;
        const auto visited = walk->visit(
            {&tick, 1},
            [&](const TimeTravel& travel, const Cursor& at) { frame = frameOf(travel, at, session.frameOptions()); },
            goesOn);
        if (!visited) return tl::unexpected(visited.error());
        if (!*visited) return {};
        const QSizeF all = QSizeF(asked.image) / asked.ratio();
        return frameOf(asked, image, picture->theme.surround, {},
                       [&](QPainter& painter) { picture->paint(painter, all, *frame); });
    };
}

/// The window at a tick, once all of it is there.
FrameSource windowSource(const Exports& exports, const SequenceJob& job) {
    // Null: it is not there yet. The user may have moved it meanwhile, so that it is asked to go there again.
    const auto draw = [&exports, run = job.run, branch = job.branch, asked = job.asked,
                       image = job.image](std::int64_t tick) {
        return [&exports, run, branch, asked, image, tick]() -> Expected<QImage> {
            const Shown& shown = *exports.frame.shown();
            if (shown.run != run) return fail("", "another run was opened meanwhile");
            if (shown.branch == branch && tick < shown.first)
                return fail("", "tick " + std::to_string(tick) + " is not known any more");
            if (shown.branch != branch || shown.tick() != tick) {
                if (!shown.playing && exports.frame.session.busy()) return QImage();
                exports.frame.session.pause();
                exports.frame.session.show(branch, tick);
                return QImage();
            }
            if (exports.plots.series().behind() > 0) return QImage();
            exports.plots.settle();
            return frameOf(asked, image, exports.frame.window.palette().color(QPalette::Window), asked.corner(),
                           [&](QPainter& painter) {
                               exports.frame.window.render(&painter, {}, {},
                                                           QWidget::DrawWindowBackground | QWidget::DrawChildren);
                           });
        };
    };
    return [&exports, draw](std::int64_t tick, const GoesOn& goesOn) -> FramePicture {
        while (true) {
            auto made = askWindow<Expected<QImage>>(exports.frame.window, draw(tick), goesOn);
            if (!made || !*made || !(*made)->isNull()) return made;
            std::this_thread::sleep_for(shortPause);
        }
    };
}

Expected<bool> writeSequence(const SequenceJob& job, Session& session, const Progress& progress) {
    double share = 0;
    const GoesOn goesOn = [&] { return progress(share); };
    LineageWalk walk(session, job.run, job.branch);
    if (auto known = walk.reach(job.ticks.back(), QObject::tr("Simulating what is to be exported"), goesOn);
        !known || !*known)
        return known;
    auto sink = job.begin(job, goesOn);
    if (!sink) return tl::unexpected(sink.error());
    for (std::size_t k = 0; k < job.ticks.size(); ++k) {
        share = static_cast<double>(k) / static_cast<double>(job.ticks.size());
        const FramePicture picture = job.source(job.ticks[k], goesOn);
        if (!picture || !goesOn()) return false;
        if (!*picture) return tl::unexpected(picture->error());
        if (auto added = (*sink)->add(**picture); !added) return tl::unexpected(added.error());
    }
    if (!goesOn()) return false;
    return (*sink)->finish();
}

/// Where a run is, to come back to.
struct Place {
    std::uint64_t run;
    std::uint32_t branch;
    std::int64_t tick;
    std::optional<std::uint32_t> beside;
    bool playing;
};

Place placeOf(const Shown& shown) { return {shown.run, shown.branch, shown.tick(), shown.besideBranch, shown.playing}; }

void comeBack(const Exports& exports, const Place& place) {
    if (exports.frame.shown()->run != place.run) return;
    exports.frame.session.show(place.branch, place.tick);
    exports.frame.session.ask([=](Debugger& debugger) { debugger.run().setBeside(place.beside); });
    if (place.playing) exports.frame.session.play();
}

Expected<SequenceJob> prepare(const Exports& exports, SequenceSettings settings) {
    if (exports.frame.shown() == nullptr) return fail("", "nothing is open");
    const Shown& shown = *exports.frame.shown();
    const Scene& scene = shown.frame->scene();
    const Nanoseconds first = scene.timeOf(shown.first);
    const Nanoseconds last =
        shown.last > shown.first ? scene.timeOf(shown.last) : first + shown.frame->scenario->parts().duration;
    settings.from = settings.from.value_or(toSeconds(first));
    settings.to = settings.to.value_or(std::max(*settings.from, toSeconds(last)));
    auto ticks = sequenceTicks(settings, scene.tickLength);
    if (!ticks) return tl::unexpected(ticks.error());
    SequenceJob job;
    job.ticks = std::move(*ticks);
    if (job.ticks.front() < shown.first)
        return fail("", "the run is known from " + std::to_string(toSeconds(first)) + " s on; expected a later start");
    job.rate = settings.framesPerSecond;
    job.asked.shown = settings.wholeWindow ? exports.frame.window.size() : exports.field.size();
    job.asked.image = settings.size.isEmpty() ? job.asked.shown : settings.size;
    job.image = job.asked.image;
    job.run = shown.run;
    job.branch = shown.branch;
    return job;
}

Expected<void> start(const Exports& exports, SequenceJob job, const QString& path, bool wholeWindow) {
    job.source = wholeWindow ? windowSource(exports, job) : fieldSource(exports, job);
    std::function<void()> after;
    if (wholeWindow) after = [&exports, place = placeOf(*exports.frame.shown())] { comeBack(exports, place); };
    const QString what = QObject::tr("Exporting %1").arg(path);
    return exportInBackground(
        exports, {what, path, wholeWindow},
        [job = std::move(job), &session = exports.frame.session](const Progress& progress) {
            return writeSequence(job, session, progress);
        },
        after);
}

}  // namespace

Expected<std::vector<std::int64_t>> sequenceTicks(const SequenceSettings& settings, Nanoseconds tickLength) {
    const double from = settings.from.value_or(0), to = settings.to.value_or(0);
    if (!(from >= 0 && to <= mostTime)) return fail("", "expected times from 0 s on");
    if (!(from <= to)) return fail("", "expected a stretch that begins before it ends");
    if (!(settings.framesPerSecond > 0 && settings.framesPerSecond <= mostRate))
        return fail("", "expected frames per second above 0, and 1000 at the most");
    if (!(settings.speed > 0 && std::isfinite(settings.speed))) return fail("", "expected a speed above 0");
    const QSize& size = settings.size;
    const auto fits = [](int pixels) { return pixels >= leastPixels && pixels <= mostPixels; };
    if (!size.isEmpty() && !(fits(size.width()) && fits(size.height())))
        return fail("", "expected a size from 16 to 8192 pixels in each direction");
    const double apart = settings.speed / settings.framesPerSecond;  // s
    const double frames = std::floor((to - from) / apart + 1e-6) + 1;
    if (!(frames <= mostFrames))
        return fail("", "these are more than 200000 frames; expected a shorter stretch, or a higher speed");
    std::vector<std::int64_t> ticks;
    for (std::int64_t k = 0; k < static_cast<std::int64_t>(frames); ++k)
        ticks.push_back(std::llround((from + static_cast<double>(k) * apart) / toSeconds(tickLength)));
    return ticks;
}

Expected<void> exportFrames(const Exports& exports, const QString& folder, const SequenceSettings& settings) {
    auto job = prepare(exports, settings);
    if (!job) return tl::unexpected(job.error());
    if (auto free = checkFrameFolder(folder.toStdString()); !free) return free;
    job->begin = [folder = folder.toStdString()](const SequenceJob& of, const GoesOn&) {
        return FrameFolder::begin(folder, of.ticks.size());
    };
    return start(exports, std::move(*job), folder, settings.wholeWindow);
}

Expected<void> exportFilm(const Exports& exports, const QString& file, const SequenceSettings& settings) {
    auto job = prepare(exports, settings);
    if (!job) return tl::unexpected(job.error());
    if (auto can = checkFilm(file); !can) return can;
    job->image = job->asked.even().image;
    job->begin = [file](const SequenceJob& of, const GoesOn& goesOn) {
        return Film::begin(file, of.image, of.rate, goesOn);
    };
    return start(exports, std::move(*job), file, settings.wholeWindow);
}

}  // namespace mrose::gui
