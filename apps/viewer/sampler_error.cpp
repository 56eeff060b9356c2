#include "sampler_error.h"

#include <algorithm>
#include <cmath>

#include "lychnite/base/error.h"

namespace lychnite::viewer {
namespace {

constexpr double kPixels = 2400;      // of the small picture
constexpr double kTolerance = 0.005;  // of the dipole's sum

}  // namespace

bool SamplerError::judges(const RenderSettings& settings) {
  return settings.method != Method::kVolume && settings.profile != ProfileKind::kTabulated &&
         settings.components.multiple;
}

void SamplerError::want(const ViewState& state, double aspect) {
  ViewState plain;
  plain.scene = state.scene;
  plain.settings = state.settings;
  plain.settings.components = {.multiple = true, .single = false, .surface = false};
  plain.settings.width = std::max(8, int(std::lround(std::sqrt(kPixels * aspect))));
  plain.settings.height = std::max(8, int(std::lround(std::sqrt(kPixels / aspect))));
  plain.settings.tolerance = kTolerance;
  plain.settings.interpolation = 0;  // between pixels as far apart as these it would not mean the same
  plain.scene.ambient = plain.scene.background = Rgb(0);
  std::string key = fingerprint(plain) + std::to_string(plain.settings.width);
  if (key != key_) {
    key_ = std::move(key);
    found_.reset();
    sampled_.reset();
    problem_.clear();
    if (!judges(state.settings)) return dipole_.stop();
    if (!renderer_) renderer_ = std::make_unique<Renderer>(options_);
    try {
      sampled_ = renderer_->render(plain.scene, plain.settings);
    } catch (const Error& error) {
      if (error.kind() == Error::Kind::kDevice) throw;
      problem_ = error.what();  // a light inside the object: the picture says so, too
      return dipole_.stop();
    }
  }
  if (pending()) dipole_.want(plain.scene, plain.settings);
}

void SamplerError::stop() {
  dipole_.stop();
  key_.clear();
}

const std::optional<Metrics>& SamplerError::found() {
  if (!pending()) return found_;
  const auto judge = dipole_.newest();
  if (!judge) {
    problem_ = dipole_.problem();
    return found_;
  }
  try {
    found_ = compare(*sampled_, *judge).together;
  } catch (const std::exception& error) {
    problem_ = error.what();  // no light, nothing in view
  }
  return found_;
}

}  // namespace lychnite::viewer
