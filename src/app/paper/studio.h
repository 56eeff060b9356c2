#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "app/paper/report.h"
#include "lychnite/app/image_maker.h"
#include "lychnite/app/paper.h"
#include "lychnite/image/tone_map.h"

namespace lychnite::paper {

/// Where the parts of the report make their pictures: renders by any method, keeps each picture on disk with
/// a key of what made it, and takes it from there when it is asked for again.
class Studio {
 public:
  /// `program` is a key of what makes the pictures.
  Studio(const PaperSettings& settings, ImageMaker& maker, std::string device, std::string program)
      : settings_(settings), maker_(maker), device_(std::move(device)), program_(std::move(program)) {}

  const PaperSettings& settings() const { return settings_; }
  bool quick() const { return settings_.quick; }
  const std::string& device() const { return device_; }  ///< name of the OpenGL device
  const std::string& program() const { return program_; }

  /// Begins a part: its pictures go to `folder`, which is made. `work` is how many step()s it will take.
  void begin(const std::filesystem::path& folder, int work, const Progress& progress);
  /// One more step is done; throws Interrupted.
  void step(const std::string& what);
  /// Progress of what happens within the current step.
  Progress within(const std::string& what) const;

  /// The built-in model of that name, or the file of the folder of models.
  Object object(const std::string& model);

  /// How a picture's time is taken: of the call, or of a real-time method the median of three frames in which
  /// all but the mesh changes.
  enum class Timing { kOnce, kFrames };
  /// The picture of a scene, from `name`.exr where that was made of the same scene and settings. A walk that
  /// is interrupted is kept, and gone on with. One step. Metadata "paper.seconds": the wall time it took.
  Image picture(const std::string& name, const Scene& scene, const RenderSettings& settings,
                Timing timing = Timing::kOnce);
  static double secondsOf(const Image& image);

  /// Writes `name`.png; the name with its extension.
  std::string show(const std::string& name, const Image& image, const ToneMapping& toneMapping = {});
  /// A file of this part that is written by other means: its path; it will not be cleaned away.
  std::filesystem::path file(const std::string& name);

  /// For what the ImageMaker's renderer does not show; in the same context.
  Renderer& renderer();

  /// Seconds spent since begin(), pictures found on disk not counted.
  double seconds() const;
  /// Names of what the part has written or found.
  const std::set<std::string>& files() const { return files_; }

 private:
  Image render(const std::string& name, const Scene& scene, const RenderSettings& settings, Timing timing);
  Image walk(const std::string& name, const std::string& key, const Scene& scene,
             const RenderSettings& settings);
  std::string keyOf(const Scene& scene, const RenderSettings& settings);

  const PaperSettings& settings_;
  ImageMaker& maker_;
  std::string device_, program_;
  std::filesystem::path folder_;
  std::set<std::string> files_;
  Progress progress_;
  int steps_ = 1, done_ = 0;
  double begun_ = 0;
  std::map<std::shared_ptr<const Mesh>, std::string> meshKeys_;  ///< kept, so that no address comes again
  std::map<std::string, Object> objects_;
  std::optional<Renderer> renderer_;
};

/// 64 bits of FNV-1a, as 16 hexadecimal digits.
std::string hashOf(std::string_view bytes);

/// An exposure (stops) at which the brighter parts of the covered pixels (their 98th percentile) are shown
/// at 0.8 of white.
double exposureFor(const Image& image);

/// Mean colour of the pixels that are covered whole.
glm::dvec3 meanColour(const Image& image);

/// A picture of display values as linear ones, for writePng and its plain sRGB curve.
Image displayed(const Image& image);

/// The picture with its colour times a factor.
Image scaled(const Image& image, double factor);

}  // namespace lychnite::paper
