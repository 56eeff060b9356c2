#include "technique/light_map/light_map_pass.h"

#include <set>

#include "gpu/pass.h"

namespace lychnite {
namespace {

gpu::ProgramDesc mapProgram(const std::string& label, const std::string& fragment,
                            gpu::ShaderDefines defines) {
  return {.label = label,
          .vertex = "pass/light_map.vert",
          .fragment = fragment,
          .defines = std::move(defines),
          .root = {}};
}

gpu::Texture mapTexture(const std::string& label, gpu::Format format, int size, gpu::Filter filter,
                        gpu::Wrap wrap) {
  return gpu::Texture({.label = label,
                       .format = format,
                       .width = size,
                       .height = size,
                       .levels = filter == gpu::Filter::kNearest ? 1 : 0,
                       .filter = filter,
                       .wrap = wrap});
}

Key keyOf(const LightView& view, const Frame& frame, size_t object, const LightMapNeeds& needs) {
  Key key = view.key();
  key.add(double(object)).add(needs.size).add(needs.cosine).add(needs.fiveChannels).add(needs.moments);
  key.add(needs.farDepth).add(needs.moments ? frame.objects[object].medium.eta : 0);
  for (const FrameObject& each : frame.objects) key.add(double(each.mesh)).add(each.toWorld);
  return key;
}

void setObjectUniforms(gpu::Program& program, const LightView& view, const FrameObject& object) {
  program.set("toWorld", glm::mat4(object.toWorld));
  program.set("toClip", glm::mat4(view.toClip() * object.toWorld));
  program.set("normalToWorld", object.normalToWorld);
}

}  // namespace

LightMapPass::LightMapPass()
    : cosineProgram_(mapProgram("light map, two channels", "pass/light_map.frag", {{"LAYOUT", "2"}})),
      normalProgram_(mapProgram("light map, five channels", "pass/light_map.frag", {{"LAYOUT", "5"}})),
      momentsProgram_(mapProgram("light map, moments", "pass/light_map.frag", {{"LAYOUT", "4"}})),
      farProgram_(mapProgram("far depth", "pass/far_depth.frag", {})) {}

int LightMapPass::update(const Frame& frame, const MeshCache& meshes, const LightMapNeeds& needs) {
  std::erase_if(maps_, [&](const auto& entry) {
    return entry.first.first >= frame.objects.size() || entry.first.second >= frame.lights.size();
  });
  int drawn = 0;
  for (size_t o = 0; o < frame.objects.size(); ++o) {
    for (size_t l = 0; l < frame.lights.size(); ++l) {
      Map& map = maps_[{o, l}];
      LightMapNeeds own = needs;
      own.farDepth = needs.farDepth && frame.objects[o].translucent;
      own.fiveChannels = needs.fiveChannels && frame.objects[o].translucent;
      own.moments = needs.moments && frame.objects[o].translucent;
      map.view = fitLightView(frame, o, l);
      const Key key = keyOf(map.view, frame, o, own);
      if (map.key == key) continue;
      map.key = Key();
      draw(map, frame, meshes, o, own);
      map.key = key;
      ++drawn;
    }
  }
  return drawn;
}

void LightMapPass::draw(Map& map, const Frame& frame, const MeshCache& meshes, size_t object,
                        const LightMapNeeds& needs) {
  const auto fit = [&](std::optional<gpu::Texture>& texture, bool wanted, const char* label,
                       gpu::Format format, gpu::Filter filter, gpu::Wrap wrap = gpu::Wrap::kClampToEdge) {
    if (texture && (!wanted || texture->width() != needs.size)) texture.reset();
    if (wanted && !texture) texture.emplace(mapTexture(label, format, needs.size, filter, wrap));
  };
  constexpr auto kSingle = gpu::Filter::kNearest, kChain = gpu::Filter::kLinearMipNearest;
  fit(depth_, true, "light map depth", gpu::Format::kDepth32f, kSingle);
  fit(map.cosine, needs.cosine || needs.moments, "light map", gpu::Format::kRg32f, kChain);
  fit(map.normal, needs.fiveChannels, "light map normal", gpu::Format::kRgba32f, kChain);
  fit(map.normalDepth, needs.fiveChannels, "light map normal depth", gpu::Format::kR32f, kChain);
  // Beyond the border no flux enters, and coarse levels fade there.
  fit(map.moments, needs.moments, "light map moments", gpu::Format::kRgba32f, gpu::Filter::kLinearMipLinear,
      gpu::Wrap::kClampToBorder);
  fit(map.farDepth, needs.farDepth, "far depth", gpu::Format::kR32f, kSingle);
  const float background = float(map.view.backgroundDepth);
  if (map.moments) {
    gpu::Framebuffer framebuffer(
        {.label = "light map", .colours = {*map.moments, *map.cosine}, .depth = *depth_});
    framebuffer.clearColour(0, {0, 0, 0, 0});
    framebuffer.clearColour(1, {background, 0, 0, 0});
    momentsProgram_.set("eta", frame.objects[object].medium.eta);
    momentsProgram_.set("centreDepth", map.view.centreDepth);
    drawNearest(momentsProgram_, framebuffer, map, frame, meshes, object);
    map.moments->generateMipmaps();
  } else if (map.cosine) {
    gpu::Framebuffer framebuffer({.label = "light map", .colours = {*map.cosine}, .depth = *depth_});
    framebuffer.clearColour(0, {background, 0, 0, 0});
    drawNearest(cosineProgram_, framebuffer, map, frame, meshes, object);
    map.cosine->generateMipmaps();
  }
  if (map.normal) {
    gpu::Framebuffer framebuffer(
        {.label = "light map", .colours = {*map.normal, *map.normalDepth}, .depth = *depth_});
    framebuffer.clearColour(0, {0, 0, 0, 0});
    framebuffer.clearColour(1, {background, 0, 0, 0});
    drawNearest(normalProgram_, framebuffer, map, frame, meshes, object);
    map.normal->generateMipmaps();
    map.normalDepth->generateMipmaps();
  }
  if (map.farDepth) drawFarthest(map, frame, meshes, object);
}

void LightMapPass::drawNearest(gpu::Program& program, gpu::Framebuffer& framebuffer, const Map& map,
                               const Frame& frame, const MeshCache& meshes, size_t object) {
  framebuffer.clearDepth();
  gpu::Pass pass("light map", framebuffer, {.depthTest = gpu::DepthTest::kLess, .depthWrite = true});
  map.view.setUniforms(program);
  for (size_t i = 0; i < frame.objects.size(); ++i) {
    setObjectUniforms(program, map.view, frame.objects[i]);
    program.set("occluder", i == object ? 0.0f : 1.0f);
    pass.drawMesh(program, meshes.get(frame.objects[i]));
  }
}

void LightMapPass::drawFarthest(Map& map, const Frame& frame, const MeshCache& meshes, size_t object) {
  gpu::Framebuffer framebuffer({.label = "far depth", .colours = {*map.farDepth}, .depth = *depth_});
  framebuffer.clearColour(0, {0, 0, 0, 0});
  framebuffer.clearDepth(0);
  gpu::Pass pass("far depth", framebuffer, {.depthTest = gpu::DepthTest::kGreater, .depthWrite = true});
  map.view.setUniforms(farProgram_);
  setObjectUniforms(farProgram_, map.view, frame.objects[object]);
  pass.drawMesh(farProgram_, meshes.get(frame.objects[object]));
}

size_t LightMapPass::bytes() const {
  size_t sum = depth_ ? depth_->bytes() : 0;
  for (const auto& [index, map] : maps_)
    for (const auto* texture : {&map.cosine, &map.moments, &map.normal, &map.normalDepth, &map.farDepth})
      if (*texture) sum += (*texture)->bytes();
  return sum;
}

}  // namespace lychnite
