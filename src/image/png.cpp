#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <fstream>
#include <memory>

#include "image/file_checks.h"
#include "lychnite/base/atomic_file.h"
#include "lychnite/base/error.h"
#include "lychnite/image/io.h"

namespace lychnite {
namespace fs = std::filesystem;

namespace {

// libpng reports errors by longjmp, which must not cross a frame with destructors: every function below that
// calls setjmp works on plain pointers only, and what it fills is owned by its caller.

/// What libpng said, and what it holds; freed by the owner below.
struct Session {
  png_structp png = nullptr;
  png_infop info = nullptr;
  char message[160] = "cannot start libpng";
};

struct Reader : Session {
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

struct Writer : Session {
  ~Writer() { png_destroy_write_struct(&png, &info); }
};

void onError(png_structp png, png_const_charp message) {
  auto* session = static_cast<Session*>(png_get_error_ptr(png));
  std::snprintf(session->message, sizeof session->message, "%s", message);
  std::longjmp(png_jmpbuf(png), 1);
}

void onWarning(png_structp, png_const_charp) {}

struct Pixels {
  int width = 0, height = 0, channels = 0, bits = 8;
  std::vector<png_byte> bytes;
  std::vector<png_bytep> rows;

  void allocate() {
    const size_t rowBytes = size_t(width) * size_t(channels) * size_t(bits / 8);
    bytes.resize(rowBytes * size_t(height));
    rows.resize(size_t(height));
    for (size_t y = 0; y < rows.size(); ++y) rows[y] = bytes.data() + y * rowBytes;
  }
  float get(size_t value) const {
    if (bits == 8) return float(bytes[value]) / 255;
    return float(bytes[2 * value] << 8 | bytes[2 * value + 1]) / 65535;
  }
  void set(size_t value, float unit) {
    const long level = std::lround(std::clamp(unit, 0.f, 1.f) * (bits == 8 ? 255.f : 65535.f));
    if (bits == 8) {
      bytes[value] = png_byte(level);
    } else {
      bytes[2 * value] = png_byte(level >> 8);
      bytes[2 * value + 1] = png_byte(level & 255);
    }
  }
};

bool readHeader(Session& session, std::FILE* file) {
  if (!session.png || !session.info) return false;
  if (setjmp(png_jmpbuf(session.png))) return false;
  png_init_io(session.png, file);
  // Sizes are judged by checkImageClaim; libpng's own limit is lower on some builds.
  png_set_user_limits(session.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_read_info(session.png, session.info);
  png_set_expand(session.png);
  png_set_interlace_handling(session.png);
  png_read_update_info(session.png, session.info);
  return true;
}

bool readRows(Session& session, png_bytepp rows) {
  if (setjmp(png_jmpbuf(session.png))) return false;
  png_read_image(session.png, rows);
  png_read_end(session.png, session.info);
  return true;
}

[[noreturn]] void throwDamaged(const fs::path& path, const std::string& found) {
  throw Error({.where = path.string(),
               .expected = "a whole PNG picture",
               .found = oneLine(found),
               .todo = "the file is truncated or damaged; write it again"});
}

/// Walks the chunks before libpng does, which allocates whatever length one claims.
void checkChunks(const fs::path& path) {
  constexpr int64_t kSignature = 8, kFrame = 12;  // a chunk's length, name and checksum
  const auto end = int64_t(fs::file_size(path));
  std::ifstream file(path, std::ios::binary);
  for (int64_t at = kSignature; at < end;) {
    std::array<unsigned char, 8> raw{};
    file.seekg(at);
    file.read(reinterpret_cast<char*>(raw.data()), raw.size());
    const int64_t length = int64_t(raw[0]) << 24 | raw[1] << 16 | raw[2] << 8 | raw[3];
    at += kFrame + length;
    if (!file || at > end) throwDamaged(path, "a chunk that reaches past the end of the file");
    if (std::equal(raw.begin() + 4, raw.end(), "IEND")) return;  // what follows is nobody's business
  }
}

/// Grey or grey with alpha or RGB or RGBA to linear channels.
Image imageOf(const Pixels& pixels) {
  Image image(pixels.width, pixels.height);
  const auto count = size_t(pixels.channels);
  const size_t colours = count < 3 ? 1 : 3;
  constexpr std::array kNames = {"R", "G", "B"};
  for (size_t c = 0; c < 3; ++c) {
    std::vector<float>& values = image.addChannel(kNames[c]);
    for (size_t i = 0; i < values.size(); ++i)
      values[i] = linearFromSrgb(pixels.get(i * count + std::min(c, colours - 1)));
  }
  if (count > colours) {
    std::vector<float>& alpha = image.addChannel("A");
    for (size_t i = 0; i < alpha.size(); ++i) alpha[i] = pixels.get(i * count + colours);
  }
  return image;
}

void readText(const Session& session, Image& image) {
  png_textp texts = nullptr;
  const int count = png_get_text(session.png, session.info, &texts, nullptr);
  for (int i = 0; i < count; ++i)
    if (texts[i].text) image.metadata[texts[i].key] = texts[i].text;
}

Pixels pixelsOf(const Image& image, const PngOptions& options) {
  Pixels pixels{.width = image.width(),
                .height = image.height(),
                .channels = options.alpha ? 4 : 3,
                .bits = options.bits,
                .bytes = {},
                .rows = {}};
  pixels.allocate();
  const auto &r = image.channel("R"), &g = image.channel("G"), &b = image.channel("B");
  const float* alpha = options.alpha && image.has("A") ? image.channel("A").data() : nullptr;
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    const size_t first = i * size_t(pixels.channels);
    const glm::vec3 display = toneMap({r[i], g[i], b[i]}, options.toneMapping);
    for (int c = 0; c < 3; ++c) pixels.set(first + size_t(c), display[c]);
    if (options.alpha) pixels.set(first + 3, alpha ? alpha[i] : 1);
  }
  return pixels;
}

/// ASCII goes into tEXt, which is Latin-1; anything else is UTF-8 and needs iTXt.
std::vector<png_text> textChunks(const Image& image) {
  std::vector<png_text> chunks;
  for (const auto& [key, value] : image.metadata) {
    const bool ascii = std::all_of(value.begin(), value.end(), [](char c) { return c >= 0; });
    png_text chunk{};
    chunk.compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
    // libpng copies both and changes neither.
    chunk.key = const_cast<char*>(key.c_str());
    chunk.text = const_cast<char*>(value.c_str());
    chunks.push_back(chunk);
  }
  return chunks;
}

void appendBytes(png_structp png, png_bytep bytes, size_t count) {
  auto* encoded = static_cast<std::string*>(png_get_io_ptr(png));
  bool stored = true;
  try {
    encoded->append(reinterpret_cast<const char*>(bytes), count);
  } catch (const std::bad_alloc&) {
    stored = false;
  }
  if (!stored) png_error(png, "out of memory");
}

struct Job {
  Pixels& pixels;
  const std::vector<png_text>& texts;
  std::string& encoded;
};

bool encode(Session& session, const Job& job) {
  if (!session.png || !session.info) return false;
  if (setjmp(png_jmpbuf(session.png))) return false;
  png_set_write_fn(session.png, &job.encoded, appendBytes, nullptr);
  png_set_user_limits(session.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_IHDR(session.png, session.info, png_uint_32(job.pixels.width), png_uint_32(job.pixels.height),
               job.pixels.bits, job.pixels.channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(session.png, session.info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_text(session.png, session.info, job.texts.data(), int(job.texts.size()));
  png_write_info(session.png, session.info);
  png_write_image(session.png, job.pixels.rows.data());
  png_write_end(session.png, nullptr);
  return true;
}

}  // namespace

void writePng(const Image& image, const fs::path& path, const PngOptions& options) {
  checkWritable(image, path);
  if (options.bits != 8 && options.bits != 16)
    throw Error({.where = path.string(),
                 .expected = "8 or 16 bits",
                 .found = fmt::format("{}", options.bits),
                 .todo = ""},
                Error::Kind::kUsage);
  Pixels pixels = pixelsOf(image, options);
  const std::vector<png_text> texts = textChunks(image);
  std::string encoded;
  Writer writer;
  writer.png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, static_cast<Session*>(&writer), onError, onWarning);
  if (writer.png) writer.info = png_create_info_struct(writer.png);
  if (!encode(writer, {pixels, texts, encoded}))
    throw Error({.where = path.string(),
                 .expected = "",
                 .found = "cannot encode: " + oneLine(writer.message),
                 .todo = ""});
  writeTextAtomically(path, encoded);
}

Image readPng(const fs::path& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file)
    throw Error(
        {.where = path.string(), .expected = "", .found = "cannot read", .todo = "check its permissions"});
  checkChunks(path);
  Reader reader;
  reader.png =
      png_create_read_struct(PNG_LIBPNG_VER_STRING, static_cast<Session*>(&reader), onError, onWarning);
  if (reader.png) reader.info = png_create_info_struct(reader.png);
  if (!readHeader(reader, file.get())) throwDamaged(path, reader.message);

  const auto width = png_get_image_width(reader.png, reader.info);
  const auto height = png_get_image_height(reader.png, reader.info);
  const int channels = png_get_channels(reader.png, reader.info);
  // Four floats a pixel is what the picture becomes, whatever the file holds.
  checkImageClaim(path, width, height, 4);
  Pixels pixels{.width = int(width),
                .height = int(height),
                .channels = channels,
                .bits = png_get_bit_depth(reader.png, reader.info),
                .bytes = {},
                .rows = {}};
  pixels.allocate();
  if (!readRows(reader, pixels.rows.data())) throwDamaged(path, reader.message);
  Image image = imageOf(pixels);
  readText(reader, image);
  return image;
}

}  // namespace lychnite
