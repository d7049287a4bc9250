// A progress bar on a terminal, nothing elsewhere.
#pragma once
#include <chrono>
#include <optional>
#include <string>

namespace metamarch::cli {

// Draws on stderr while it lives, if that is a terminal and `wanted`; leaves a clean line behind.
class Progress {
  public:
    Progress(std::string label, bool wanted);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(double part); // 0..1

  private:
    std::string label;
    bool visible;
    std::chrono::steady_clock::time_point lastDrawn{};
};

// Of a device, which may spend its first submission on compiling.
class DeviceProgress {
  public:
    explicit DeviceProgress(bool progressWanted);

    void show(double part); // 0..1, after each submission

  private:
    bool wanted;
    bool isCompiling = true;
    std::optional<Progress> bar;
};

} // namespace metamarch::cli
