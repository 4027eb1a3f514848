// Outputs that cannot be written, and runs that end before their time: what was there before stays.
#include <csignal>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "motion/motion_network.h"
#include "support/places.h"
#include "support/workshop.h"

namespace mrose {
namespace {

using Output = Workshop;

std::vector<std::string> longTraining(std::vector<std::string> words) {
    for (std::size_t i = 0; i + 1 < words.size(); ++i)
        if (words[i] == "--epochs") words[i + 1] = "10000000";
    words.insert(words.end(), {"--patience", "10000000"});
    return words;
}

std::vector<std::string> mroseWords(std::vector<std::string> words) {
    words.insert(words.begin(), mroseProgram());
    return words;
}

TEST_F(Output, PlacesThatCannotBeWrittenAreNamedBeforeAnyWork) {
    std::filesystem::create_directory(path("folder"));
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    const std::string net = network();
    const auto before = (windows(), listing());
    for (const auto& [out, cause] :
         {std::pair{path("no/such/b.net"), "No such file or directory"}, std::pair{path("folder"), "is a folder"},
          std::pair{path("pipe"), "is no regular file"}, std::pair{path("log.csv/b.net"), "Not a directory"}}) {
        expectOneLine(runMrose(trainWords(out)), {out + ": ", cause});
        expectOneLine(runMrose({"predict", net, "--log", log(), "--windows", windows(), "-o", out}),
                      {out + ": ", cause});
    }
    for (const std::string folder : {"log.csv", "log.csv/report"})
        expectOneLine(runMrose({"evaluate", path("none"), "--log", path("none"), "--report", path(folder)}),
                      {path(folder) + ": ", "log.csv is no folder"});
    expectOneLine(runMrose({"evaluate", path("none"), "--log", path("none"), "--report", "/proc/report"}),
                  {"/proc/report: cannot be written: "});
    EXPECT_EQ(listing(), before);
    EXPECT_TRUE(std::filesystem::is_fifo(path("pipe"))) << "neither it nor a device is ever replaced";
}

TEST_F(Output, ReadOnlyFolderIsNamed) {
    if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
    const std::string log = this->log();
    write("locked/b.net", "earlier");
    std::filesystem::permissions(path("locked"),
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    expectOneLine(runMrose(trainWords(path("locked/b.net"))), {"locked/b.net: ", "Permission denied"});
    std::filesystem::permissions(path("locked"), std::filesystem::perms::owner_all);
    EXPECT_EQ(read("locked/b.net"), "earlier");
}

TEST_F(Output, FullDiskKeepsEarlierOutputs) {
    const std::string net = network(), windowsFile = windows(), logFile = log();
    write("b.net", "earlier network");
    write("p.csv", "earlier predictions");
    for (const char* name : {"report/report.html", "report/results.csv", "report/results.json"}) write(name, "earlier");
    const auto before = listing();
    std::vector<std::string> train = trainWords(path("b.net"));
    train.insert(train.end(), {"--quiet", "--overwrite"});
    expectOneLine(runMrose(train, {.fullDisk = true}), {"b.net: cannot be written: File too large"});
    expectOneLine(
        runMrose({"predict", net, "--log", logFile, "--windows", windowsFile, "-o", path("p.csv"), "--overwrite"},
                 {.fullDisk = true}),
        {"p.csv: cannot be written: File too large"});
    expectOneLine(
        runMrose({"evaluate", net, "--log", logFile, "--report", path("report"), "--overwrite"}, {.fullDisk = true}),
        {"report/results.csv: cannot be written: File too large"});
    EXPECT_EQ(read("b.net"), "earlier network");
    EXPECT_EQ(read("p.csv"), "earlier predictions");
    for (const char* name : {"report/report.html", "report/results.csv", "report/results.json"})
        EXPECT_EQ(read(name), "earlier") << name;
    EXPECT_EQ(listing(), before) << "nothing half-written is left";
    expectOneLine(runMrose({"evaluate", net, "--log", logFile, "--report", path("new/report")}, {.fullDisk = true}),
                  {"new/report/results.csv: cannot be written: File too large"});
    expectOneLine(runMrose({"generate", "--pattern", "ellipse", "-q", "-o", path("new/logs")}, {.fullDisk = true}),
                  {"new/logs/ellipse.csv: cannot be written: File too large"});
    expectOneLine(runMrose({"shapes", "ball.toml", "-o", path("new/pictures")}, {.fullDisk = true}),
                  {"new/pictures/ball.shape.svg: cannot be written: File too large"});
    EXPECT_EQ(listing(), before) << "nor a folder";
}

/// Ctrl-C, a scheduler, a terminal that closes.
TEST_F(Output, InterruptSavesTheBestNetworkSoFar) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        std::filesystem::remove(path("b.net"));
        const auto before = (log(), listing());
        RunningProgram program(mroseWords(longTraining(trainWords(path("b.net")))));
        ASSERT_TRUE(program.waitForError("epoch "));
        program.send(signal);
        // Schedulers and terminals say it more than once.
        for (int i = 0; i < 100 && signal != SIGINT; ++i) {
            ::usleep(1000);
            program.send(signal);
        }
        const ProgramResult result = program.finish();
        EXPECT_EQ(result.status, 128 + signal) << result.err;
        EXPECT_NE(result.out.find("interrupted"), std::string::npos) << result.out;
        EXPECT_TRUE(loadNetwork(path("b.net")));
        EXPECT_EQ(runMrose({"evaluate", path("b.net"), "--log", log()}).status, 0);
        EXPECT_EQ(listing().size(), before.size() + 1);
    }
}

TEST_F(Output, HangupIsIgnoredWhereItWasBefore) {
    std::string command = "trap '' HUP; exec";
    for (const std::string& word : mroseWords(longTraining(trainWords(path("b.net"))))) command += " '" + word + "'";
    RunningProgram program({"/bin/sh", "-c", command});
    ASSERT_TRUE(program.waitForError("epoch "));
    program.send(SIGHUP);
    ::sleep(1);
    program.send(SIGTERM);
    EXPECT_EQ(program.finish().status, 128 + SIGTERM);
}

/// It reads a network from a pipe, and so waits until the signal has come.
TEST_F(Output, InterruptedEvaluationWritesNothing) {
    const std::string net = network(), content = read("a.net");
    ASSERT_EQ(::mkfifo(path("pipe.net").c_str(), 0600), 0);
    const auto before = listing();
    RunningProgram program(
        {mroseProgram(), "evaluate", net, "--log", log(), "--against", path("pipe.net"), "--report", path("report")});
    const int pipe = ::open(path("pipe.net").c_str(), O_WRONLY);  // waits until it is read
    program.send(SIGTERM);
    const auto handler = ::signal(SIGPIPE, SIG_IGN);
    EXPECT_EQ(::write(pipe, content.data(), content.size()), static_cast<ssize_t>(content.size()));
    ::close(pipe);
    ::signal(SIGPIPE, handler);
    expectOneLine(program.finish(), {"interrupted; nothing written"}, 128 + SIGTERM);
    EXPECT_EQ(listing(), before);
}

TEST_F(Output, KillInMidTrainingLeavesTheEarlierNetwork) {
    write("b.net", "earlier");
    const auto before = (log(), listing());
    std::vector<std::string> words = longTraining(trainWords(path("b.net")));
    words.push_back("--overwrite");
    RunningProgram program(mroseWords(words));
    ASSERT_TRUE(program.waitForError("epoch "));
    program.send(SIGKILL);
    EXPECT_EQ(program.finish().status, 128 + SIGKILL);
    EXPECT_EQ(read("b.net"), "earlier");
    EXPECT_EQ(listing(), before);
}

TEST_F(Output, PartOfSomebodyElseStaysWhatItIs) {
    write("b.net.part", "somebody's");
    expectOneLine(runMrose({"train", path("none.csv"), "-o", path("b.net")}), {"none.csv"});
    EXPECT_EQ(read("b.net.part"), "somebody's");
    ASSERT_EQ(runMrose(trainWords(path("b.net"))).status, 0);
    EXPECT_TRUE(loadNetwork(path("b.net")));
    EXPECT_EQ(read("b.net.part"), "somebody's");
}

TEST_F(Output, PrivateNetworkStaysPrivate) {
    write("b.net", "earlier");
    std::filesystem::permissions(path("b.net"), std::filesystem::perms(0600));
    std::vector<std::string> words = trainWords(path("b.net"));
    words.push_back("--overwrite");
    ASSERT_EQ(runMrose(words).status, 0);
    EXPECT_TRUE(loadNetwork(path("b.net")));
    EXPECT_EQ(std::filesystem::status(path("b.net")).permissions(), std::filesystem::perms(0600));
}

}  // namespace
}  // namespace mrose
