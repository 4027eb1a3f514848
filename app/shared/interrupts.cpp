#include "shared/interrupts.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <utility>

#include <semaphore.h>

namespace mrose {
namespace {

std::atomic<int> signalSeen{0};
static_assert(std::atomic<int>::is_always_lock_free);
sem_t interruptCame;

extern "C" void onInterruptSignal(int signal) {
    const int before = errno;
    int none = 0;
    signalSeen.compare_exchange_strong(none, signal);
    std::signal(SIGINT, SIG_DFL);
    ::sem_post(&interruptCame);
    errno = before;
}

}  // namespace

void watchInterrupts() {
    static const bool once = ::sem_init(&interruptCame, 0, 0) == 0;
    static_cast<void>(once);
    std::signal(SIGINT, onInterruptSignal);
    std::signal(SIGTERM, onInterruptSignal);
    if (std::signal(SIGHUP, onInterruptSignal) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
}

bool wasInterrupted() { return signalSeen != 0; }

int interruptedStatus() { return 128 + signalSeen; }

OnInterrupt::OnInterrupt(std::function<void()> action)
    : thread_([action = std::move(action)] {
          while (::sem_wait(&interruptCame) != 0 && errno == EINTR) {
          }
          if (wasInterrupted()) action();
      }) {}

OnInterrupt::~OnInterrupt() {
    ::sem_post(&interruptCame);
    thread_.join();
}

}  // namespace mrose
