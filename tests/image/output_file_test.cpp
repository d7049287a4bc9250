// SPDX-License-Identifier: MIT
#include "file_size_limit.h"
#include "fixtures/expect_error.h"
#include "fixtures/temporary_folder.h"
#include "metamarch/file/output_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

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

// A rename would replace the device with a plain file.
TEST(OutputFile, RefusesDevices) {
    const std::string line = lineOfError(ErrorKind::outputNotWritable, [] { OutputFile file("/dev/null"); });
    EXPECT_EQ(line, "cannot write /dev/null: it is not a regular file");
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
