#include "technique/multiple/sample_view.h"

#include "gpu/pass.h"

namespace lychnite {
namespace {

constexpr int kLatticeCells = 49;

gpu::Program& made(std::optional<gpu::Program>& program, const char* fragment, gpu::ShaderDefines defines) {
  if (!program) {
    gpu::ProgramDesc desc{.label = "samples", .vertex = "pass/full_screen.vert", .fragment = fragment};
    desc.defines = std::move(defines);
    program.emplace(desc);
  }
  return *program;
}

}  // namespace

SampleView::Row& SampleView::row(int samples) {
  if (row_ && row_->place.width() == samples + 1) return *row_;
  row_.reset();
  const auto texture = [&](const char* label) {
    return gpu::Texture({.label = label, .format = gpu::Format::kRgba32f, .width = samples + 1, .height = 1});
  };
  gpu::Texture place = texture("samples' places"), share = texture("samples' shares");
  gpu::Framebuffer framebuffer({.label = "samples", .colours = {place, share}, .depth = {}});
  row_.emplace(Row{std::move(place), std::move(share), std::move(framebuffer)});
  return *row_;
}

std::optional<SeenSamples> SampleView::draw(gpu::Program& program, const ShadingInputs& in, int samples,
                                            const glm::ivec2& pixel, size_t object, size_t light) {
  Row& target = row(samples);
  setReceiverUniforms(program, in.frame, in.geometry.samples(), object);
  program.set("pixel", pixel);
  {
    gpu::Pass pass("samples", target.framebuffer);
    pass.drawFullScreen(program);
  }
  const std::vector<float> place = target.place.download(), share = target.share.download();
  const Frame& frame = in.frame;
  const auto vector = [](const std::vector<float>& texels, int i) {
    return glm::dvec3(texels[size_t(i) * 4], texels[size_t(i) * 4 + 1], texels[size_t(i) * 4 + 2]);
  };
  const auto last = [&](const std::vector<float>& texels, int i) {
    return double(texels[size_t(i) * 4 + 3]);
  };
  SeenSamples seen;
  seen.object = object;
  seen.receivers = int(last(place, samples));
  if (seen.receivers == 0) return {};
  seen.receiver = frame.origin + vector(place, samples) * frame.unit;
  seen.radiosity = vector(share, samples);
  const LightView& view = in.maps.get(object, light).view;
  seen.receiverUv = glm::dvec2(view.project(vector(place, samples)));
  for (int i = 0; i < samples; ++i) {
    SeenSample sample{.uv = glm::dvec2(vector(place, i)),
                      .level = vector(place, i).z,
                      .width = last(place, i),
                      .radiosity = vector(share, i),
                      .depth = last(share, i)};
    if (sample.width == 0) continue;  // the pattern has fewer here
    const glm::dvec3 at = view.unproject(sample.uv, sample.depth);
    const glm::dvec3 beside = view.unproject(sample.uv + glm::dvec2(sample.width, 0), sample.depth);
    sample.position = frame.origin + at * frame.unit;
    sample.side = glm::distance(at, beside) * frame.unit;
    seen.samples.push_back(sample);
  }
  return seen;
}

std::optional<SeenSamples> SampleView::at(const ShadingInputs& in, MultipleMatchedShading& sampler,
                                          const glm::ivec2& pixel, size_t light) {
  gpu::Program& program = made(matched_, "pass/matched_samples.frag", MultipleMatchedShading::defines());
  for (size_t i = 0; i < in.frame.objects.size(); ++i) {
    if (!in.frame.objects[i].translucent) continue;
    sampler.setUniforms(program, in, i, light);
    const int most = in.settings.multipleSamples << MultipleMatchedShading::kMostRefinement;
    if (auto seen = draw(program, in, most, pixel, i, light)) return seen;
  }
  return {};
}

std::optional<SeenSamples> SampleView::at(const ShadingInputs& in, MultipleLatticeShading& sampler,
                                          const glm::ivec2& pixel, size_t light) {
  const bool fixed = in.settings.method == Method::kFixed;
  gpu::Program& program =
      made(fixed ? fixed_ : adaptive_, "pass/lattice_samples.frag", {{"LAYOUT", fixed ? "5" : "2"}});
  for (size_t i = 0; i < in.frame.objects.size(); ++i) {
    if (!in.frame.objects[i].translucent) continue;
    sampler.setUniforms(program, in, i, light);
    if (auto seen = draw(program, in, kLatticeCells, pixel, i, light)) return seen;
  }
  return {};
}

}  // namespace lychnite
