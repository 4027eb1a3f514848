#include "export/film.h"

#include <QFileInfo>
#include <QStandardPaths>
#include <utility>

#include "frame/actions.h"
#include "io/file.h"
#include "widgets/qt_text.h"

namespace mrose::gui {
namespace {

constexpr int pipePatience = 50;  // ms, between looks at whether it is to go on

QStringList ffmpegArguments(const QSize& size, double framesPerSecond, const std::filesystem::path& file) {
    const QString pixels = QString("%1x%2").arg(size.width()).arg(size.height());
    const QString rate = QString::number(framesPerSecond, 'g', 10);
    return {"-hide_banner", "-loglevel", "error", "-y",
            // what comes in
            "-f", "rawvideo", "-pixel_format", "bgr0", "-video_size", pixels, "-framerate", rate, "-i", "pipe:0",
            // what goes out: as players and browsers expect it
            "-vf", "scale=out_color_matrix=bt709:out_range=tv", "-c:v", "libx264", "-preset", "medium", "-crf", "18",
            "-pix_fmt", "yuv420p", "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709",
            "-color_range", "tv", "-movflags", "+faststart", "-f", "mp4",
            "file:" + qtText(std::filesystem::absolute(file).string())};
}

/// Of what a program said on standard error.
QString lastLine(const QByteArray& said) {
    const QList<QByteArray> lines = said.trimmed().split('\n');
    return QString::fromLocal8Bit(lines.last()).trimmed();
}

}  // namespace

Expected<void> checkEncoder() {
    if (!QStandardPaths::findExecutable("ffmpeg").isEmpty()) return {};
    return fail("", "needs the program ffmpeg, which is not installed: sudo apt install ffmpeg; or export pictures");
}

Expected<void> checkFilm(const QString& path) {
    const std::string name = path.toStdString();
    if (QFileInfo(path).suffix().toLower() != "mp4") return fail(name, "is no film that can be written; expected .mp4");
    if (const auto can = checkEncoder(); !can) return fail(name, can.error().cause);
    return checkWritable(name);
}

Film::Film(const QString& path, GoesOn goesOn) : path_(path), file_(path.toStdString()), goesOn_(std::move(goesOn)) {}

Expected<std::unique_ptr<FrameSink>> Film::begin(const QString& path, const QSize& size, double framesPerSecond,
                                                 GoesOn goesOn) {
    if (auto can = checkFilm(path); !can) return tl::unexpected(can.error());
    std::unique_ptr<Film> film(new Film(path, std::move(goesOn)));
    if (auto begun = film->file_.write({}); !begun) return tl::unexpected(begun.error());
    film->ffmpeg_.setStandardOutputFile(QProcess::nullDevice());
    film->ffmpeg_.start(QStandardPaths::findExecutable("ffmpeg"),
                        ffmpegArguments(size, framesPerSecond, film->file_.beside()));
    if (!film->ffmpeg_.waitForStarted())
        return fail(path.toStdString(), "ffmpeg cannot be started: " + film->ffmpeg_.errorString().toStdString());
    return std::unique_ptr<FrameSink>(std::move(film));
}

Film::~Film() {
    if (ffmpeg_.state() == QProcess::NotRunning) return;
    ffmpeg_.kill();
    ffmpeg_.waitForFinished();
}

tl::unexpected<Error> Film::broken() {
    ffmpeg_.waitForFinished();
    said_ += ffmpeg_.readAllStandardError();
    const QString line = lastLine(said_);
    const bool killed = ffmpeg_.exitStatus() == QProcess::CrashExit;
    return fail(path_.toStdString(), line.isEmpty() ? (killed ? "ffmpeg was ended before its end"
                                                              : "ffmpeg ended before its end and gave no reason")
                                                    : "ffmpeg: " + line.toStdString());
}

Expected<void> Film::add(const QImage& frame) {
    const QImage plain = frame.convertToFormat(QImage::Format_RGB32);
    ffmpeg_.write(reinterpret_cast<const char*>(plain.constBits()), plain.sizeInBytes());
    while (ffmpeg_.state() == QProcess::Running && ffmpeg_.bytesToWrite() > 0 && goesOn_())
        ffmpeg_.waitForBytesWritten(pipePatience);
    said_ += ffmpeg_.readAllStandardError();
    if (ffmpeg_.state() != QProcess::Running) return broken();
    return {};
}

Expected<bool> Film::finish() {
    ffmpeg_.closeWriteChannel();
    while (ffmpeg_.state() == QProcess::Running && goesOn_()) ffmpeg_.waitForFinished(pipePatience);
    if (ffmpeg_.state() == QProcess::Running) return false;
    if (ffmpeg_.exitStatus() != QProcess::NormalExit || ffmpeg_.exitCode() != 0) return broken();
    std::error_code ignored;
    if (std::filesystem::file_size(file_.beside(), ignored) == 0)
        return fail(path_.toStdString(), "ffmpeg wrote nothing");
    if (auto replaced = file_.replace(); !replaced) return tl::unexpected(replaced.error());
    return true;
}

}  // namespace mrose::gui
