#pragma once

#include <QProcess>
#include <QSize>
#include <QString>
#include <memory>

#include "export/frame_sink.h"
#include "io/pending_file.h"
#include "io/progress.h"

namespace mrose::gui {

/// Error where there is no `ffmpeg` on this computer: what to install.
Expected<void> checkEncoder();
/// Error unless a film can be written there: another extension than .mp4, a place that cannot be written, or no
/// `ffmpeg` on this computer; then it says what to install.
Expected<void> checkFilm(const QString& path);

/// MP4 (H.264, yuv420p, BT.709) by the program `ffmpeg`, which gets the frames through a pipe. The file appears when it
/// is whole. Of one thread.
class Film final : public FrameSink {
public:
    /// Frames of this size, even in both directions. It does not wait for ffmpeg once `goesOn` says no more. Error: as
    /// checkFilm(); ffmpeg cannot be started.
    static Expected<std::unique_ptr<FrameSink>> begin(const QString& path, const QSize& size, double framesPerSecond,
                                                      GoesOn goesOn);
    ~Film() override;

    /// Error: what ffmpeg said last.
    Expected<void> add(const QImage& frame) override;
    Expected<bool> finish() override;

private:
    Film(const QString& path, GoesOn goesOn);
    tl::unexpected<Error> broken();

    QString path_;
    PendingFile file_;
    GoesOn goesOn_;
    QProcess ffmpeg_;
    QByteArray said_;
};

}  // namespace mrose::gui
