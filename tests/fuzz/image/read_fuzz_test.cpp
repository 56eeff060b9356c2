#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <fstream>
#include <random>

#include "fuzz/mesh/allocations.h"
#include "lychnite/base/error.h"
#include "lychnite/image/io.h"
#include "scratch.h"

namespace lychnite {
namespace {

// A picture of up to 16 MiB is believed from any file; its channels are allocated one by one.
constexpr size_t kMostBytes = size_t(48) << 20;

// What the whole program may grow to, which also sees what the libraries take by malloc. The address
// sanitizer's quarantine of 256 MiB is part of it.
constexpr long kMostResidentKib = 640 * 1024;

class ReadFuzz : public testing::TestWithParam<const char*> {
 protected:
  ReadFuzz() : path_(scratch_ / GetParam()) {
    Image image(13, 9);
    for (size_t i = 0; i < image.pixelCount(); ++i)
      image.setRgb(i, {float(i) / 117, float(i % 13) / 13, 0.5f});
    image.addChannel("A").assign(image.pixelCount(), 1);
    image.metadata = {{"method", "walk"}, {"size", "30 mm"}};
    if (path_.extension() == ".exr")
      writeExr(image, path_);
    else
      writePng(image, path_, {.toneMapping = {}, .bits = path_.stem() == "16" ? 16 : 8, .alpha = true});
    whole_ = textOf(path_);
  }

  /// Either a picture or one clear line; a crash, another exception or a huge allocation fails.
  bool loads(const std::string& bytes, const std::string& what) {
    // A new file each time: ext4 waits for the disk when an old one is overwritten.
    std::filesystem::remove(path_);
    std::ofstream(path_, std::ios::binary) << bytes;
    resetLargestAllocation();
    bool loaded = false;
    try {
      const Image image = readImage(path_);
      loaded = true;
      EXPECT_FALSE(image.empty()) << what;
      for (const auto& [name, values] : image.channels())
        EXPECT_EQ(values.size(), image.pixelCount()) << what;
    } catch (const Error& error) {
      const std::string line = error.what();
      EXPECT_EQ(line.find('\n'), std::string::npos) << what << ": " << line;
      EXPECT_NE(line.find(path_.filename().string()), std::string::npos) << what << ": " << line;
    }
    EXPECT_LT(largestAllocation(), kMostBytes) << what;
    return loaded;
  }

  void TearDown() override {
    rusage usage{};
    ASSERT_EQ(getrusage(RUSAGE_SELF, &usage), 0);
    EXPECT_LT(usage.ru_maxrss, kMostResidentKib);
  }

  ScratchFolder scratch_;
  std::filesystem::path path_;
  std::string whole_;
};

TEST_P(ReadFuzz, EveryTruncationIsRefused) {
  EXPECT_TRUE(loads(whole_, "whole"));
  for (size_t length = 0; length < whole_.size(); ++length)
    EXPECT_FALSE(loads(whole_.substr(0, length), "cut to " + std::to_string(length)));
}

TEST_P(ReadFuzz, EveryByteFlipLoadsOrIsRefused) {
  for (size_t at = 0; at < whole_.size(); ++at)
    for (const unsigned char flip : {0x01, 0x80, 0xff}) {
      std::string bytes = whole_;
      bytes[at] = char(bytes[at] ^ flip);
      loads(bytes, "byte " + std::to_string(at) + " ^ " + std::to_string(flip));
    }
}

TEST_P(ReadFuzz, RandomDamageLoadsOrIsRefused) {
  std::mt19937 random(11);
  for (int round = 0; round < 1500; ++round) {
    std::string bytes = whole_;
    for (unsigned change = 0; change <= random() % 6; ++change) {
      const size_t at = random() % bytes.size();
      if (random() % 3 == 0)
        bytes.insert(at, random() % 9, char(random()));
      else
        bytes[at] = char(random());
    }
    loads(bytes, "round " + std::to_string(round));
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, ReadFuzz, testing::Values("a.exr", "8.png", "16.png"),
                         [](const auto& test) { return std::string("case") + char('0' + int(test.index)); });

}  // namespace
}  // namespace lychnite
