#include <fmt/format.h>

#include <chrono>

#include "commands.h"
#include "lychnite/app/background.h"
#include "lychnite/app/image_maker.h"
#include "lychnite/app/report.h"
#include "lychnite/app/specs.h"
#include "lychnite/app/sweep.h"
#include "lychnite/base/atomic_file.h"
#include "lychnite/base/error.h"
#include "lychnite/base/text.h"
#include "lychnite/base/units.h"
#include "lychnite/image/io.h"
#include "lychnite/optics/materials.h"
#include "lychnite/scene/scene_file.h"
#include "terminal.h"

namespace lychnite::cli {
namespace {

namespace fs = std::filesystem;

/// The flags as typed; empty means "not given".
struct Flags {
  std::string model, size, material, sigma_s, sigma_a, rotate, camera, background, ambient, saveScene;
  std::vector<std::string> lights;
  std::string g, eta, roughness;
  std::string method, profile, components, aov, resolution = "600x600", samples, singleSamples, map;
  std::string exposure = "0", toneMap = "srgb", time;
  std::string noise, tolerance, interpolation, cells, collisions;
  std::string output, resume, stats, device = "auto";
  int bits = 8, threads = 0, frames = 1;
  bool transparent = false, verbose = false, debug = false, turntable = false;
  uint64_t seed = 1;
  std::string orbitLight, sizeFrom, sizeTo;
};

[[noreturn]] void usage(std::string where, std::string expected, std::string found, std::string todo = "") {
  throw Error({.where = std::move(where),
               .expected = std::move(expected),
               .found = std::move(found),
               .todo = std::move(todo)},
              Error::Kind::kUsage);
}

int wholeNumber(const std::string& text, const std::string& where) {
  const double value = parseNumber(text, where);
  if (value != std::floor(value) || std::abs(value) > 1e9)
    usage(where, "a whole number", fmt::format("'{}'", text));
  return int(value);
}

/// "2%" or "0.02".
double share(const std::string& text, const std::string& where) {
  if (!text.empty() && text.back() == '%') return parseNumber(text.substr(0, text.size() - 1), where) / 100;
  return parseNumber(text, where);
}

/// "60s", "2min" or "1h".
double duration(const std::string& text, const std::string& where) {
  for (const auto& [suffix, factor] : {std::pair("min", 60.0), std::pair("h", 3600.0), std::pair("s", 1.0)})
    if (text.size() > std::string_view(suffix).size() && text.ends_with(suffix))
      return factor * parseNumber(text.substr(0, text.size() - std::string_view(suffix).size()), where);
  usage(where, "a time with a unit (60s, 2min, 1h)", fmt::format("'{}'", text));
}

void applyMaterial(Material& material, const Flags& flags) {
  if (!flags.material.empty()) {
    material.name = flags.material;
    material.medium = findMaterial(flags.material, "--material").coefficients;
  } else if (!flags.sigma_s.empty()) {
    if (flags.sigma_a.empty())
      usage("--sigma-s", "--sigma-a as well (or a --material to start from)", "none");
    material.medium = {};
  }
  const Coefficients before = material.medium;
  if (!flags.sigma_s.empty()) material.medium.sigma_s = parseRgb(flags.sigma_s, "--sigma-s");
  if (!flags.sigma_a.empty()) material.medium.sigma_a = parseRgb(flags.sigma_a, "--sigma-a");
  if (!flags.g.empty()) material.medium.g = parseNumber(flags.g, "--g");
  if (!flags.eta.empty()) material.medium.eta = parseNumber(flags.eta, "--eta");
  validate(material.medium, "material");
  if (material.medium != before) material.name = "custom";
  if (!flags.roughness.empty()) material.roughness = parseNumber(flags.roughness, "--roughness");
}

bool changesObject(const Flags& flags) {
  for (const std::string* text : {&flags.size, &flags.material, &flags.sigma_s, &flags.sigma_a, &flags.g,
                                  &flags.eta, &flags.roughness, &flags.rotate})
    if (!text->empty()) return true;
  return false;
}

double sizeFrom(const std::string& text, const std::string& where) {
  const double size = parseLength(text, where);
  if (!(size > 0)) usage(where, "a length above zero", fmt::format("'{}'", text));
  return size;
}

void applyToObject(Object& object, const Flags& flags) {
  if (!flags.size.empty()) object.size = sizeFrom(flags.size, "--size");
  applyMaterial(object.material, flags);
  if (!flags.rotate.empty())
    object.rotation = glm::dquat(parseRgb(flags.rotate, "--rotate") * (3.14159265358979323846 / 180));
}

Scene baseScene(const Flags& flags, const LogSink& log) {
  if (flags.model.ends_with(".toml")) {
    Scene scene = readScene(flags.model, log);
    if (changesObject(flags) && scene.objects.size() != 1)
      usage("--size, --material, ...", "a scene of one object",
            fmt::format("{} in {}", scene.objects.size(), flags.model), "change them in the scene file");
    return scene;
  }
  Scene scene;
  scene.objects.push_back(loadObject(flags.model, ".", log));
  scene.objects.front().material.medium = findMaterial("marble", "--material").coefficients;
  if (flags.size.empty() && flags.sizeFrom.empty())
    usage("--size", "the object's true size, the longest side of its box (--size 20mm)", "none");
  scene.lights.push_back(ParallelLight{});
  return scene;
}

Scene sceneFromFlags(const Flags& flags, const LogSink& log) {
  Scene scene = baseScene(flags, log);
  if (scene.objects.size() == 1) applyToObject(scene.objects.front(), flags);
  if (!flags.lights.empty()) scene.lights.clear();
  for (const std::string& light : flags.lights) scene.lights.push_back(parseLight(light, "--light"));
  if (!flags.camera.empty()) scene.camera = parseCamera(flags.camera, "--camera");
  if (!flags.background.empty()) scene.background = parseRgb(flags.background, "--background");
  if (!flags.ambient.empty()) scene.ambient = parseRgb(flags.ambient, "--ambient");
  validate(scene);
  return scene;
}

RenderSettings settingsFromFlags(const Flags& flags) {
  RenderSettings settings;
  const Resolution resolution = parseResolution(flags.resolution, "--resolution");
  settings.width = resolution.width;
  settings.height = resolution.height;
  if (!flags.method.empty()) settings.method = parseMethod(flags.method, "--method");
  if (!flags.profile.empty()) settings.profile = parseProfileKind(flags.profile, "--profile");
  // What only light-space methods read asks for ours of them.
  const bool lightSpace = !flags.profile.empty() || !flags.map.empty() || !flags.interpolation.empty() ||
                          flags.device != "auto";
  if (flags.method.empty() && lightSpace) settings.method = Method::kMatched;
  if (!flags.components.empty()) settings.components = parseComponents(flags.components, "--components");
  if (!flags.aov.empty()) settings.aovs = split(flags.aov, ',');
  if (!flags.map.empty()) settings.mapSize = settings.mostMapSize = wholeNumber(flags.map, "--map");
  if (!flags.samples.empty()) {
    const Method method = resolved(settings);
    if (method == Method::kWalk)
      settings.samples = parseNumber(flags.samples, "--samples");
    else if (method == Method::kVolume)
      settings.passes = wholeNumber(flags.samples, "--samples");
    else if (method == Method::kMatched)
      settings.multipleSamples = wholeNumber(flags.samples, "--samples");
    else
      settings.singleSamples = wholeNumber(flags.samples, "--samples");
  }
  if (!flags.singleSamples.empty())
    settings.singleSamples = wholeNumber(flags.singleSamples, "--single-samples");
  if (!flags.cells.empty() && flags.cells != "auto") {
    settings.cells = wholeNumber(flags.cells, "--cells");
    if (settings.cells == 0) usage("--cells", "8 to 192, or auto", "'0'");
  }
  if (!flags.collisions.empty()) settings.collisions = wholeNumber(flags.collisions, "--collisions");
  if (!flags.interpolation.empty()) settings.interpolation = share(flags.interpolation, "--interpolation");
  if (!flags.tolerance.empty()) settings.tolerance = share(flags.tolerance, "--tolerance");
  if (!flags.noise.empty()) settings.noise = share(flags.noise, "--noise");
  if (!flags.time.empty()) settings.timeLimit = duration(flags.time, "--time");
  settings.seed = flags.seed;
  settings.threads = flags.threads;
  validate(settings);
  return settings;
}

Sweep sweepFromFlags(const Flags& flags) {
  Sweep sweep{.frames = flags.frames};
  if (!flags.orbitLight.empty()) sweep.orbitLightDegrees = parseNumber(flags.orbitLight, "--orbit-light");
  if (flags.turntable) sweep.turntableDegrees = 360;
  if (!flags.sizeFrom.empty()) sweep.sizeFrom = sizeFrom(flags.sizeFrom, "--size-from");
  if (!flags.sizeTo.empty()) sweep.sizeTo = sizeFrom(flags.sizeTo, "--size-to");
  validate(sweep);
  return sweep;
}

bool isExr(const fs::path& path) {
  return path.extension() == ".exr";
}

/// Refuses a path that nothing can be written to, so that this is said before the work and not after it.
void checkWritable(const fs::path& path) {
  std::error_code code;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, code))
    throw Error({.where = path.string(),
                 .expected = "",
                 .found = fmt::format("there is no folder '{}'", folder.string()),
                 .todo = "make it first"});
  if (fs::is_directory(path, code))
    throw Error(
        {.where = path.string(), .expected = "a file name to write to", .found = "a folder", .todo = ""});
}

void checkOutputs(const Flags& flags) {
  const fs::path path = flags.output;
  if (path.extension() != ".png" && path.extension() != ".exr")
    usage("-o", "a file ending in .png or .exr", fmt::format("'{}'", path.string()));
  checkWritable(path);
  for (const std::string& other : {flags.stats, flags.saveScene})
    if (!other.empty()) checkWritable(other);
}

void write(Image& image, const fs::path& path, const Flags& flags) {
  savePicture(image, path,
              {.toneMapping = {.curve = parseToneCurve(flags.toneMap, "--tone-map"),
                               .exposure = parseNumber(flags.exposure, "--exposure")},
               .bits = flags.bits,
               .alpha = flags.transparent});
}

/// The part that frame `index` of `frames` is of the whole, reported to `whole`.
Progress frameProgress(const Progress& whole, int index, int frames) {
  if (frames == 1) return whole;
  return Progress([=](const Progress::Update& update) {
    return whole.update({.what = "frames",
                         .fraction = (index + update.fraction) / frames,
                         .detail = fmt::format("{}/{}", index + 1, frames)});
  });
}

/// The picture that --resume goes on from; an empty one without the flag.
Image resumed(const Flags& flags, const Scene& scene, const RenderSettings& settings) {
  if (flags.resume.empty()) return {};
  if (settings.method != Method::kWalk || flags.frames != 1)
    usage("--resume", "one picture by --method walk", "another");
  Image image = readImage(flags.resume);
  const auto made = image.metadata.find("scene");
  if (made == image.metadata.end() || made->second != sceneToToml(scene))
    throw Error(
        {.where = flags.resume,
         .expected = "a walk of this very scene",
         .found = made == image.metadata.end() ? "a picture of another origin" : "one of another scene",
         .todo = "render with the flags it was made with"});
  return image;
}

int render(const Flags& flags) {
  const LogSink log = terminalLog(flags.verbose);
  const RenderSettings settings = settingsFromFlags(flags);
  const Sweep sweep = sweepFromFlags(flags);
  checkOutputs(flags);
  parseToneCurve(flags.toneMap, "--tone-map");
  parseNumber(flags.exposure, "--exposure");
  const Scene scene = sceneFromFlags(flags, log);
  if (!flags.saveScene.empty()) writeScene(scene, flags.saveScene);
  const Image before = resumed(flags, scene, settings);
  // What going on needs is kept in every EXR of the walk: an interruption is not foreseen.
  const ReferenceOptions walk{.resume = before.empty() ? nullptr : &before, .keepState = isExr(flags.output)};
  ImageMaker maker({.device = flags.device, .debug = flags.debug, .log = log});
  const Progress progress = terminalProgress();
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < sweep.frames; ++i) {
    const Progress frame = frameProgress(progress, i, sweep.frames);
    frame.check({.what = "frames"});
    Image image = maker.render(sceneAt(scene, sweep, i), settings, frame, walk);
    finishProgress();
    const fs::path output =
        sweep.frames > 1 ? numbered(flags.output, i, sweep.frames) : fs::path(flags.output);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const std::string stats = statsJson(image, settings, maker.stats(), seconds);
    write(image, output, flags);
    if (!flags.stats.empty()) writeTextAtomically(flags.stats, stats);
    if (image.metadata.contains("interrupted")) {
      fmt::print(stderr, "lychnite: interrupted; {} holds what there was\n", output.string());
      return 130;
    }
  }
  return 0;
}

void addSceneFlags(CLI::App& command, Flags& flags) {
  command
      .add_option("MODEL", flags.model,
                  "mesh file (PLY, OBJ, STL, OFF, 3DS, glTF, GLB), built-in model, or scene.toml")
      ->required();
  command.add_option("--size", flags.size,
                     "true size: longest side of the bounding box, with a unit (20mm, 3cm, 1in)");
  command.add_option("--material", flags.material, "a name from `lychnite materials` (default marble)");
  command.add_option("--sigma-s", flags.sigma_s, "scattering coefficient R,G,B in 1/mm");
  command.add_option("--sigma-a", flags.sigma_a, "absorption coefficient R,G,B in 1/mm");
  command.add_option("--g", flags.g, "mean cosine of scattering, -1 to 1");
  command.add_option("--eta", flags.eta, "refractive index, inside over outside");
  command.add_option("--roughness", flags.roughness, "of the coat, 0.02 to 1 (default 0.3)");
  command.add_option("--rotate", flags.rotate, "X,Y,Z in degrees");
  command.add_option("--light", flags.lights, "parallel:AZ,EL[,E] or point:X,Y,Z[,I]; may be repeated")
      ->allow_extra_args(false);
  command.add_option("--camera", flags.camera,
                     "orbit:AZ,EL[,FACTOR[,FOV]] or pinhole:PX,PY,PZ,TX,TY,TZ[,FOV]");
  command.add_option("--background", flags.background, "R,G,B radiance (default 0)");
  command.add_option("--ambient", flags.ambient, "R,G,B radiance of a uniform surrounding (default 0)");
  command.add_option("--save-scene", flags.saveScene, "also write the scene as TOML");
}

void addMethodFlags(CLI::App& command, Flags& flags) {
  command.add_option("--method", flags.method,
                     "matched, adaptive, fixed, volume, dipole, hierarchical or walk (default: volume where "
                     "every object has an inside, else matched; matched with --profile, --map, "
                     "--interpolation or --device)");
  command.add_option("--profile", flags.profile,
                     "dipole (default), better-dipole, normalized-diffusion or tabulated");
  command.add_option("--components", flags.components, "any of multiple,single,surface (default all)");
  command.add_option("--samples", flags.samples,
                     "matched: samples a pixel that faces the light, 8 to 128 (24); volume: passes of "
                     "photons (6); walk: photons per "
                     "pixel (16); adaptive, fixed: single-scattering samples (8)");
  command.add_option(
      "--cells", flags.cells,
      "volume: cells along an object's longest side, 8 to 192 (auto: 64, or 96 where an object is "
      "longer than 64 of its mean free paths)");
  command.add_option("--collisions", flags.collisions,
                     "volume: collisions traced before the diffusion equation takes over, 1 to 64 (6)");
  command.add_option("--single-samples", flags.singleSamples,
                     "single-scattering samples along the refracted ray (8)");
  command.add_option(
      "--map", flags.map,
      "light-space map size, 128 to 4096 (512; matched: up to 2048 where the mean free path is short)");
  command.add_option("--interpolation", flags.interpolation,
                     "matched: interpolate where neighbours differ less (8%; 0 evaluates every pixel)");
  command.add_option("--tolerance", flags.tolerance, "dipole: relative error to refine to (0.5%)");
  command.add_option("--time", flags.time, "walk, volume: stop after this time (60s, 2min)");
  command.add_option("--noise", flags.noise, "walk, volume: stop at this relative noise (2%)");
  command.add_option("--resume", flags.resume, "walk: go on from this EXR of the same scene");
  command.add_option("--seed", flags.seed, "of the random numbers (1)")->check(CLI::NonNegativeNumber);
  command.add_option("--threads", flags.threads, "CPU threads, 0 = all cores");
  command.add_option("--device", flags.device, "auto, gpu, cpu or a number from `lychnite devices`");
  command.add_flag("--debug", flags.debug, "OpenGL debug context; its errors are failures");
}

void addOutputFlags(CLI::App& command, Flags& flags) {
  command.add_option("--resolution", flags.resolution, "WxH (600x600)");
  command.add_option("--exposure", flags.exposure, "stops, for PNG (0)");
  command.add_option("--tone-map", flags.toneMap, "srgb (default) or filmic, for PNG");
  command.add_option("--bits", flags.bits, "of a PNG channel, 8 or 16")->check(CLI::IsMember({8, 16}));
  command.add_flag("--transparent", flags.transparent, "PNG with alpha instead of over the background");
  command.add_option("--aov", flags.aov,
                     "EXR layers: multiple,single,surface,depth,normal,lights,radiosity,stderr");
  command.add_option("--stats", flags.stats, "write timings, device and counts as JSON");
  command.add_option("-o,--output", flags.output, "FILE.png or FILE.exr")->required();
  command.add_option("--frames", flags.frames, "write this many numbered pictures");
  command.add_option("--orbit-light", flags.orbitLight, "degrees the lights turn over all frames");
  command.add_flag("--turntable", flags.turntable, "turn the objects once over all frames");
  command.add_option("--size-from", flags.sizeFrom, "size of the first frame");
  command.add_option("--size-to", flags.sizeTo, "size of the last frame");
  command.add_flag("--verbose", flags.verbose, "say what loading repaired and more");
}

}  // namespace

void addRender(CLI::App& app, Action& action) {
  auto flags = std::make_shared<Flags>();
  CLI::App* command = app.add_subcommand("render", "Render a model or scene to a picture");
  addSceneFlags(*command, *flags);
  addMethodFlags(*command, *flags);
  addOutputFlags(*command, *flags);
  command->callback([flags, &action] { action = [flags] { return render(*flags); }; });
}

}  // namespace lychnite::cli
