// Measured profiles on disk: kept, found again, and never in the way.
#include "lychnite/app/profile_store.h"

#include <gtest/gtest.h>

#include <fstream>

#include "lychnite/base/error.h"
#include "scratch.h"

namespace lychnite {
namespace {

namespace fs = std::filesystem;

/// Dark, so that it is measured in a moment.
Coefficients darkMedium() {
  return {.sigma_s = {0.2, 0.1, 0.05}, .sigma_a = {0.5, 0.6, 0.7}, .g = 0, .eta = 1.3};
}

ProfileRequest requestOf(const Coefficients& medium) {
  return {ProfileKind::kTabulated, medium, ProfileOrders::kAll};
}

/// The one file in a folder.
fs::path onlyFile(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  EXPECT_EQ(files.size(), 1u);
  return files.empty() ? fs::path() : files.front();
}

/// A store whose log and progress are watched.
struct Watched {
  int warnings = 0, measured = 0;
  ProfileStore store;
  explicit Watched(const fs::path& folder)
      : store(folder, [this](LogLevel level, std::string_view) { warnings += level == LogLevel::kWarning; }) {
  }
  std::unique_ptr<Profile> make(const ProfileRequest& request) {
    return store.make(request, Progress([this](const Progress::Update& u) {
                        measured += u.fraction == 0;
                        return true;
                      }));
  }
};

class ProfileStoreTest : public ::testing::Test {
 protected:
  ScratchFolder scratch_;
  fs::path folder_ = scratch_ / "made" / "here";
};

TEST_F(ProfileStoreTest, MeasuresOnceForEverySizeAndFindsItAgain) {
  Watched first(folder_);
  const double P = first.make(requestOf(darkMedium()))->P(0.1).x;
  EXPECT_NEAR(first.make(requestOf(darkMedium().scaled(1 / 0.3)))->P(0.1 / 0.3).x, P, 1e-7);
  EXPECT_EQ(first.measured, 1);
  Watched second(folder_);
  EXPECT_DOUBLE_EQ(second.make(requestOf(darkMedium()))->P(0.1).x, P);
  EXPECT_EQ(second.measured, 0);
  EXPECT_EQ(first.warnings + second.warnings, 0);
}

TEST_F(ProfileStoreTest, MaterialsHaveFilesOfTheirOwn) {
  Watched watched(folder_);
  Coefficients other = darkMedium();
  other.eta = 1.4;
  watched.make(requestOf(darkMedium()));
  watched.make(requestOf(other));
  EXPECT_EQ(watched.measured, 2);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 2);
}

TEST_F(ProfileStoreTest, DamageIsMeasuredAnewWithAWarning) {
  const double P = Watched(folder_).make(requestOf(darkMedium()))->P(0).x;
  const fs::path file = onlyFile(folder_);
  const std::string good = textOf(file);
  std::string changed = good;
  changed[good.find("0.0", good.size() / 2) + 2] = '7';
  for (const std::string& damaged :
       {std::string(), good.substr(0, good.size() / 2), changed, std::string("[1]")}) {
    std::ofstream(file, std::ios::binary) << damaged;
    Watched watched(folder_);
    EXPECT_DOUBLE_EQ(watched.make(requestOf(darkMedium()))->P(0).x, P);
    EXPECT_EQ(watched.warnings, 1);
    EXPECT_EQ(watched.measured, 1);
    EXPECT_EQ(textOf(file), good);
  }
}

TEST_F(ProfileStoreTest, AFolderThatCannotBeIsNoError) {
  std::ofstream(scratch_ / "file") << "in the way";
  for (const fs::path& folder : {scratch_ / "file" / "below", fs::path()}) {
    Watched watched(folder);
    EXPECT_GT(watched.make(requestOf(darkMedium()))->P(0).x, 0.01);
    watched.make(requestOf(darkMedium()));
    EXPECT_EQ(watched.measured, 1);
    EXPECT_EQ(watched.warnings, 0);
  }
}

TEST_F(ProfileStoreTest, AnInterruptionLeavesNothing) {
  ProfileStore store(folder_);
  EXPECT_THROW(store.make(requestOf(darkMedium()), Progress([](const Progress::Update&) { return false; })),
               Interrupted);
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(ProfileStoreTest, FormulasPassThrough) {
  Watched watched(folder_);
  const ProfileRequest request{ProfileKind::kBetterDipole, darkMedium(), ProfileOrders::kAll};
  EXPECT_EQ(watched.make(request)->P(0).x, makeBetterDipole(darkMedium())->P(0).x);
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(ProfileStoreTest, NothingIsMeasuredWhereNothingScatters) {
  Coefficients clear = darkMedium();
  clear.sigma_s = Rgb(0);
  Watched watched(folder_);
  EXPECT_EQ(watched.make(requestOf(clear))->P(0).x, 0);
  EXPECT_EQ(watched.measured, 0);
}

}  // namespace
}  // namespace lychnite
