// SPDX-License-Identifier: MIT
// Runs the program each time that a test asks for it on standard input, in a process of its own. The tests
// save the 0.3 s that the dynamic linker takes for each start of the program.
//
// A request is a line of JSON: {"words": [arguments], "cwd": folder, "environment": {name: value}, "stdout":
// file, "stderr": file}. The answer is a line with the exit code, or the negative number of the signal that
// ended the program.
#include "metamarch/cli/program.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <iostream>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace {

void redirect(const int stream, const std::string& file) {
    const int opened =
        open(file.c_str(), stream == STDIN_FILENO ? O_RDONLY : O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (opened == -1 || dup2(opened, stream) == -1) {
        std::abort();
    }
    close(opened);
}

[[noreturn]] void run(const nlohmann::json& request) {
    redirect(STDIN_FILENO, "/dev/null");
    redirect(STDOUT_FILENO, request["stdout"]);
    redirect(STDERR_FILENO, request["stderr"]);
    std::filesystem::current_path(request["cwd"].get<std::string>());
    clearenv();
    for (const auto& [name, value] : request["environment"].items()) {
        setenv(name.c_str(), value.get<std::string>().c_str(), 1);
    }
    const std::vector<std::string> words = request["words"];
    std::vector<const char*> arguments = {"metamarch"};
    for (const std::string& word : words) {
        arguments.push_back(word.c_str());
    }
    const int code = metamarch::cli::runProgram(static_cast<int>(arguments.size()), arguments.data());
    // Not exit(): a library (log4cplus, by way of OpenImageIO) would wait for its threads, which only the
    // parent has.
    std::fflush(nullptr);
    _exit(code);
}

} // namespace

int main() {
    std::string line;
    while (std::getline(std::cin, line)) {
        const nlohmann::json request = nlohmann::json::parse(line);
        const pid_t child = fork();
        if (child == 0) {
            run(request);
        }
        int status = 0;
        if (child == -1 || waitpid(child, &status, 0) != child) {
            return 1;
        }
        std::cout << (WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status)) << std::endl;
    }
}
