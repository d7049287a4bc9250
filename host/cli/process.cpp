// SPDX-License-Identifier: MIT
#include "metamarch/cli/process.h"

#include "metamarch/cli/command_line.h"
#include "metamarch/file/temporary_file.h"

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

// Ends the program by the signal itself, so that the parent sees it. Process 1 survives that, and exits.
void endBySignal(const int signal) {
    removeTemporaryFiles();
    std::signal(signal, SIG_DFL);
    sigset_t blocked;
    sigemptyset(&blocked);
    sigaddset(&blocked, signal);
    pthread_sigmask(SIG_UNBLOCK, &blocked, nullptr);
    kill(getpid(), signal);
    _exit(128 + signal);
}

// A signal that the caller has set to be ignored (nohup) stays ignored.
void handle(const int signal) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_IGN && getpid() != 1) {
        return;
    }
    action = {};
    action.sa_handler = endBySignal;
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
    std::set_terminate(endByException);
}

} // namespace metamarch::cli
