// Fd, Mapping and write_file: what they refuse, and what is left on the disk when something fails.
#include "base/fd.h"
#include "base/mapping.h"
#include "base/write_file.h"
#include "temporary_folder.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace scanout::test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string contents(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

bool is_open(int fd) {
    return ::fcntl(fd, F_GETFD) >= 0;
}

TEST(Fd, ClosesOnceAndOnlyItsLastOwner) {
    int number = -1;
    {
        Result<Fd> opened = Fd::open("/dev/null", O_RDONLY);
        ASSERT_TRUE(opened);
        number = opened->get();
        EXPECT_TRUE(::fcntl(number, F_GETFD) & FD_CLOEXEC);
        Fd& first = *opened;
        Fd second = std::move(first);
        EXPECT_FALSE(first.valid()); // NOLINT(bugprone-use-after-move): defined, and the point
        Fd third;
        third = std::move(second);
        EXPECT_EQ(third.get(), number);
        EXPECT_TRUE(is_open(number));
    }
    EXPECT_FALSE(is_open(number));
}

TEST(Fd, SaysWhichFileCannotBeOpenedAndWhy) {
    const Result<Fd> fd = Fd::open("/nowhere/at/all", O_RDONLY);
    ASSERT_FALSE(fd);
    EXPECT_EQ(fd.error().what, "/nowhere/at/all: No such file or directory");
    EXPECT_EQ(fd.error().exit, Exit::unreadable);
}

TEST(Mapping, ShowsTheBytesOfAFile) {
    const TemporaryFolder folder;
    std::string text("v 1 2 3\n\0\xff", 10);
    text.append(100000, 'x');
    ASSERT_TRUE(write_file(folder / "a", text));
    Result<Mapping> mapping = Mapping::open(folder / "a");
    ASSERT_TRUE(mapping);
    EXPECT_EQ(mapping->text(), text);
    mapping->drop_before(50000);
    EXPECT_EQ(mapping->text().substr(50000), text.substr(50000));
    const Mapping moved = *std::move(mapping);
    EXPECT_EQ(moved.text().substr(50000), text.substr(50000));
    EXPECT_EQ(mapping->size(), 0U); // NOLINT(bugprone-use-after-move): defined, and the point
}

TEST(Mapping, OfAnEmptyFileIsEmpty) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_file(folder / "empty", std::string_view()));
    const Result<Mapping> mapping = Mapping::open(folder / "empty");
    ASSERT_TRUE(mapping);
    EXPECT_TRUE(mapping->text().empty());
}

TEST(Mapping, RefusesWhatIsNotARegularFileAtOnce) {
    const TemporaryFolder folder;
    const std::string pipe = folder / "pipe"; // without a writer: open must not wait for one
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    for (const std::string& path : {pipe, std::string("/dev/zero"), std::string("/dev/null")}) {
        const Result<Mapping> mapping = Mapping::open(path);
        ASSERT_FALSE(mapping) << path;
        EXPECT_THAT(mapping.error().what, StartsWith(path + ": is not a regular file"));
        EXPECT_EQ(mapping.error().exit, Exit::unreadable);
    }
    const Result<Mapping> directory = Mapping::open(folder.path());
    ASSERT_FALSE(directory);
    EXPECT_EQ(directory.error().what, folder.path() + ": is a folder, not a file");
    const Result<Mapping> missing = Mapping::open(folder / "missing");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().what, folder / "missing" + ": No such file or directory");
}

TEST(WriteFile, ReplacesAFileWholeWithTheModeOfANewFile) {
    const TemporaryFolder folder;
    const mode_t mask = ::umask(027);
    const bool written = write_file(folder / "a", std::string(300000, 'a')).has_value() &&
                         write_file(folder / "a", std::string_view("short")).has_value();
    ::umask(mask);
    ASSERT_TRUE(written);
    EXPECT_EQ(contents(folder / "a"), "short");
    EXPECT_EQ(folder.files(), 1U);
    struct stat info {};
    ASSERT_EQ(::stat((folder / "a").c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777U, 0640U);
}

TEST(WriteFile, KeepsTheModeOfAFileThatIsThere) {
    const TemporaryFolder folder;
    const std::string path = folder / "a";
    ASSERT_TRUE(write_file(path, std::string_view("first")));
    for (const mode_t mode : {0600U, 0664U}) {
        ASSERT_EQ(::chmod(path.c_str(), mode), 0);
        ASSERT_TRUE(write_file(path, std::string_view("second")));
        struct stat info {};
        ASSERT_EQ(::stat(path.c_str(), &info), 0);
        EXPECT_EQ(info.st_mode & 0777U, mode);
    }
}

TEST(WriteFile, BehindALinkReplacesTheTargetAndKeepsTheLink) {
    const TemporaryFolder folder;
    namespace fs = std::filesystem;
    fs::create_directory(folder / "sub");
    fs::create_symlink("sub/target", folder / "link"); // relative, and dangling at first
    fs::create_symlink(folder / "link", folder / "outer");
    for (const char* text : {"first", "second"}) {
        ASSERT_TRUE(write_file(folder / "outer", std::string_view(text)));
        EXPECT_TRUE(fs::is_symlink(folder / "outer"));
        EXPECT_TRUE(fs::is_symlink(folder / "link"));
        EXPECT_FALSE(fs::is_symlink(folder / "sub/target"));
        EXPECT_EQ(contents(folder / "sub/target"), text);
    }
    fs::create_symlink("circle", folder / "circle");
    const auto circle = write_file(folder / "circle", std::string_view("x"));
    ASSERT_FALSE(circle);
    EXPECT_TRUE(fs::is_symlink(folder / "circle"));
    fs::remove(folder / "circle");
    EXPECT_EQ(folder.files(), 3U) << "no temporary file";
}

TEST(WriteFile, FailsWithOneLineThatNamesThePath) {
    const TemporaryFolder folder;
    const auto nowhere = write_file(folder / "no/such/folder/a.png", std::string_view("x"));
    ASSERT_FALSE(nowhere);
    EXPECT_EQ(nowhere.error().what,
              folder / "no/such/folder/a.png" + ": cannot be written: No such file or directory");
    const auto directory = write_file(folder.path(), std::string_view("x"));
    ASSERT_FALSE(directory);
    EXPECT_THAT(directory.error().what, StartsWith(folder.path() + ": is a folder"));
    const auto full = write_file("/dev/full", std::string_view("x"));
    ASSERT_FALSE(full);
    EXPECT_THAT(full.error().what, HasSubstr("/dev/full: cannot be written: No space left"));
    EXPECT_EQ(folder.files(), 0U);
}

// Sets a limit on the size of files, as a full disk would, for as long as it lives.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit = {bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

private:
    rlimit before_{};
    void (*handler_)(int);
};

TEST(WriteFile, ThatFailsHalfWayLeavesNoFile) {
    const TemporaryFolder folder;
    {
        const FileSizeLimit limit(1000);
        const auto result = write_file(folder / "new", std::string(5000, 'x'));
        ASSERT_FALSE(result);
        EXPECT_THAT(result.error().what, HasSubstr("new: cannot be written: File too large"));
    }
    EXPECT_EQ(folder.files(), 0U);
}

TEST(WriteFile, ThatFailsHalfWayLeavesTheOldFileAsItWas) {
    const TemporaryFolder folder;
    ASSERT_TRUE(write_file(folder / "old", std::string_view("what was there")));
    {
        const FileSizeLimit limit(1000);
        ASSERT_FALSE(write_file(folder / "old", std::string(5000, 'x')));
    }
    EXPECT_EQ(contents(folder / "old"), "what was there");
    EXPECT_EQ(folder.files(), 1U);
}

TEST(WriteFile, OfADashGoesToStandardOutput) {
    const TemporaryFolder folder;
    Result<Fd> target = Fd::open(folder / "out", O_RDWR | O_CREAT, 0600);
    ASSERT_TRUE(target);
    std::fflush(stdout);
    const Fd saved(::dup(STDOUT_FILENO));
    ::dup2(target->get(), STDOUT_FILENO);
    const bool written = write_file("-", std::string_view("bytes")).has_value();
    ::dup2(saved.get(), STDOUT_FILENO);
    EXPECT_TRUE(written);
    EXPECT_EQ(contents(folder / "out"), "bytes");
    EXPECT_FALSE(std::filesystem::exists("-"));
}

} // namespace
} // namespace scanout::test
