#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "lychnite/base/log.h"
#include "lychnite/image/image.h"
#include "lychnite/image/io.h"
#include "lychnite/scene/scene.h"
#include "lychnite/scene/settings.h"

namespace lychnite {

/// Puts the calling thread, and those that it starts, behind others that want the processor: 19 is behind all
/// of them, 0 not at all. Best effort: nothing where the platform has no such thing.
void lowerThreadPriority(int niceness = 19);

/// How many threads work in the background: `wanted`, or for 0 one for up to two cores and half of them for
/// more.
int backgroundThreads(int wanted);

/// The walk, refined for as long as its scene stays wanted, on threads of low priority of its own.
class BackgroundWalk {
 public:
  struct Result {
    std::shared_ptr<const Image> image;  ///< with "stderr"
    double noise = 0;                    ///< relative, see renderReference
    double seconds = 0;                  ///< spent on it so far
    double photonsPerPixel = 0;
  };

  struct Options {
    int threads = 0;        ///< as backgroundThreads() takes it
    double enough = 0.005;  ///< the noise to stop at
    bool yields = true;     ///< to everything else that wants the processor
  };
  explicit BackgroundWalk(const Options& options);
  ~BackgroundWalk();
  BackgroundWalk(const BackgroundWalk&) = delete;
  BackgroundWalk& operator=(const BackgroundWalk&) = delete;

  /// Starts over for another scene, settings or resolution, goes on for the same one. Never waits.
  void want(const Scene& scene, const RenderSettings& settings);
  /// Forgets the scene; what runs stops as soon as it can. Never waits.
  void stop();
  /// The newest picture of what is wanted; empty before the first and after a failure.
  std::optional<Result> newest() const;
  /// Why there is no picture, "" when all is well.
  std::string problem() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The light inside by VolumeSolver, pass after pass for as long as its scene stays wanted. The solver is
/// kept: a camera that moved costs a picture, a light that changed its colour as well. After
/// RenderSettings::passes passes the picture is the one that ImageMaker renders.
class BackgroundVolume {
 public:
  struct Result {
    std::shared_ptr<const Image> image;  ///< null where there is an obstacle
    int passes = 0;                      ///< of photons in it
    std::string obstacle{};              ///< why the scene has no inside to solve in, see VolumeSolver
    Scene scene{};                       ///< that it was made of
    double pictureSeconds = 0;           ///< the picture alone, without what was solved for it
    bool preview = false;                ///< as of a scene that moves, see VolumeSolver::Detail
    bool newView = false;                ///< which took most of that: the camera saw something else before
    bool behind = false;                 ///< another scene is wanted by now
  };

  struct Options {
    int threads = 0;     ///< as backgroundThreads() takes it
    int passes = 64;     ///< to stop at
    bool yields = true;  ///< to others that want the processor, a little: a window waits for it
  };
  explicit BackgroundVolume(const Options& options);
  ~BackgroundVolume();
  BackgroundVolume(const BackgroundVolume&) = delete;
  BackgroundVolume& operator=(const BackgroundVolume&) = delete;

  /// As BackgroundWalk's, but that the newest picture stays, as one that is behind, until the first of what
  /// is wanted now. `moving`: one picture only, which is finished when another scene is wanted meanwhile, so
  /// that there are pictures of a scene that changes all the time.
  void want(const Scene& scene, const RenderSettings& settings, bool moving = false);
  void stop();
  std::optional<Result> newest() const;
  std::string problem() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The dipole's sum over the lit surface, which the real-time methods approximate: the same profile, summed
/// to RenderSettings::tolerance. Measured profiles are not offered.
class BackgroundDipole {
 public:
  explicit BackgroundDipole(int threads, bool yields = true);
  ~BackgroundDipole();
  BackgroundDipole(const BackgroundDipole&) = delete;
  BackgroundDipole& operator=(const BackgroundDipole&) = delete;

  /// As BackgroundWalk's.
  void want(const Scene& scene, const RenderSettings& settings);
  void stop();
  std::shared_ptr<const Image> newest() const;
  /// Why there is none for what was wanted last; "" while it is being made.
  std::string problem() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// One picture to write, as `lychnite render` would.
struct PictureRequest {
  Scene scene;
  RenderSettings settings;
  PngOptions png;
  std::filesystem::path output;
  std::string device = "auto";
};

/// Renders and writes pictures one after the other on a thread of its own, with a device context of its own.
class PictureWriter {
 public:
  /// Of the picture that was written last, or failed.
  struct Outcome {
    std::filesystem::path output;
    std::string problem;  ///< "" when it was written
  };

  PictureWriter();
  ~PictureWriter();
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  void start(PictureRequest request);
  bool busy() const;
  /// Share of the current picture that is done.
  double fraction() const;
  /// Stops the current picture, which then writes nothing, and drops those that wait.
  void cancel();
  /// Each outcome once.
  std::optional<Outcome> takeOutcome();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Writes EXR or PNG by the path's extension, with the exposure among the metadata and without timings
/// ("seconds", "..._ms"), so that the same picture is the same file.
void savePicture(Image& image, const std::filesystem::path& path, const PngOptions& png);

}  // namespace lychnite
