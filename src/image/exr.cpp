#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "image/exr_header.h"
#include "image/file_checks.h"
#include "lychnite/base/atomic_file.h"
#include "lychnite/base/error.h"
#include "lychnite/image/io.h"

namespace lychnite {
namespace fs = std::filesystem;

namespace {

// Attributes with a meaning of their own in the format, beside those every new header already holds.
constexpr std::array kReserved = {"chunkCount", "name", "preview", "tiles", "type", "version", "view"};

bool isReserved(const std::string& key) {
  if (std::find(kReserved.begin(), kReserved.end(), key) != kReserved.end()) return true;
  const Imf::Header plain;
  return plain.find(key) != plain.end();
}

/// OpenEXR's own file stream loses errors that surface in its destructors (a full disk shows only when the
/// last bytes are flushed); this one remembers the first and close() reports it.
class OutStream : public Imf::OStream {
 public:
  OutStream(const fs::path& path, std::string shownAs)
      : Imf::OStream(shownAs.c_str()), shownAs_(std::move(shownAs)), file_(std::fopen(path.c_str(), "wb")) {
    if (!file_) fail();
  }
  ~OutStream() override {
    if (file_) std::fclose(file_);
  }
  OutStream(const OutStream&) = delete;
  OutStream& operator=(const OutStream&) = delete;

  void write(const char bytes[], int count) override {
    if (std::fwrite(bytes, 1, size_t(count), file_) != size_t(count)) fail();
  }
  uint64_t tellp() override { return uint64_t(std::ftell(file_)); }
  void seekp(uint64_t position) override {
    if (std::fseek(file_, long(position), SEEK_SET) != 0) fail();
  }
  void close() {
    if (std::fclose(std::exchange(file_, nullptr)) != 0) fail();
    if (!failure_.empty()) throwFailure();
  }

 private:
  [[noreturn]] void fail() {
    if (failure_.empty()) failure_ = std::generic_category().message(errno);
    throwFailure();
  }
  [[noreturn]] void throwFailure() const {
    throw Error({.where = shownAs_,
                 .expected = "",
                 .found = "cannot write: " + failure_,
                 .todo = "check the folder's permissions and the free space"});
  }

  std::string shownAs_, failure_;
  std::FILE* file_;
};

void encode(const Image& image, Imf::OStream& stream) {
  Imf::Header header(image.width(), image.height());
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [key, value] : image.metadata) header.insert(key, Imf::StringAttribute(value));
  Imf::FrameBuffer pixels;
  for (const auto& [name, values] : image.channels()) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    // The library takes one kind of slice for reading and writing, hence not const; it only reads here.
    char* base = reinterpret_cast<char*>(const_cast<float*>(values.data()));
    pixels.insert(name, Imf::Slice(Imf::FLOAT, base, sizeof(float), sizeof(float) * size_t(image.width())));
  }
  Imf::OutputFile file(stream, header);
  file.setFrameBuffer(pixels);
  file.writePixels(image.height());
}

/// How many channels there are; throws Error unless all have full resolution.
int64_t countChannels(const Imf::ChannelList& channels, const fs::path& path) {
  int64_t count = 0;
  for (auto channel = channels.begin(); channel != channels.end(); ++channel, ++count)
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
      throw Error({.where = path.string(),
                   .expected = "channels of full resolution",
                   .found = fmt::format("the subsampled channel '{}'", channel.name()),
                   .todo = "convert it to RGB first"});
  return count;
}

void readMetadata(const Imf::Header& header, Image& image) {
  for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
    if (text && !isReserved(attribute.name())) image.metadata[attribute.name()] = text->value();
  }
}

Image decode(const fs::path& path) {
  Imf::InputFile file(path.c_str());
  const Imf::Header& header = file.header();
  const auto window = header.dataWindow();
  const int64_t width = int64_t(window.max.x) - window.min.x + 1;
  const int64_t height = int64_t(window.max.y) - window.min.y + 1;
  checkImageClaim(path, width, height, countChannels(header.channels(), path));

  Image image(static_cast<int>(width), static_cast<int>(height));
  Imf::FrameBuffer pixels;
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    float* base = image.addChannel(channel.name()).data();
    pixels.insert(channel.name(), Imf::Slice::Make(Imf::FLOAT, base, window.min, width, height));
  }
  file.setFrameBuffer(pixels);
  file.readPixels(window.min.y, window.max.y);
  readMetadata(header, image);
  return image;
}

}  // namespace

void writeExr(const Image& image, const fs::path& path) {
  checkWritable(image, path);
  for (const auto& [key, value] : image.metadata)
    if (isReserved(key))
      throw Error({.where = path.string(),
                   .expected = "metadata names that EXR does not use itself",
                   .found = fmt::format("'{}'", key),
                   .todo = ""});
  writeAtomically(path, [&](const fs::path& temporary) {
    OutStream stream(temporary, path.string());
    try {
      encode(image, stream);
    } catch (const Error&) {
      throw;
    } catch (const std::exception& error) {
      throw Error({.where = path.string(),
                   .expected = "",
                   .found = "cannot write: " + oneLine(error.what()),
                   .todo = ""});
    }
    stream.close();
  });
}

Image readExr(const fs::path& path) {
  try {
    checkExrHeader(path);
    return decode(path);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw Error({.where = path.string(),
                 .expected = "a whole EXR picture",
                 .found = oneLine(error.what()),
                 .todo = "the file is truncated or damaged; write it again"});
  }
}

}  // namespace lychnite
