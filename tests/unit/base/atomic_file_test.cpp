#include "lychnite/base/atomic_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "lychnite/base/error.h"
#include "scratch.h"

namespace lychnite {
namespace {

TEST(WriteAtomically, AppearsWhole) {
  const ScratchFolder folder;
  writeTextAtomically(folder / "a.txt", "first");
  EXPECT_EQ(textOf(folder / "a.txt"), "first");
  writeTextAtomically(folder / "a.txt", "second, longer");
  EXPECT_EQ(textOf(folder / "a.txt"), "second, longer");
  EXPECT_EQ(folder.entries(), 1u);
}

TEST(WriteAtomically, TemporaryLiesBesideAndKeepsTheExtension) {
  const ScratchFolder folder;
  std::filesystem::path seen;
  writeAtomically(folder / "a.exr", [&](const std::filesystem::path& temporary) {
    seen = temporary;
    EXPECT_FALSE(std::filesystem::exists(folder / "a.exr"));
    std::ofstream(temporary) << "x";
  });
  EXPECT_EQ(seen.parent_path(), folder.path());
  EXPECT_EQ(seen.extension(), ".exr");
  EXPECT_FALSE(std::filesystem::exists(seen));
}

TEST(WriteAtomically, AFailingWriterLeavesTheOldFile) {
  const ScratchFolder folder;
  writeTextAtomically(folder / "a.txt", "old");
  EXPECT_THROW(writeAtomically(folder / "a.txt",
                               [](const std::filesystem::path& temporary) {
                                 std::ofstream(temporary) << "half";
                                 throw std::runtime_error("writer");
                               }),
               std::runtime_error);
  EXPECT_EQ(textOf(folder / "a.txt"), "old");
  EXPECT_EQ(folder.entries(), 1u) << "the temporary file is gone";
}

TEST(WriteAtomically, ErrorsNameTheFileNotTheTemporary) {
  const ScratchFolder folder;
  try {
    writeAtomically(folder / "a.txt", [](const std::filesystem::path& temporary) {
      throw Error({.where = temporary.string(), .expected = "", .found = "broken", .todo = ""},
                  Error::Kind::kDevice);
    });
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.parts().where, (folder / "a.txt").string());
    EXPECT_EQ(error.kind(), Error::Kind::kDevice);
  }
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(WriteAtomically, AWriterThatWritesNothingIsAnError) {
  const ScratchFolder folder;
  EXPECT_THROW(writeAtomically(folder / "a.txt", [](const std::filesystem::path&) {}), Error);
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(WriteAtomically, RefusesFoldersAndMissingFolders) {
  const ScratchFolder folder;
  const auto never = [](const std::filesystem::path&) { FAIL() << "the writer must not be asked"; };
  EXPECT_THROW(writeAtomically(folder.path(), never), Error);
  try {
    writeAtomically(folder / "missing/a.txt", never);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("missing"), std::string::npos);
    EXPECT_FALSE(error.parts().todo.empty());
  }
}

/// In a process of its own whose files cannot grow beyond `limit` bytes, as on a full disk: 0 for Error and
/// nothing left over.
int writeWithLimit(const std::filesystem::path& path, rlim_t limit, size_t bytes) {
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit size{limit, limit};
    if (setrlimit(RLIMIT_FSIZE, &size) != 0) _exit(9);
    try {
      writeTextAtomically(path, std::string(bytes, 'x'));
    } catch (const Error& error) {
      _exit(error.parts().where == path.string() ? 0 : 2);
    } catch (...) {
      _exit(3);
    }
    _exit(1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 8;
}

TEST(WriteAtomically, AFullDiskIsAnErrorAndLeavesTheOldFile) {
  const ScratchFolder folder;
  writeTextAtomically(folder / "a.txt", "old");
  // One that fails while writing and one that the stream's buffer holds until it is closed.
  EXPECT_EQ(writeWithLimit(folder / "a.txt", 4096, 1 << 20), 0);
  EXPECT_EQ(writeWithLimit(folder / "a.txt", 10, 100), 0);
  EXPECT_EQ(textOf(folder / "a.txt"), "old");
  EXPECT_EQ(folder.entries(), 1u);
  EXPECT_EQ(writeWithLimit(folder / "b.txt", 4096, 100), 1) << "and what fits is written";
}

}  // namespace
}  // namespace lychnite
