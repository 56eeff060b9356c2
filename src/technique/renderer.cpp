#include "lychnite/technique/renderer.h"

#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "gpu/timer.h"
#include "lychnite/base/error.h"
#include "lychnite/gpu/context.h"
#include "technique/composite/composite_pass.h"
#include "technique/multiple/matched_shading.h"
#include "technique/multiple/sample_view.h"
#include "technique/read_back.h"
#include "technique/renderer_textures.h"
#include "technique/shading.h"

namespace lychnite {
namespace {

/// The three components of one light.
struct LightLayers {
  Layer multiple, single, surface;
};

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

namespace {

/// Texels along a side of the light-space maps; see RenderSettings::mostMapSize.
int mapSizeOf(const Frame& frame, const RenderSettings& settings) {
  int size = settings.mapSize;
  if (settings.method != Method::kMatched || !settings.components.multiple) return size;
  for (const FrameObject& object : frame.objects) {
    if (!object.translucent) continue;
    const Rgb sigma = object.medium.sigma_tp();
    double freePath = 0;
    for (int c = 0; c < 3; ++c) freePath += 1 / (3 * std::max(sigma[c], 1e-30));
    const auto texel = [&] { return 2 * object.bounds.radius / size; };
    while (texel() > 0.25 * freePath && size * 2 <= settings.mostMapSize) size *= 2;
  }
  return size;
}

}  // namespace

struct Renderer::Impl {
  explicit Impl(const RendererOptions& options)
      : context({.device = options.device, .debug = options.debug, .current = options.useCurrentContext},
                options.log),
        profileMaker(options.profiles) {
    context.checkErrors("making the renderer");
  }

  void draw(const Scene& scene, const RenderSettings& settings, const Progress& progress);
  void drawLayers(const ShadingInputs& in, const Scene& scene);
  Image read(const Scene& scene, const RenderSettings& settings);
  void describe(Image& image, const RenderSettings& settings) const;
  void fillStats(double start);

  /// Runs `work`, which returns how often it drew, under the timer of that name.
  template <class Work>
  void timed(const char* name, Work work) {
    gpu::GpuTimer& timer = timers.try_emplace(name, name).first->second;
    int runs = 0;
    {
      const gpu::GpuTimer::Scope scope(timer);
      runs = work();
    }
    stats.passes.push_back({name, 0, runs});
  }

  gpu::Context context;  // first: everything below lives in it
  ProfileMaker profileMaker;
  MeshCache meshes;
  ProfileCache profiles;
  LightMapPass maps;
  GeometryPass geometry;
  MultipleMatchedShading matched;
  MultipleLatticeShading lattice;
  SingleShading single;
  SurfaceShading surface;
  AmbientShading ambient;
  CompositePass composite;
  SampleView sampleView;
  std::vector<LightLayers> layers;
  Layer ambientLayer;
  std::map<std::string, gpu::GpuTimer> timers;
  Frame frame;
  RenderStats stats;
};

void Renderer::Impl::draw(const Scene& scene, const RenderSettings& settings, const Progress& progress) {
  progress.check({.what = "render", .fraction = 0, .detail = methodName(settings.method)});
  frame = makeFrame(scene, settings.width, settings.height);
  meshes.update(frame);
  profiles.update(frame, settings.profile, profileMaker, progress);
  stats.mapSize = mapSizeOf(frame, settings);
  const LightMapNeeds needs{.size = stats.mapSize,
                            .cosine = true,
                            .fiveChannels = settings.method == Method::kFixed && settings.components.multiple,
                            .moments = settings.method == Method::kMatched && settings.components.multiple,
                            .farDepth = settings.components.single};
  timed("light_map", [&] { return maps.update(frame, meshes, needs); });
  timed("geometry", [&] { return geometry.update(frame, meshes) ? 1 : 0; });
  layers.resize(frame.lights.size());
  drawLayers({frame, geometry, maps, profiles, settings}, scene);
}

void Renderer::Impl::drawLayers(const ShadingInputs& in, const Scene& scene) {
  const Components& on = in.settings.components;
  std::vector<const gpu::Texture*> shown;
  const auto each = [&](const char* name, bool wanted, auto Layer_, auto& shading) {
    if (!wanted) return;
    timed(name, [&] {
      int runs = 0;
      for (size_t l = 0; l < layers.size(); ++l) runs += shading.update(layers[l].*Layer_, in, l) ? 1 : 0;
      return runs;
    });
    for (LightLayers& light : layers) shown.push_back(&(light.*Layer_).texture());
  };
  if (in.settings.method == Method::kMatched)
    each("multiple", on.multiple, &LightLayers::multiple, matched);
  else
    each("multiple", on.multiple, &LightLayers::multiple, lattice);
  each("single", on.single, &LightLayers::single, single);
  each("surface", on.surface, &LightLayers::surface, surface);
  if (on.surface && scene.ambient != Rgb(0)) {
    timed("ambient", [&] { return ambient.update(ambientLayer, in, scene.ambient) ? 1 : 0; });
    shown.push_back(&ambientLayer.texture());
  }
  timed("composite", [&] {
    composite.draw(frame, geometry, scene.background, shown);
    return 1;
  });
}

Image Renderer::Impl::read(const Scene& scene, const RenderSettings& settings) {
  Image image(settings.width, settings.height);
  readPicture(composite.picture(), image);
  const auto layer = [&](const char* name, bool on, auto member) {
    if (!settings.wants(name)) return;
    std::vector<const gpu::Texture*> parts;
    if (on)
      for (LightLayers& light : layers) parts.push_back(&(light.*member).texture());
    if (std::string_view(name) == "surface" && on && scene.ambient != Rgb(0))
      parts.push_back(&ambientLayer.texture());
    readLayer(parts, image, name);
  };
  const Components& on = settings.components;
  layer("multiple", on.multiple, &LightLayers::multiple);
  layer("single", on.single, &LightLayers::single);
  layer("surface", on.surface, &LightLayers::surface);
  if (settings.wants("lights")) {
    for (size_t l = 0; l < layers.size(); ++l) {
      std::vector<const gpu::Texture*> parts;
      if (on.multiple) parts.push_back(&layers[l].multiple.texture());
      if (on.single) parts.push_back(&layers[l].single.texture());
      if (on.surface) parts.push_back(&layers[l].surface.texture());
      readLayer(parts, image, fmt::format("light{}", l + 1));
    }
  }
  if (settings.wants("depth") || settings.wants("normal"))
    readGeometry(geometry.samples(), frame, image, settings.wants("depth"), settings.wants("normal"));
  describe(image, settings);
  return image;
}

void Renderer::Impl::describe(Image& image, const RenderSettings& settings) const {
  image.metadata["method"] = methodName(settings.method);
  image.metadata["profile"] = profileName(settings.profile);
  image.metadata["components"] = componentsName(settings.components);
  image.metadata["map"] = std::to_string(stats.mapSize);
  image.metadata["single_samples"] = std::to_string(settings.singleSamples);
  image.metadata["device"] = context.device().renderer;
  image.metadata["driver"] = context.device().version;
}

void Renderer::Impl::fillStats(double start) {
  const gpu::DeviceInfo& device = context.device();
  stats.device = device.renderer;
  stats.driver = device.version;
  stats.software = device.software;
  for (const FrameObject& object : frame.objects) {
    stats.triangles += object.source->mesh->triangles.size();
    stats.vertices += object.source->mesh->positions.size();
  }
  stats.mapBytes = maps.bytes();
  stats.gpuBytes = gpu::allocatedBytes();
  stats.frameMs = (seconds() - start) * 1000;
}

Renderer::Renderer(const RendererOptions& options) : impl_(std::make_unique<Impl>(options)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

namespace {

/// The settings with a method that is drawn here.
RenderSettings checked(const Scene& scene, RenderSettings settings) {
  if (settings.method == Method::kAuto) settings.method = Method::kMatched;
  validate(scene);
  validate(settings);
  if (isReference(settings.method) || settings.method == Method::kVolume)
    throw Error({.where = "method",
                 .expected = "a real-time method",
                 .found = fmt::format("'{}', which renderReference() renders", methodName(settings.method)),
                 .todo = ""},
                Error::Kind::kUsage);
  return settings;
}

}  // namespace

Image Renderer::render(const Scene& scene, const RenderSettings& wish, const Progress& progress) {
  const RenderSettings settings = checked(scene, wish);
  const double start = seconds();
  impl_->context.makeCurrent();
  impl_->stats = {};
  impl_->draw(scene, settings, progress);
  Image image = impl_->read(scene, settings);
  for (RenderStats::Pass& pass : impl_->stats.passes)
    pass.gpuMs = pass.runs > 0 ? impl_->timers.at(pass.name).wait() : 0;
  for (const float a : image.channel("A")) impl_->stats.coveredPixels += a > 0 ? 1 : 0;
  impl_->fillStats(start);
  impl_->context.checkErrors("render");
  return image;
}

void Renderer::draw(const Scene& scene, const RenderSettings& wish) {
  const RenderSettings settings = checked(scene, wish);
  const double start = seconds();
  impl_->context.makeCurrent();
  impl_->stats = {};
  impl_->draw(scene, settings, {});
  for (RenderStats::Pass& pass : impl_->stats.passes)
    pass.gpuMs = pass.runs > 0 ? impl_->timers.at(pass.name).poll().value_or(0) : 0;
  impl_->fillStats(start);
}

const gpu::Texture& RendererTextures::picture(const Renderer& renderer) {
  return renderer.impl_->composite.picture();
}

const gpu::Texture& RendererTextures::geometry(const Renderer& renderer) {
  return renderer.impl_->geometry.samples();
}

const LightMapPass& RendererTextures::maps(const Renderer& renderer) {
  return renderer.impl_->maps;
}

std::optional<SeenSamples> RendererTextures::samplesAt(Renderer& renderer, const Scene& scene,
                                                       const RenderSettings& wish, const glm::ivec2& pixel,
                                                       size_t light) {
  Renderer::Impl& all = *renderer.impl_;
  const RenderSettings settings = checked(scene, wish);
  if (!settings.components.multiple || light >= scene.lights.size()) return {};
  all.context.makeCurrent();
  const Frame frame = makeFrame(scene, settings.width, settings.height);
  const ShadingInputs in{frame, all.geometry, all.maps, all.profiles, settings};
  if (settings.method == Method::kMatched) return all.sampleView.at(in, all.matched, pixel, light);
  return all.sampleView.at(in, all.lattice, pixel, light);
}

const RenderStats& Renderer::stats() const {
  return impl_->stats;
}

}  // namespace lychnite
