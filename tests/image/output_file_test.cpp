// SPDX-License-Identifier: MIT
#include "file_size_limit.h"
#include "fixtures/expect_error.h"
#include "fixtures/temporary_folder.h"
#include "metamarch/file/output_file.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <fstream>
#include <future>
#include <memory>
#include <sstream>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace metamarch {
namespace {

std::string textOf(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

TEST(OutputFile, ReplacesTheFormerFileOnlyAtCommit) {
    const TemporaryFolder folder;
    writeText(folder / "a.json", "before, and longer");
    {
        OutputFile file(folder / "a.json");
        file.write(0, "after", 5);
        EXPECT_EQ(textOf(folder / "a.json"), "before, and longer");
        file.commit();
    }
    EXPECT_EQ(textOf(folder / "a.json"), "after");
    EXPECT_EQ(folder.fileCount(), 1u);
}

TEST(OutputFile, LeavesNothingWithoutACommit) {
    const TemporaryFolder folder;
    {
        OutputFile file(folder / "a.json");
        file.write(0, "half", 4);
    }
    EXPECT_EQ(folder.fileCount(), 0u);
}

TEST(OutputFile, WritesAtOffsetsInAnyOrder) {
    const TemporaryFolder folder;
    OutputFile file(folder / "a.txt");
    file.write(3, "def", 3);
    file.write(0, "abc", 3);
    file.commit();
    EXPECT_EQ(textOf(folder / "a.txt"), "abcdef");
}

TEST(OutputFile, FollowsASymbolicLink) {
    const TemporaryFolder folder;
    writeText(folder / "target.json", "before");
    std::filesystem::create_symlink(folder / "target.json", folder / "link.json");
    writeText(folder / "link.json", "after");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.json"));
    EXPECT_EQ(textOf(folder / "target.json"), "after");
}

TEST(OutputFile, RefusesByReason) {
    const TemporaryFolder folder;
    const auto refusal = [](const std::filesystem::path& path) {
        return lineOfError(ErrorKind::outputNotWritable, [&] { OutputFile file(path); });
    };
    writeText(folder / "file", "");
    EXPECT_EQ(refusal(folder / "no/a.json"),
              "cannot write " + (folder / "no/a.json").string() + ": there is no such folder");
    EXPECT_NE(refusal(folder / "no/").find("no file name given"), std::string::npos);
    EXPECT_NE(refusal((folder / "file").parent_path()).find("it is a folder"), std::string::npos);
    EXPECT_NE(refusal(folder / "file/a.json").find("Not a directory"), std::string::npos);
    EXPECT_NE(refusal(folder / std::string(300, 'a')).find("File name too long"), std::string::npos);
    EXPECT_NE(refusal("").find("no file name given"), std::string::npos);
}

// A rename would put a plain file in the place of the device.
TEST(OutputFile, WritesToDevices) {
    writeText("/dev/null", "text");
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
    EXPECT_EQ(lineOfError(ErrorKind::outputNotWritable, [] { writeText("/dev/full", "text"); }),
              "cannot write /dev/full: No space left on device");
}

TEST(OutputFile, WritesToPipesAtTheCommit) {
    const TemporaryFolder folder;
    const std::filesystem::path pipe = folder / "pipe.json";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    { const OutputFile probe(pipe); } // opens nothing: that would wait for a reader
    std::future<std::string> read = std::async(std::launch::async, [&] { return textOf(pipe); });
    writeText(pipe, "text");
    EXPECT_EQ(read.get(), "text");
    EXPECT_TRUE(std::filesystem::is_fifo(pipe));
    EXPECT_EQ(folder.fileCount(), 1u);
}

// What is in the file before and after is somebody else's.
TEST(OutputFile, AppendsToDescriptors) {
    const TemporaryFolder folder;
    const int log = open((folder / "log").c_str(), O_WRONLY | O_CREAT, 0600);
    ASSERT_EQ(write(log, "before ", 7), 7);
    writeText("/dev/fd/" + std::to_string(log), "text");
    std::filesystem::create_symlink("/proc/self/fd/" + std::to_string(log), folder / "link");
    writeText(folder / "link", " again");
    ASSERT_EQ(write(log, " after", 6), 6);
    close(log);
    EXPECT_EQ(textOf(folder / "log"), "before text again after");
    EXPECT_EQ(lineOfError(ErrorKind::outputNotWritable, [] { OutputFile file("/dev/fd/999"); }),
              "cannot write /dev/fd/999: this stream is closed, or not for writing");
}

TEST(OutputFile, MakesTheTargetOfALinkThatDangles) {
    const TemporaryFolder folder;
    std::filesystem::create_symlink("second", folder / "first");
    std::filesystem::create_symlink("target", folder / "second");
    writeText(folder / "first", "text");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "first"));
    EXPECT_EQ(textOf(folder / "target"), "text");
    std::filesystem::create_symlink("loop", folder / "loop");
    EXPECT_NE(lineOfError(ErrorKind::outputNotWritable, [&] { OutputFile file(folder / "loop"); })
                  .find("Too many levels of symbolic links"),
              std::string::npos);
}

TEST(OutputFile, KeepsTheModeOfWhatItReplaces) {
    const TemporaryFolder folder;
    const auto modeOf = [](const std::filesystem::path& path) {
        return static_cast<unsigned>(std::filesystem::status(path).permissions());
    };
    writeText(folder / "a", "before");
    chmod((folder / "a").c_str(), 0604);
    writeText(folder / "a", "after");
    EXPECT_EQ(modeOf(folder / "a"), 0604u);
    const mode_t before = umask(027);
    writeText(folder / "b", "new");
    umask(before);
    EXPECT_EQ(modeOf(folder / "b"), 0640u);
}

TEST(OutputFile, KnowsWhatIsTheSame) {
    const TemporaryFolder folder;
    std::filesystem::create_symlink("a", folder / "link");
    EXPECT_TRUE(isSameOutput(folder / "a", folder / "./a"));
    EXPECT_TRUE(isSameOutput(folder / "a", folder / "link"));
    EXPECT_FALSE(isSameOutput(folder / "a", folder / "b"));
    EXPECT_TRUE(isSameOutput("-", "/dev/stdout"));
    EXPECT_FALSE(isSameOutput("/dev/stderr", "/dev/stdout"));
    EXPECT_TRUE(isStandardOutput("/dev/fd/1"));
}

// Processes of containers that share a folder have the same process id.
TEST(TemporaryFile, HasANameOfItsOwnAndIsRemovedBySignals) {
    const TemporaryFolder folder;
    std::vector<std::unique_ptr<OutputFile>> files;
    files.reserve(5);
    for (int i = 0; i < 5; ++i) {
        files.push_back(std::make_unique<OutputFile>(folder / "a"));
    }
    EXPECT_EQ(folder.fileCount(), 5u);
    removeTemporaryFiles();
    EXPECT_EQ(folder.fileCount(), 0u);
}

TEST(OutputFile, AFullDiskKeepsTheFormerFile) {
    const TemporaryFolder folder;
    writeText(folder / "a.json", "before");
    {
        const FileSizeLimit limit(1000);
        const std::string line = lineOfError(ErrorKind::outputNotWritable,
                                             [&] { writeText(folder / "a.json", std::string(2000, 'x')); });
        EXPECT_NE(line.find("File too large"), std::string::npos) << line;
    }
    EXPECT_EQ(textOf(folder / "a.json"), "before");
    EXPECT_EQ(folder.fileCount(), 1u);
}

} // namespace
} // namespace metamarch
