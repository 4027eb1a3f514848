#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "debug/debugger.h"
#include "debug/run_recorder.h"

namespace mrose {

/// A debugger whose run plays in real time, is written to a file, and looked through for what is not yet known of it:
/// in turns of about a frame, so that one thread also answers what is asked for.
class LiveRun {
public:
    using Clock = std::chrono::steady_clock;
    static constexpr auto framePeriod = std::chrono::microseconds(16'667);

    /// Called when the file of a recording is whole, or can be written no further; the run goes on.
    using RecordingEnded = std::function<void(const Expected<void>&)>;
    explicit LiveRun(RecordingEnded recordingEnded) : recordingEnded_(std::move(recordingEnded)) {}

    /// Another run, standing at its start; recording ends.
    void open(const OpenedRun& run);
    Debugger& debugger() { return debugger_; }

    /// What is due; whether there is something new to show. False of `goesOn` ends it. `changed`: there is in any case.
    bool turn(bool changed, const Progress& goesOn);
    /// Whether there will be something due without anybody asking.
    bool goesOn() const { return debugger_.playing() || learning_ || learningBreaks_ || recording_; }
    /// What cannot be gone on with is not tried again.
    void giveUp();

    /// Simulated seconds per second; 0: as fast as possible.
    void setSpeed(double speed);
    /// Ticks are due from now and from the shown one on.
    void anchor();
    double realTimeFactor() const { return debugger_.playing() ? factor_ : 0; }

    /// Writes the run to a file from now on, with all that was before. Error: of RunRecorder::begin().
    Expected<void> record(const std::filesystem::path& path, const std::string& commandLine, bool overwrite);
    /// Some of what is not written yet.
    void followRecording();
    void stopRecording();

private:
    bool playTicks(const Progress& goesOn);
    bool learn();
    bool learnBreaks();
    void endRecording(const Expected<void>& written);

    /// An instant, and the tick that was shown then.
    struct Instant {
        Clock::time_point time;
        std::int64_t tick = 0;
    };

    Debugger debugger_;
    bool learning_ = false;        ///< there are ticks of a file that have not been looked at
    bool learningBreaks_ = false;  ///< there may be ticks of which breakpoints do not know whether they are met
    std::optional<RunRecorder> recorder_;
    bool recording_ = false;  ///< there are ticks that it has not yet written
    Clock::time_point nextFlush_;
    RecordingEnded recordingEnded_;
    double speed_ = 1;
    Instant anchor_;    ///< ticks are due from there on
    Instant measured_;  ///< the speed achieved is measured from there on
    double factor_ = 0;
};

}  // namespace mrose
