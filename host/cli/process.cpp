// SPDX-License-Identifier: MIT
#include "metamarch/cli/process.h"

#include "metamarch/cli/command_line.h"
#include "metamarch/file/temporary_file.h"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <unistd.h>

namespace metamarch::cli {
namespace {

// Opens a file in place of each stream that the caller has closed. Reading or writing it fails, as with a
// closed stream.
void openStandardStreams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(stream, F_GETFD) == -1) { // the lowest free number is the stream's
            open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
        }
    }
}

std::atomic<bool> isWatched = false;
std::atomic<int> endingSignal = 0;
std::atomic<bool> hasUserSignal = false;
static_assert(std::atomic<int>::is_always_lock_free, "signal handlers may use no others");

// The parent sees that the signal ended the program, as it would without a handler. For process 1 the second
// signal does nothing either.
[[noreturn]] void endBySignal(const int signal) {
    removeTemporaryFiles();
    std::signal(signal, SIG_DFL);
    sigset_t blocked;
    sigemptyset(&blocked);
    sigaddset(&blocked, signal);
    pthread_sigmask(SIG_UNBLOCK, &blocked, nullptr);
    kill(getpid(), signal);
    _exit(128 + signal);
}

void endOrRemember(const int signal) {
    int none = 0;
    if (!isWatched || !endingSignal.compare_exchange_strong(none, signal)) {
        endBySignal(signal);
    }
}

void rememberUserSignal(int /*signal*/) { hasUserSignal = true; }

// A signal that the caller has the program ignore (nohup) stays ignored.
void handle(const int signal) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_IGN && getpid() != 1) {
        return;
    }
    action = {};
    action.sa_handler = endOrRemember;
    action.sa_flags = SA_RESTART; // what waits goes on: the flag is read between submissions
    sigfillset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
}

[[noreturn]] void endByException() {
    const int code = reportCurrentException();
    removeTemporaryFiles();
    _exit(code);
}

} // namespace

void initProcess() {
    openStandardStreams();
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
        handle(signal);
    }
    struct sigaction user {};
    user.sa_handler = rememberUserSignal;
    user.sa_flags = SA_RESTART;
    sigaction(SIGUSR1, &user, nullptr);
    std::set_terminate(endByException);
}

SignalWatch::SignalWatch() {
    endingSignal = 0;
    isWatched = true;
}

SignalWatch::~SignalWatch() { isWatched = false; }

int SignalWatch::ending() const { return endingSignal; }

bool SignalWatch::takeUserSignal() { return hasUserSignal.exchange(false); }

void endBy(const int signal) { endBySignal(signal); }

} // namespace metamarch::cli
