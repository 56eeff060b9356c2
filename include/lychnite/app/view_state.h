#pragma once

#include <optional>
#include <string>

#include "lychnite/image/tone_map.h"
#include "lychnite/scene/scene.h"
#include "lychnite/scene/settings.h"

namespace lychnite {

/// What differs in the second picture of a comparison; what is empty is as in the first.
struct Variant {
  std::optional<Method> method;  ///< a real-time one or `volume`
  std::optional<int> samples;    ///< of `matched`
  std::optional<ProfileKind> profile;
  std::optional<Material> material;  ///< of the subject
  std::optional<double> size;        ///< of the subject, mm; the rest of the scene scales along
};

/// Two pictures in one window.
struct CompareView {
  enum class Mode { kOff, kWipe, kDifference };
  enum class Source {
    kView,     ///< the scene as it is
    kVariant,  ///< with the Variant's changes
    kTruth,    ///< the walk, refined in the background
    kFile      ///< a picture that was opened
  };
  Mode mode = Mode::kOff;
  Source left = Source::kView, right = Source::kVariant;
  double wipe = 0.5;  ///< where right begins, share of the width
  double full = 0.5;  ///< difference view: the relative error at the scale's end
};

/// What the window shows of the picture.
struct Inspect {
  enum class Layer { kPicture, kDepth, kNormal, kMap };
  Layer layer = Layer::kPicture;
  int light = 0;         ///< kMap: whose light-space map, from 0
  int mapLevel = 0;      ///< kMap: mip level
  bool samples = false;  ///< those of the pixel under the mouse, of the same light
};

/// Everything that a person changes in the viewer and can undo. Plain data.
struct ViewState {
  Scene scene;
  /// Width and height are the window's affair. Cells of any size alike, so that `volume` keeps them in
  /// motion.
  RenderSettings settings{.method = Method::kVolume, .cells = 64};
  ToneMapping toneMapping;
  Variant variant;
  CompareView compare;
  Inspect inspect;
  bool ruler = true;
  double resolution = 1;  ///< of the picture at rest: pixels over the window's along each side, in (0, 1]
};

/// The object that sizes and materials mean: the first translucent one, else the first.
size_t subjectIndex(const Scene& scene);

/// All of the state as text: two states are equal when these are (meshes: the same mesh).
std::string fingerprint(const ViewState& state);

/// The scene that the Variant describes, and its settings.
ViewState applied(const Variant& variant, const ViewState& state);

/// A model alone in light that shows what it is made of: a key light behind it, a weak one in front.
ViewState defaultView(const Object& object);

/// The command that writes the same picture from a saved scene.
std::string renderCommand(const ViewState& state, const std::string& scenePath,
                          const std::string& picturePath, int width, int height);

}  // namespace lychnite
