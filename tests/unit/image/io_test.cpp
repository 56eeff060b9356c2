#include "lychnite/image/io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>

#include "lychnite/base/error.h"
#include "scratch.h"

namespace lychnite {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Image gradient(int width, int height) {
  Image image(width, height);
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    const float t = float(i) / float(image.pixelCount());
    image.setRgb(i, {t, 2 * t, 0.25f * t});
    image.setRgb(i, {-t, 1e-12f * t, 1e9f * t}, "single");
  }
  image.addChannel("A").assign(image.pixelCount(), 0.5f);
  image.addChannel("depth.Z").assign(image.pixelCount(), std::numeric_limits<float>::infinity());
  return image;
}

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(ExrFile, KeepsEveryChannelAndTheMetadata) {
  const ScratchFolder scratch;
  Image image = gradient(37, 19);
  image.metadata = {{"method", "walk"},
                    {"a much longer name than thirty-one characters", "x"},
                    {"note", "two\nlines, \xc3\xa9"},
                    {"comments", ""}};
  writeExr(image, scratch / "a.exr");
  const Image back = readImage(scratch / "a.exr");
  EXPECT_EQ(back.width(), 37);
  EXPECT_EQ(back.height(), 19);
  EXPECT_EQ(back.channels(), image.channels());
  EXPECT_EQ(back.metadata, image.metadata);
}

/// Bytes of a little-endian file, built by hand.
struct Bytes {
  std::string all;

  template <class T>
  Bytes& add(T value) {
    all.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  Bytes& text(const char* zeroEnded) {
    all.append(zeroEnded, std::strlen(zeroEnded) + 1);
    return *this;
  }
  Bytes& attribute(const char* name, const char* type, const Bytes& value) {
    text(name).text(type).add(int32_t(value.all.size()));
    all += value.all;
    return *this;
  }
};

/// An uncompressed EXR after the format's description: a 2 x 3 window at (-5, 10) inside a 64 x 64 display,
/// channel "H" of half floats {0.5, 1, 2, 3, 4, -5.5}, "id" of integers {0, 1, 2, 3, 4, 70000}.
std::string shiftedHalfExr() {
  constexpr int32_t kUint = 0, kHalf = 1, kTop = 10, kRows = 3, kRowBytes = 2 * 2 + 2 * 4;
  const uint16_t halves[] = {0x3800, 0x3c00, 0x4000, 0x4200, 0x4400, 0xc580};
  const uint32_t ids[] = {0, 1, 2, 3, 4, 70000};
  Bytes channels, file;
  channels.text("H").add(kHalf).add(0).add(1).add(1);
  channels.text("id").add(kUint).add(0).add(1).add(1).add(char(0));
  file.add(20000630).add(2).attribute("channels", "chlist", channels);
  file.attribute("compression", "compression", Bytes().add(char(0)));
  file.attribute("dataWindow", "box2i", Bytes().add(-5).add(kTop).add(-4).add(kTop + kRows - 1));
  file.attribute("displayWindow", "box2i", Bytes().add(0).add(0).add(63).add(63));
  file.attribute("lineOrder", "lineOrder", Bytes().add(char(0)));
  file.attribute("pixelAspectRatio", "float", Bytes().add(1.f));
  file.attribute("screenWindowCenter", "v2f", Bytes().add(0.f).add(0.f));
  file.attribute("screenWindowWidth", "float", Bytes().add(1.f)).add(char(0));
  const size_t firstRow = file.all.size() + kRows * sizeof(uint64_t);
  for (int row = 0; row < kRows; ++row) file.add(uint64_t(firstRow + size_t(row) * (8 + kRowBytes)));
  for (int row = 0; row < kRows; ++row) {
    file.add(kTop + row).add(kRowBytes);
    file.add(halves[2 * row]).add(halves[2 * row + 1]).add(ids[2 * row]).add(ids[2 * row + 1]);
  }
  return file.all;
}

TEST(ExrFile, ReadsHalfAndIntegerChannelsOfAShiftedWindow) {
  const ScratchFolder scratch;
  std::ofstream(scratch / "h.exr", std::ios::binary) << shiftedHalfExr();
  const Image image = readImage(scratch / "h.exr");
  EXPECT_EQ(image.width(), 2);
  EXPECT_EQ(image.height(), 3);
  EXPECT_EQ(image.channel("H"), (std::vector<float>{0.5f, 1, 2, 3, 4, -5.5f}));
  EXPECT_EQ(image.channel("id"), (std::vector<float>{0, 1, 2, 3, 4, 70000}));
}

TEST(ExrFile, RefusesMetadataThatWouldNotComeBack) {
  const ScratchFolder scratch;
  for (const char* key : {"", " x", "x  y", "t\xc3\xa9", "channels", "type", "dataWindow"}) {
    Image image = gradient(2, 2);
    image.metadata[key] = "v";
    EXPECT_THROW(writeExr(image, scratch / "a.exr"), Error) << key;
  }
  EXPECT_THROW(writeExr(Image(), scratch / "a.exr"), Error);
  EXPECT_TRUE(scratch.entries() == 0);
}

TEST(PngFile, EightAndSixteenBitsComeBackWithinHalfAStep) {
  const ScratchFolder scratch;
  const Image image = gradient(31, 9);
  for (const int bits : {8, 16}) {
    writePng(image, scratch / "a.png", {.toneMapping = {}, .bits = bits, .alpha = true});
    const Image back = readImage(scratch / "a.png");
    const float halfStep = 0.5f / (bits == 8 ? 255.f : 65535.f);
    for (size_t i = 0; i < image.pixelCount(); ++i)
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(srgbFromLinear(back.rgb(i)[c]), srgbFromLinear(std::min(image.rgb(i)[c], 1.f)),
                    1.01f * halfStep)
            << bits << " bits, pixel " << i;
    EXPECT_NEAR(back.channel("A")[0], 0.5f, 1.01f * halfStep);
  }
}

TEST(PngFile, ReadAndWrittenAgainIsTheSameFile) {
  const ScratchFolder scratch;
  Image image(256, 1);
  for (size_t i = 0; i < 256; ++i) image.setRgb(i, glm::vec3(linearFromSrgb(float(i) / 255)));
  image.metadata = {{"method", "dipole"}, {"size", "30 mm"}, {"author", "Jos\xc3\xa9"}};
  writePng(image, scratch / "a.png");
  writePng(readImage(scratch / "a.png"), scratch / "b.png");
  EXPECT_EQ(textOf(scratch / "a.png"), textOf(scratch / "b.png"));
  const Image back = readImage(scratch / "a.png");
  EXPECT_EQ(back.metadata, image.metadata);
  EXPECT_FALSE(back.has("A"));
  EXPECT_THAT(textOf(scratch / "a.png"), AllOf(HasSubstr("tEXtmethod"), HasSubstr("iTXtauthor")));
}

/// A picture as other programs write it, by libpng's own simplified interface.
void writeForeignPng(const std::filesystem::path& path, png_uint_32 format, const void* pixels,
                     const void* colours, unsigned entries) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = 2;
  image.height = 1;
  image.format = format;
  image.colormap_entries = entries;
  ASSERT_TRUE(png_image_write_to_file(&image, path.c_str(), 0, pixels, 0, colours)) << image.message;
}

TEST(PngFile, ReadsGreyAndPalette) {
  const ScratchFolder scratch;
  const png_byte grey[] = {0, 255}, greyAlpha[] = {255, 51, 0, 255}, indices[] = {1, 0};
  const png_byte palette[] = {255, 0, 0, 0, 255, 0};
  writeForeignPng(scratch / "g.png", PNG_FORMAT_GRAY, grey, nullptr, 0);
  writeForeignPng(scratch / "ga.png", PNG_FORMAT_GA, greyAlpha, nullptr, 0);
  writeForeignPng(scratch / "p.png", PNG_FORMAT_RGB_COLORMAP, indices, palette, 2);
  EXPECT_EQ(readImage(scratch / "g.png").rgb(1), glm::vec3(1));
  const Image withAlpha = readImage(scratch / "ga.png");
  EXPECT_EQ(withAlpha.rgb(0), glm::vec3(1));
  EXPECT_FLOAT_EQ(withAlpha.channel("A")[0], 0.2f);
  EXPECT_EQ(readImage(scratch / "p.png").rgb(0), glm::vec3(0, 1, 0));
  EXPECT_EQ(readImage(scratch / "p.png").rgb(1), glm::vec3(1, 0, 0));
}

TEST(PngFile, TakesBytesAfterItsEnd) {
  const ScratchFolder scratch;
  writePng(gradient(3, 2), scratch / "a.png");
  std::ofstream(scratch / "a.png", std::ios::binary | std::ios::app) << "\xff\xff\xff\xffjunk";
  EXPECT_EQ(readImage(scratch / "a.png").width(), 3);
}

TEST(PngFile, RefusesAChunkLongerThanTheFile) {
  const ScratchFolder scratch;
  writePng(gradient(3, 2), scratch / "a.png");
  std::string bytes = textOf(scratch / "a.png");
  bytes[bytes.find("sRGB") - 4] = 0x40;
  std::ofstream(scratch / "b.png", std::ios::binary) << bytes;
  EXPECT_THAT(messageOf([&] { readImage(scratch / "b.png"); }), HasSubstr("past the end of the file"));
}

TEST(PngFile, RefusesWhatItCannotWrite) {
  const ScratchFolder scratch;
  const Image image = gradient(2, 2);
  EXPECT_THROW(writePng(image, scratch / "a.png", {.toneMapping = {}, .bits = 12}), Error);
  Image depthOnly(2, 2);
  depthOnly.addChannel("depth.Z");
  EXPECT_THAT(messageOf([&] { writePng(depthOnly, scratch / "a.png"); }), HasSubstr("'R'"));
  EXPECT_TRUE(scratch.entries() == 0);
}

/// Runs `action` while no file may grow beyond `bytes`: what a full disk looks like to a program.
void withFileSizeLimit(rlim_t bytes, const std::function<void()>& action) {
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{bytes, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  action();
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
}

TEST(Files, FullDiskIsAnErrorThatLeavesNothing) {
  const ScratchFolder scratch;
  Image noise(64, 64);
  unsigned state = 1;
  for (size_t i = 0; i < noise.pixelCount(); ++i)
    noise.setRgb(i, glm::vec3(float((state = state * 1664525u + 1013904223u) >> 8) / float(1 << 24)));
  // From the first byte to the very last, which only a flush at the end writes.
  writeExr(noise, scratch / "whole.exr");
  const auto whole = std::filesystem::file_size(scratch / "whole.exr");
  std::filesystem::remove(scratch / "whole.exr");
  for (const rlim_t limit : {rlim_t(1), rlim_t(3000), rlim_t(whole - 1)}) {
    std::string exr;
    withFileSizeLimit(limit, [&] { exr = messageOf([&] { writeExr(noise, scratch / "a.exr"); }); });
    EXPECT_THAT(exr, AllOf(HasSubstr("a.exr"), HasSubstr("cannot write"), HasSubstr("space"))) << limit;
    EXPECT_TRUE(scratch.entries() == 0) << limit;
  }
  std::string png;
  withFileSizeLimit(1000, [&] { png = messageOf([&] { writePng(noise, scratch / "a.png"); }); });
  EXPECT_THAT(png, AllOf(HasSubstr("a.png"), HasSubstr("cannot write")));
  EXPECT_TRUE(scratch.entries() == 0);
}

TEST(Files, UnwritableAndUnreadablePlacesAreNamed) {
  const ScratchFolder scratch;
  const Image image = gradient(2, 2);
  EXPECT_THAT(messageOf([&] { writeExr(image, scratch / "none/a.exr"); }), HasSubstr("none"));
  EXPECT_THAT(messageOf([&] { writePng(image, scratch / "none/a.png"); }), HasSubstr("none"));
  EXPECT_THAT(messageOf([&] { readImage(scratch / "none.exr"); }), HasSubstr("no such file"));
  EXPECT_THAT(messageOf([&] { readImage(scratch.path()); }), HasSubstr("a folder"));
  std::ofstream(scratch / "empty.png").close();
  EXPECT_THAT(messageOf([&] { readImage(scratch / "empty.png"); }), HasSubstr("an empty file"));
  std::ofstream(scratch / "text.exr") << "not a picture";
  EXPECT_THAT(messageOf([&] { readImage(scratch / "text.exr"); }), HasSubstr("starts like neither"));
  EXPECT_THAT(messageOf([&] { readImage("/dev/null"); }), HasSubstr("not a plain file"));
}

TEST(Files, ContentDecidesNotTheName) {
  const ScratchFolder scratch;
  writePng(gradient(3, 2), scratch / "a.exr");
  EXPECT_EQ(readImage(scratch / "a.exr").width(), 3);
}

void replaceBytes(const std::filesystem::path& path, size_t at, const std::string& bytes) {
  std::string all = textOf(path);
  ASSERT_LE(at + bytes.size(), all.size());
  all.replace(at, bytes.size(), bytes);
  std::ofstream(path, std::ios::binary) << all;
}

TEST(Files, GiantClaimsAreRefusedBeforeAllocating) {
  const ScratchFolder scratch;
  writeExr(gradient(4, 4), scratch / "a.exr");
  // The data window's xMin, yMin, xMax, yMax follow the name, the type and the length.
  const size_t window = textOf(scratch / "a.exr").find("dataWindow");
  const size_t corner = window + std::string("dataWindow.box2i.size").size();
  replaceBytes(scratch / "a.exr", corner + 8, std::string("\xff\xff\xff\x3f", 4));
  EXPECT_THAT(messageOf([&] { readImage(scratch / "a.exr"); }), HasSubstr("1073741824 x 4"));
  replaceBytes(scratch / "a.exr", corner + 8, std::string("\xff\x3f\x00\x00\xff\x3f\x00\x00", 8));
  EXPECT_THAT(messageOf([&] { readImage(scratch / "a.exr"); }), HasSubstr("16384 x 16384 pixels"));
}

TEST(Files, TruncationIsAnError) {
  const ScratchFolder scratch;
  writeExr(gradient(40, 40), scratch / "a.exr");
  writePng(gradient(40, 40), scratch / "a.png");
  for (const char* name : {"a.exr", "a.png"}) {
    const auto path = scratch / name;
    std::filesystem::resize_file(path, std::filesystem::file_size(path) * 3 / 4);
    EXPECT_THAT(messageOf([&] { readImage(path); }), AllOf(HasSubstr(name), HasSubstr("truncated"))) << name;
  }
}

}  // namespace
}  // namespace lychnite
