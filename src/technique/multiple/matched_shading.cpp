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
  const auto texture = [&](const char* label, gpu::Format format, int width, int height) {
    return gpu::Texture({.label = label, .format = format, .width = width, .height = height});
  };
  const auto lists = [](int length) {
    Lists result{gpu::Buffer("matched, lists"), length};
    result.sites.resize(sizeof(ListsHeader) + size_t(kLists) * size_t(length) * sizeof(uint32_t));
    return result;
  };
  const int width = camera.width, height = camera.height,
            rows = std::min(height, std::max(1, kMostPixels / width));
  if (pixels_ && pixels_->listed.width() == width && pixels_->listed.height() == height) return;
  pixels_.reset();
  for (int l = 1; l < kLevels; ++l) {
    // A last row or column that is no whole block has no site; its pixels find fewer neighbours.
    const int w = std::max(1, width >> l), h = std::max(1, height >> l);
    levels_[size_t(l) - 1].reset();
    gpu::Texture value = texture("matched, values", gpu::Format::kRgba32f, w, h);
    gpu::Texture surface = texture("matched, surfaces", gpu::Format::kRgba32f, w, h);
    gpu::Framebuffer framebuffer({.label = "matched", .colours = {value, surface}, .depth = {}});
    levels_[size_t(l) - 1].emplace(Level{std::move(value), std::move(surface), std::move(framebuffer),
                                         lists(w * std::clamp(4 * kMostPixels / w, 1, h))});
  }
  // Last: it tells that all are there.
  pixels_.emplace(Pixels{texture("matched, listed", gpu::Format::kR32f, width, height),
                         texture("matched, evaluated", gpu::Format::kRgba32f, width, 4 * rows),
                         lists(4 * width * rows)});
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
  program.set("listLength", listsOf(level).length);
  program.set("anyLobe", level > 0);
  program.set("eta", target.in.frame.objects[target.object].medium.eta);
  program.set("piC", profile.piC);
}

void MultipleMatchedShading::plan(const Target& target, int level, const gpu::Framebuffer& framebuffer,
                                  const gpu::Rect& sites) {
  Lists& lists = listsOf(level);
  const ListsHeader empty{0, kGroupRows, 1};
  lists.sites.update(0, std::as_bytes(std::span(empty)));
  setSiteUniforms(plan_, target, level);
  target.in.maps.get(target.object, target.light).view.setUniforms(plan_);
  const bool hasCoarser = level + 1 < kLevels && target.in.settings.interpolation > 0;
  plan_.set("hasCoarser", hasCoarser);
  if (hasCoarser) {
    const Level& coarser = blocks(level + 1);
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
  plan_.setStorage("Sites", lists.sites);
  const gpu::Blend blend = level > 0 ? gpu::Blend::kNone : gpu::Blend::kAdd;
  gpu::Pass pass("matched, plan", framebuffer, {.blend = blend, .scissor = sites});
  pass.drawFullScreen(plan_);
}

void MultipleMatchedShading::evaluate(const Target& target, int level, int firstRow) {
  gpu::Buffer& sites = listsOf(level).sites;
  setUniforms(evaluate_, target.in, target.object, target.light);
  setSiteUniforms(evaluate_, target, level);
  evaluate_.setStorage("Sites", sites);
  evaluate_.setImage("evaluated", level > 0 ? blocks(level).value : pixels_->evaluated);
  evaluate_.set("firstRow", firstRow);
  gpu::dispatch("matched, evaluate", evaluate_, sites);
}

void MultipleMatchedShading::shadeBlocks(const Target& target, int level, const gpu::Rect& pixels) {
  Level& here = blocks(level);
  for (int colour : {0, 1}) here.framebuffer.clearColour(colour, {0, 0, 0, 0});
  const int most = here.lists.length / here.value.width();
  const int end = std::min(here.value.height(), ((pixels.y + pixels.height) >> level) + 2);
  for (int y = pixels.y >> level; y < end; y += most) {
    plan(target, level, here.framebuffer,
         {pixels.x >> level, y, (pixels.width >> level) + 2, std::min(most, end - y)});
    evaluate(target, level, y);
  }
}

void MultipleMatchedShading::shade(const Target& target, const Layer::Target& layer) {
  const gpu::Rect& all = layer.bounds;
  resize(target.in.frame.camera);
  for (int l = kLevels - 1; l > 0 && target.in.settings.interpolation > 0; --l) shadeBlocks(target, l, all);
  gpu::Framebuffer planned({.label = "matched", .colours = {layer.texture, pixels_->listed}, .depth = {}});
  planned.clearColour(1, {0, 0, 0, 0});
  const int most = pixels_->evaluated.height() / 4;
  for (int y = all.y; y < all.y + all.height; y += most) {
    const gpu::Rect band{all.x, y, all.width, std::min(most, all.y + all.height - y)};
    plan(target, 0, planned, band);
    evaluate(target, 0, y);
    gather_.setTexture("listed", pixels_->listed);
    gather_.setTexture("evaluated", pixels_->evaluated);
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
