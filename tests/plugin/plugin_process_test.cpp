// The processes that isolated plug-ins run in, and hosts that do not keep to what was agreed.
#include <array>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <thread>

#include <gtest/gtest.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/bytes.h"
#include "io/file.h"
#include "messages/decision_bytes.h"
#include "messages/observation_bytes.h"
#include "messages/text_bytes.h"
#include "plugin/load_plugin.h"
#include "plugin/plugin_message.h"
#include "plugin/test_plugins.h"
#include "support/observation_parts.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/temporary_folder.h"
#include "world/command_history.h"

namespace mrose {
namespace {

/// Processes whose parent is `parent`, by what the system says of all.
std::vector<pid_t> childrenOf(pid_t parent) {
    std::vector<pid_t> children;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
        const std::string name = entry.path().filename();
        pid_t process = 0;
        if (std::from_chars(name.data(), name.data() + name.size(), process).ec != std::errc{}) continue;
        const auto stat = readFile(entry.path() / "stat");
        if (!stat) continue;
        // "pid (name) state parent ..."
        int found = 0;
        if (std::sscanf(stat->c_str() + stat->rfind(')'), ") %*c %d", &found) == 1 && found == parent)
            children.push_back(process);
    }
    return children;
}

/// Whether a process is there and has not ended.
bool runs(pid_t process) {
    const auto stat = readFile("/proc/" + std::to_string(process) + "/stat");
    return stat && stat->compare(stat->rfind(')'), 3, ") Z") != 0;
}

std::shared_ptr<const Controller> apart(const std::string& name, const std::string& options,
                                        const IsolationOptions& how = isolation()) {
    const auto loaded = isolatePlugin(testPlugin(name), options, how);
    EXPECT_TRUE(loaded) << loaded.error().message();
    return loaded ? *loaded : nullptr;
}

/// A controller's first decisions, with their memory.
struct Asked {
    explicit Asked(const Controller& controller) : memory(controller.memorySize()) { controller.start(memory); }
    const Decision& decide(const Controller& controller, const Observation& observation = {}) {
        decision.clear();
        controller.decide(observation, memory, decision);
        return decision;
    }
    std::vector<std::byte> memory;
    Decision decision;
};

std::string framed(const std::string& message) {
    std::string bytes;
    appendNumber(bytes, static_cast<std::uint32_t>(message.size()));
    return bytes + message;
}

/// A host that loads a plug-in without memory of its own and answers the next message with this, whatever it is.
IsolationOptions answering(const std::string& message) {
    std::string loaded(1, static_cast<char>(PluginMessage::loaded));
    appendAttention({}, loaded);
    loaded.append(sizeof(PluginMemory), '\0');
    std::string escaped;
    for (const char c : framed(loaded) + framed(message)) {
        std::array<char, 8> octal;
        std::snprintf(octal.data(), octal.size(), "\\%03o", static_cast<unsigned>(static_cast<unsigned char>(c)));
        escaped += octal.data();
    }
    return {{"/bin/sh", "-c", "printf '" + escaped + "' >&3; exec cat <&3 >/dev/null", "sh"}, 2, 60};
}

std::string decided(std::size_t memorySize) {
    std::string message(1, static_cast<char>(PluginMessage::decided));
    appendDecision({}, message);
    return message + std::string(memorySize, '\0');
}

TEST(PluginProcesses, AnswersThatDoNotFitAreRefusedEachTime) {
    const std::string cannot = "its plug-in " + testPlugin("misbehaving") + " answered what cannot be read";
    const std::string sound = decided(sizeof(PluginMemory)), other = static_cast<char>(PluginMessage::count) + sound;
    for (const std::string& answer : {decided(sizeof(PluginMemory) - 1), decided(sizeof(PluginMemory) + 1), other,
                                      sound.substr(0, 9), std::string("x")}) {
        const auto controller = apart("misbehaving", "", answering(answer));
        EXPECT_EQ(Asked(*controller).decide(*controller).fault, cannot);
        // From a state before that, a new process is asked, and answers the same.
        EXPECT_EQ(Asked(*controller).decide(*controller).fault, cannot);
    }
    const auto controller = apart("misbehaving", "", answering(sound));
    EXPECT_EQ(Asked(*controller).decide(*controller).fault, "");
}

TEST(PluginProcesses, CommandsAPeriodAreWithinBounds) {
    const auto controller = apart("well_behaved", "");
    EXPECT_EQ(controller->commandsPerPeriod(100'000'000), 2u);
    EXPECT_EQ(controller->commandsPerPeriod(10'000'000), 1u);
    EXPECT_EQ(controller->commandsPerPeriod(std::int64_t{1} << 60), CommandHistory::capacity);
    for (const std::uint64_t count : {std::uint64_t{0}, ~std::uint64_t{0}}) {
        std::string message(1, static_cast<char>(PluginMessage::count));
        appendNumber(message, count);
        EXPECT_EQ(apart("misbehaving", "", answering(message))->commandsPerPeriod(1),
                  count == 0 ? 1u : CommandHistory::capacity);
    }
}

/// The library was built anew while the run went on, and a rewind starts its process again.
TEST(PluginProcesses, OtherMemoryThanBeforeIsAFault) {
    const auto controller = apart("misbehaving", how("exit"));
    EXPECT_NE(Asked(*controller).decide(*controller).fault.find("ended with status 0"), std::string::npos);
    ::setenv("MROSE_TEST_MORE_MEMORY", "1", 1);
    ObservationParts another;  // at the same one it fails as before
    another.robots = {{0, {1, 0}, 0}};
    EXPECT_EQ(Asked(*controller).decide(*controller, another).fault,
              "its plug-in " + testPlugin("misbehaving") + " has another memory than before");
    ::unsetenv("MROSE_TEST_MORE_MEMORY");
}

TEST(PluginProcesses, EachDecisionBeginsEmpty) {
    const auto controller = apart("misbehaving", how("hidden note"));
    Asked asked(*controller);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(asked.decide(*controller).annotations.size(), 1u);
}

/// One process serves who asks it, one after the other.
TEST(PluginProcesses, ManyThreadsMayAsk) {
    const auto controller = apart("well_behaved", "");
    std::array<int, 4> wrong{};
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < wrong.size(); ++t)
        threads.emplace_back([&, t] {
            Asked asked(*controller);
            ObservationParts observation;
            observation.robots = {{0, {static_cast<double>(t), 0}, 0}};
            for (int i = 1; i <= 500; ++i) {
                const Decision& decision = asked.decide(*controller, observation);
                wrong[t] += !decision.fault.empty() ||
                            decision.command != Command{0.5, 0.01 * static_cast<double>(t)} ||
                            decision.annotations.at(0).value != 100 + i;
            }
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, (std::array<int, 4>{}));
}

/// Neither a signal that arrives while the answer is awaited nor a process that was killed meanwhile does more than it
/// should.
TEST(PluginProcesses, SignalsAreLivedThrough) {
    const auto controller = apart("misbehaving", how("slow"));
    const auto before = ::signal(SIGALRM, [](int) {});
    struct sigaction plain {};
    plain.sa_handler = [](int) {};
    ::sigaction(SIGALRM, &plain, nullptr);
    const itimerval often{{0, 2000}, {0, 2000}}, never{};
    ::setitimer(ITIMER_REAL, &often, nullptr);
    const std::string fault = Asked(*controller).decide(*controller).fault;
    ::setitimer(ITIMER_REAL, &never, nullptr);
    ::signal(SIGALRM, before);
    EXPECT_EQ(fault, "");

    const std::vector<pid_t> children = childrenOf(::getpid());
    ASSERT_EQ(children.size(), 1u);
    EXPECT_NE(::getpgid(children[0]), ::getpgid(0)) << "Ctrl-C would reach it";
    // A scheduler tells all processes; which one ends when is the program's business.
    for (const int number : {SIGTERM, SIGINT, SIGHUP}) ::kill(children[0], number);
    EXPECT_EQ(Asked(*controller).decide(*controller).fault, "");
    ::kill(children[0], SIGKILL);
    siginfo_t ended{};
    ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(children[0]), &ended, WEXITED | WNOWAIT), 0);
    EXPECT_EQ(Asked(*controller).decide(*controller).fault,
              "its plug-in " + testPlugin("misbehaving") + " ended by signal 9 (Killed)");
}

/// A plug-in that never returns ends with the program, however that ends.
TEST(PluginProcesses, NoneOutlivesTheProgram) {
    const TemporaryFolder folder;
    const std::string scenario =
        folder
            .write("game.toml",
                   "format = \"mrose scenario\"\nversion = 1\nname = \"game\"\nenvironment = \"midsize_2001.toml\"\n"
                   "duration_s = 4.0\n[[robot]]\nname = \"bad\"\ntype = \"pioneer1.toml\"\nstart = { x_m = 0.0, y_m = "
                   "0.0, heading_deg = 0 }\n[robot.controller]\nkind = \"plugin\"\nlibrary = \"" +
                       testPlugin("misbehaving") + "\"\n[robot.controller.options]\n" +
                       how("announced loop while loading"))
            .string();
    RunningProgram program({mroseProgram(), "run", scenario, "--isolate", "--plugin-limit", "1000", "--quiet"});
    ASSERT_TRUE(program.waitForError("here it loops"));
    const std::vector<pid_t> programs = childrenOf(::getpid());
    ASSERT_EQ(programs.size(), 1u);
    const std::vector<pid_t> hosts = childrenOf(programs[0]);
    ASSERT_EQ(hosts.size(), 1u);
    program.send(SIGKILL);
    bool ended = false;
    for (int i = 0; i < 60'000 && !ended; ++i) {
        ended = !runs(hosts[0]);
        ::usleep(1000);
    }
    EXPECT_TRUE(ended);
    if (!ended) ::kill(hosts[0], SIGKILL);
}

}  // namespace
}  // namespace mrose
