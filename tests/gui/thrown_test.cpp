// What work in another thread throws is an error message of that work, and everything goes on.
#include <QApplication>
#include <stdexcept>

#include <gmock/gmock.h>

#include "gui/window_fixture.h"
#include "session/background_work.h"
#include "session/job_queue.h"
#include "widgets/message_bar.h"

namespace mrose::gui {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

[[noreturn]] void throwLength() { throw std::length_error("vector::_M_default_append"); }

class JobQueueTest : public testing::Test {
protected:
    using Answer = Expected<std::string>;
    template <class Job>
    void run(Job job) {
        queue.run(job, [this](const Answer& answer) { said.push_back(answer ? *answer : answer.error().message()); });
    }
    void runAnswer(const std::string& answer) {
        run([answer](const GoesOn&) -> Answer { return answer; });
    }
    JobQueue queue;
    std::vector<std::string> said;
};

TEST_F(JobQueueTest, JobThatThrowsHasFailedAndTheNextOneIsDone) {
    run([](const GoesOn&) -> Answer { throwLength(); });
    runAnswer("the next one");
    queue.settle();
    EXPECT_THAT(said, ElementsAre("failed: vector::_M_default_append", "the next one"));
}

TEST_F(JobQueueTest, AnswersThatThrowHaveFailedToo) {
    int taken = 0;
    queue.run(
        [this](const GoesOn&) -> Answer {
            queue.report([] { throwLength(); });
            return "done";
        },
        [&](const Answer& answer) {
            if (++taken == 2) throw 7;
            said.push_back(answer ? *answer : answer.error().message());
        });
    runAnswer("the next one");
    queue.settle();
    EXPECT_THAT(said, ElementsAre("failed: vector::_M_default_append", "failed for an unknown reason", "the next one"));
}

TEST_F(JobQueueTest, WhoIsNotWantedAnyMoreSaysNothingAndHoldsNobodyUp) {
    std::promise<void> begun, go;
    run([&begun, going = go.get_future().share()](const GoesOn&) -> Answer {
        begun.set_value();
        going.wait();
        throwLength();
    });
    begun.get_future().wait();
    queue.drop();
    EXPECT_FALSE(queue.busy());
    runAnswer("the next one");
    queue.settle();
    EXPECT_THAT(said, ElementsAre("the next one")) << "while the dropped one still waits";
    go.set_value();
}

class ThrownTest : public WindowTest {
protected:
    std::vector<std::string> errors() const {
        std::vector<std::string> texts;
        for (const MessageBar::Message& message : window.messages().messages())
            if (message.kind == MessageBar::Kind::error) texts.push_back(message.text.toStdString());
        return texts;
    }
    /// How background work that does this ends.
    std::string outcomeOf(const BackgroundWork::Job& job) {
        std::string said;
        const auto done = [&](const BackgroundWork::Outcome& outcome) {
            said = outcome ? "no error" : outcome.error().message();
        };
        EXPECT_TRUE(window.background().start("work", job, done));
        window.background().settle();
        return said;
    }
    void expectGoesOn() {
        window.session().seek(20, false);
        settle();
        EXPECT_EQ(window.shown()->tick(), 20);
    }
};

TEST_F(ThrownTest, InBackgroundWorkItIsTheOutcome) {
    EXPECT_EQ(outcomeOf([](const Progress&) -> BackgroundWork::Outcome { throwLength(); }),
              "failed: vector::_M_default_append");
    EXPECT_EQ(outcomeOf([](const Progress&) -> BackgroundWork::Outcome { return true; }), "no error");
}

TEST_F(ThrownTest, WhatTheWindowThrowsWhenAskedIsOfWhoAsked) {
    EXPECT_EQ(outcomeOf([this](const Progress&) -> BackgroundWork::Outcome {
                  const auto answer = askWindow<bool>(
                      window, []() -> bool { throwLength(); }, [] { return true; });
                  return answer.value_or(false);
              }),
              "failed: vector::_M_default_append");
}

TEST_F(ThrownTest, InTheSessionItIsSaidAndTheSessionGoesOn) {
    window.session().play();
    window.session().doLongWork("work", [](TimeTravel&, const Progress&) { throwLength(); });
    settle();
    QApplication::processEvents();
    EXPECT_THAT(errors(), ElementsAre("failed: vector::_M_default_append"));
    EXPECT_FALSE(window.shown()->playing);
    EXPECT_FALSE(window.messages().has("work"));
    expectGoesOn();
    window.messages().clear();
    window.session().look([](TimeTravel*, std::uint64_t) { throw std::bad_alloc(); });
    expectGoesOn();
    QApplication::processEvents();
    EXPECT_THAT(errors(), ElementsAre(HasSubstr("more memory than this computer has")));
}

}  // namespace
}  // namespace mrose::gui
