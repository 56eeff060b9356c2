#include "technique/multiple/matched_shading.h"

#include <algorithm>

#include "gpu/pass.h"

namespace lychnite {
namespace {

/// Pixels shaded at once, at most: what bounds the lists' memory (four receivers a pixel).
constexpr int kMostPixels = 1 << 19;
/// Samples of a pixel nearer together than this many mean lengths of the profile's core share a receiver.
constexpr double kShareWithin = 0.25;
/// Rows of groups of lists/matched_evaluate.comp: groups next to each other in the lists lie in different
/// rows, and a software driver gives each core groups in rows.
constexpr int kGroupRows = 16;
/// One list for each number of cells and for each two that are cross-faded.
constexpr int kLists = 2 * MultipleMatchedShading::kMostRefinement + 1;
/// What lies before the lists in their buffer: columns, rows and layers of groups, the groups that the lists
/// fill, and the lists' lengths.
using ListsHeader = std::array<uint32_t, 4 + size_t(kLists)>;

gpu::ShaderDefines listDefines() {
  gpu::ShaderDefines defines = MultipleMatchedShading::defines();
  defines.emplace_back("GROUP_ROWS", std::to_string(kGroupRows));
  return defines;
}

gpu::Program computeProgram(const std::string& label, const std::string& file) {
  gpu::ProgramDesc desc;
  desc.label = label;
  desc.compute = file;
  desc.defines = listDefines();
  return gpu::Program(desc);
}

/// A hundredth of what a half-space in the object's place would give.
Rgb faintRadiosity(const ShadingInputs& in, size_t object, size_t light) {
  const LightView& view = in.maps.get(object, light).view;
  const Rgb all = 0.01 * in.profiles.get(object).total * Rgb(view.power);
  if (!view.perspective) return all;
  const double distance = glm::distance(in.frame.objects[object].bounds.centre, glm::dvec3(view.origin));
  return all / (distance * distance);
}

}  // namespace

gpu::ShaderDefines MultipleMatchedShading::defines() {
  return {{"MOST_REFINEMENT", std::to_string(kMostRefinement)}};
}

MultipleMatchedShading::MultipleMatchedShading()
    : plan_(shadingProgram("matched, plan", "lists/matched_plan.frag", listDefines())),
      evaluate_(computeProgram("matched, evaluate", "lists/matched_evaluate.comp")),
      gather_(shadingProgram("matched, gather", "lists/matched_gather.frag")) {}

void MultipleMatchedShading::resize(const CameraFrame& camera) {
  const auto texture = [&](const char* label, int width, int height) {
    return gpu::Texture({.label = label, .format = gpu::Format::kRgba32f, .width = width, .height = height});
  };
  for (int l = 0; l < kLevels; ++l) {
    // A last row or column that is no whole block has no site; its pixels find fewer neighbours.
    const int width = std::max(1, camera.width >> l);
    const int rows = l > 0 ? camera.height >> l : std::min(camera.height, kMostPixels / camera.width);
    const int height = std::max(1, rows);
    std::optional<Level>& level = levels_[size_t(l)];
    if (level && level->value.width() == width && level->value.height() == height) continue;
    level.reset();
    gpu::Texture value = texture("matched, values", width, height);
    gpu::Texture surface = texture("matched, surfaces", width, height);
    gpu::Framebuffer framebuffer({.label = "matched", .colours = {value, surface}, .depth = {}});
    level.emplace(Level{std::move(value), std::move(surface), std::move(framebuffer),
                        gpu::Buffer("matched, lists"), 0});
    level->listLength = l > 0 ? width * std::clamp(4 * kMostPixels / width, 1, height) : 4 * width * height;
    level->sites.resize(sizeof(ListsHeader) + size_t(kLists) * size_t(level->listLength) * sizeof(uint32_t));
    if (l == 0) evaluated_.emplace(texture("matched, evaluated", width, 4 * height));
  }
}

void MultipleMatchedShading::setUniforms(gpu::Program& program, const ShadingInputs& in, size_t object,
                                         size_t light) {
  const FrameObject& target = in.frame.objects[object];
  const LightMapPass::Map& map = in.maps.get(object, light);
  const ProfileCache::Entry& profile = in.profiles.get(object);
  map.view.setUniforms(program);
  program.setTexture("moments", *map.moments);
  program.setTexture("profile", *profile.table);
  program.set("profileScale", profile.scale);
  program.set("centreDepth", map.view.centreDepth);
  program.set("boundRadius", target.bounds.radius);
  program.set("spiralScale", profile.spiralScale);
  program.set("reach", profile.reach);
  program.set("sampleCount", in.settings.multipleSamples);
  program.set("shareWithin", kShareWithin * profile.coreLength);
}

void MultipleMatchedShading::setSiteUniforms(gpu::Program& program, const Target& target, int level) {
  const ProfileCache::Entry& profile = target.in.profiles.get(target.object);
  setReceiverUniforms(program, target.in.frame, target.in.geometry.samples(), target.object);
  program.set("level", level);
  program.set("listLength", levels_[size_t(level)]->listLength);
  program.set("anyLobe", level > 0);
  program.set("eta", target.in.frame.objects[target.object].medium.eta);
  program.set("piC", profile.piC);
}

void MultipleMatchedShading::clear(int level) {
  for (int target : {0, 1}) levels_[size_t(level)]->framebuffer.clearColour(target, {0, 0, 0, 0});
}

void MultipleMatchedShading::plan(const Target& target, int level, const gpu::Rect& sites) {
  Level& here = *levels_[size_t(level)];
  const ListsHeader empty{0, kGroupRows, 1};
  here.sites.update(0, std::as_bytes(std::span(empty)));
  setSiteUniforms(plan_, target, level);
  target.in.maps.get(target.object, target.light).view.setUniforms(plan_);
  const bool hasCoarser = level + 1 < kLevels && target.in.settings.interpolation > 0;
  plan_.set("hasCoarser", hasCoarser);
  if (hasCoarser) {
    const Level& coarser = *levels_[size_t(level) + 1];
    plan_.setTexture("coarserValue", coarser.value);
    plan_.setTexture("coarserSurface", coarser.surface);
  } else {  // nothing is read, but something has to be bound
    plan_.setTexture("coarserValue", target.in.geometry.samples());
    plan_.setTexture("coarserSurface", target.in.geometry.samples());
  }
  const double coreLength = target.in.profiles.get(target.object).coreLength;
  plan_.set("interpolation", target.in.settings.interpolation);
  plan_.set("coreLength", coreLength);
  plan_.set("shareWithin", kShareWithin * coreLength);
  plan_.set("faint", glm::vec3(faintRadiosity(target.in, target.object, target.light)));
  plan_.setStorage("Sites", here.sites);
  const gpu::Rect bounds{sites.x, level > 0 ? sites.y : 0, sites.width, sites.height};
  plan_.set("firstRow", sites.y - bounds.y);
  gpu::Pass pass("matched, plan", here.framebuffer, {.scissor = bounds});
  pass.drawFullScreen(plan_);
}

void MultipleMatchedShading::evaluate(const Target& target, int level, const gpu::Rect& sites) {
  plan(target, level, sites);
  Level& here = *levels_[size_t(level)];
  setUniforms(evaluate_, target.in, target.object, target.light);
  setSiteUniforms(evaluate_, target, level);
  evaluate_.setStorage("Sites", here.sites);
  evaluate_.setImage("evaluated", level > 0 ? here.value : *evaluated_);
  evaluate_.set("firstRow", level > 0 ? 0 : sites.y);
  gpu::dispatch("matched, evaluate", evaluate_, here.sites);
}

void MultipleMatchedShading::shade(const Target& target, const Layer::Target& layer) {
  const gpu::Rect& all = layer.bounds;
  resize(target.in.frame.camera);
  for (int l = kLevels - 1; l > 0 && target.in.settings.interpolation > 0; --l) {
    clear(l);
    const int most = levels_[size_t(l)]->listLength / levels_[size_t(l)]->value.width();
    for (int y = all.y >> l, end = y + (all.height >> l) + 2; y < end; y += most)
      evaluate(target, l, {all.x >> l, y, (all.width >> l) + 2, std::min(most, end - y)});
  }
  const int most = levels_[0]->value.height();
  for (int y = all.y; y < all.y + all.height; y += most) {
    const gpu::Rect band{all.x, y, all.width, std::min(most, all.y + all.height - y)};
    clear(0);
    evaluate(target, 0, band);
    gather_.setTexture("value", levels_[0]->value);
    gather_.setTexture("surface", levels_[0]->surface);
    gather_.setTexture("evaluated", *evaluated_);
    gather_.set("firstRow", y);
    gpu::Pass pass("matched, gather", layer.framebuffer, {.blend = gpu::Blend::kAdd, .scissor = band});
    pass.drawFullScreen(gather_);
  }
}

bool MultipleMatchedShading::update(Layer& layer, const ShadingInputs& in, size_t light) {
  constexpr double kMatched = 2;  // tells its key from the lattice's, whose first own number is 0 or 1
  const Key key = Key()
                      .add(commonKey(in, light))
                      .add(kMatched)
                      .add(in.settings.multipleSamples)
                      .add(in.settings.interpolation);
  return layer.update("multiple", key, in.frame, [&](size_t i, const Layer::Target& target) {
    if (in.frame.objects[i].translucent) shade({in, i, light}, target);
  });
}

}  // namespace lychnite
