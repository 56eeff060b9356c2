#include "lychnite/app/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>
#include <variant>

#include "lychnite/app/scene_moves.h"
#include "lychnite/base/error.h"
#include "lychnite/image/io.h"
#include "lychnite/mesh/builtin.h"
#include "lychnite/scene/scene_file.h"

namespace lychnite {
namespace fs = std::filesystem;

/// Messages may come from the thread that loads.
struct SessionMessages {
  std::mutex mutex;
  std::vector<SessionMessage> list;
  void add(std::string text, bool problem) {
    const std::lock_guard lock(mutex);
    list.push_back({std::move(text), problem});
  }
};

struct Session::Loading {
  std::string path;
  bool reload = false;
  std::future<std::variant<Object, Scene, Image>> result;
};

namespace {

constexpr double kLookEvery = 0.5;  // seconds between two looks at the watched files

bool isPicture(const fs::path& path) {
  return path.extension() == ".exr" || path.extension() == ".png";
}

bool isBuiltin(const std::string& name) {
  for (const BuiltinModel& model : builtinModels())
    if (model.name == name) return true;
  return false;
}

fs::file_time_type timeOf(const fs::path& path) {
  std::error_code code;
  const auto time = fs::last_write_time(path, code);
  return code ? fs::file_time_type{} : time;
}

std::variant<Object, Scene, Image> load(const std::string& path, const LogSink& log) {
  if (isPicture(path)) return readImage(path);
  if (fs::path(path).extension() != ".toml") {
    Object object = loadObject(path, ".", log);
    if (!isBuiltin(path)) object.model = fs::absolute(path).string();
    return object;
  }
  Scene scene = readScene(path, log);
  validate(scene);
  for (Object& object : scene.objects)
    if (!isBuiltin(object.model))
      object.model = (fs::absolute(path).parent_path() / object.model).lexically_normal().string();
  return scene;
}

/// "figurine.toml", or "figurine-2.toml" where that is taken, also by a file still to be written.
fs::path freeName(const fs::path& folder, const std::string& stem, const std::string& extension,
                  const std::set<fs::path>& promised = {}) {
  std::error_code code;
  fs::path path = folder / (stem + extension);
  for (int i = 2; fs::exists(path, code) || promised.contains(path); ++i)
    path = folder / fmt::format("{}-{}{}", stem, i, extension);
  return path;
}

}  // namespace

Session::Session(std::string device)
    : device_(std::move(device)), messages_(std::make_shared<SessionMessages>()) {}

Session::~Session() = default;

LogSink Session::log() {
  return [messages = messages_](LogLevel level, std::string_view text) {
    if (level == LogLevel::kWarning) messages->add(std::string(text), true);
  };
}

void Session::say(std::string text, bool problem) {
  messages_->add(std::move(text), problem);
}

std::vector<SessionMessage> Session::takeMessages() {
  const std::lock_guard lock(messages_->mutex);
  return std::exchange(messages_->list, {});
}

void Session::commit() {
  if (empty()) return;
  if (history_)
    history_->record(state_);
  else
    history_ = std::make_unique<History>(state_);
}

void Session::undo() {
  commit();
  if (!canUndo()) return;
  state_ = history_->undo();
  watch();
}

void Session::redo() {
  if (!canRedo()) return;
  state_ = history_->redo();
  watch();
}

void Session::open(const std::string& path) {
  if (loading_)
    queue_.emplace_back(path, false);
  else
    startLoading(path, false);
}

void Session::startLoading(const std::string& path, bool reload) {
  loading_ = std::make_unique<Loading>(Loading{path, reload, {}});
  loading_->result = std::async(std::launch::async, load, path, log());
}

bool Session::loading() const {
  return loading_ != nullptr;
}

bool Session::poll(double seconds) {
  while (const auto outcome = pictures_.takeOutcome()) {
    promised_.erase(outcome->output);
    if (outcome->problem.empty())
      say(fmt::format("Wrote {}", outcome->output.string()));
    else
      say(fmt::format("{} was not written: {}", outcome->output.string(), outcome->problem), true);
  }
  bool changed = false;
  if (loading_ && loading_->result.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    const std::unique_ptr<Loading> done = std::move(loading_);
    take(*done);
    changed = true;
  }
  if (!loading_ && !queue_.empty()) {
    const auto [path, reload] = queue_.front();
    queue_.erase(queue_.begin());
    startLoading(path, reload);
  }
  lookAtFiles(seconds);
  return changed;
}

void Session::finishLoading() {
  while (loading_ || !queue_.empty()) {
    if (loading_) loading_->result.wait();
    poll(lastLook_);
  }
}

void Session::take(Loading& done) {
  try {
    if (isPicture(done.path)) {
      picture_ = std::make_shared<const Image>(std::get<Image>(done.result.get()));
      pictureName_ = fs::path(done.path).filename().string();
      commit();
      state_.compare = {.mode = CompareView::Mode::kWipe, .right = CompareView::Source::kFile};
      say(fmt::format("{}: {} x {}, to compare with", pictureName_, picture_->width(), picture_->height()));
    } else if (fs::path(done.path).extension() == ".toml") {
      takeScene(done);
    } else {
      takeObject(done);
    }
    if (done.reload) say(fmt::format("{} changed and was loaded again", done.path));
    watch();
  } catch (const std::exception& error) {
    say(error.what(), true);
  }
}

void Session::takeObject(Loading& done) {
  const Object object = std::get<Object>(done.result.get());
  commit();
  if (done.reload) {
    for (Object& each : state_.scene.objects) {
      if (each.model != object.model) continue;
      each.mesh = object.mesh;
      each.animation = object.animation;
      const bool still = object.animation && clipOf(object) && clipOf(each)->name == each.clip;
      const auto [clip, time] = std::pair(each.clip, each.time);
      setPose(each, "", 0);
      if (still) setPose(each, clip, time);
    }
  } else if (empty()) {
    state_ = defaultView(object);
  } else {
    // The new model takes the old one's place: same size, material and light.
    Object next = object;
    const Object& subject = state_.scene.objects[subjectIndex(state_.scene)];
    next.material = subject.material;
    next.size = subject.size;
    state_.scene.objects = {next};
    state_.scene.camera = OrbitCamera{.azimuth = 8, .elevation = 9, .factor = 1.15};
  }
  if (!done.reload) {
    documentName_ = fs::path(done.path).filename().string();
    scenePath_.clear();
    if (object.animation)
      say(fmt::format("{}: {} animation{}, P plays", documentName_, object.animation->clips().size(),
                      object.animation->clips().size() > 1 ? "s" : ""));
  }
  commit();
}

void Session::takeScene(Loading& done) {
  Scene scene = std::get<Scene>(done.result.get());
  commit();
  state_.scene = std::move(scene);
  documentName_ = fs::path(done.path).filename().string();
  scenePath_ = fs::absolute(done.path);
  commit();
}

void Session::watch() {
  std::vector<fs::path> files;
  if (!scenePath_.empty()) files.push_back(scenePath_);
  for (const Object& object : state_.scene.objects)
    if (!isBuiltin(object.model)) files.emplace_back(object.model);
  std::erase_if(watched_, [&](const Watched& w) {
    return std::find(files.begin(), files.end(), w.path) == files.end();
  });
  for (const fs::path& file : files) {
    const auto same = [&](const Watched& w) { return w.path == file; };
    if (std::none_of(watched_.begin(), watched_.end(), same)) watched_.push_back({file, timeOf(file)});
  }
}

void Session::lookAtFiles(double seconds) {
  if (seconds - lastLook_ < kLookEvery) return;
  lastLook_ = seconds;
  for (Watched& file : watched_) {
    const auto time = timeOf(file.path);
    // A file that is gone may be on its way back: editors write anew and rename.
    if (time == file.time || time == fs::file_time_type{}) continue;
    file.time = time;
    queue_.emplace_back(file.path.string(), true);
  }
}

/// Models by their place relative to the scene file where they lie below it.
Scene Session::sceneForFile(const fs::path& path) const {
  Scene scene = state_.scene;
  const fs::path folder = fs::absolute(path).parent_path();
  for (Object& object : scene.objects) {
    if (isBuiltin(object.model)) continue;
    const fs::path relative = fs::path(object.model).lexically_relative(folder);
    if (!relative.empty() && *relative.begin() != "..") object.model = relative.string();
  }
  return scene;
}

fs::path Session::saveScene() {
  if (!scenePath_.empty()) return saveSceneAs(scenePath_);
  const std::string stem = documentName_.empty() ? "scene" : fs::path(documentName_).stem().string();
  return saveSceneAs(freeName(fs::current_path(), stem, ".toml"));
}

fs::path Session::saveSceneAs(const fs::path& path) {
  if (empty()) return {};
  try {
    writeScene(sceneForFile(path), path);
  } catch (const std::exception& error) {
    say(error.what(), true);
    return {};
  }
  scenePath_ = fs::absolute(path);
  std::erase_if(watched_, [&](const Watched& w) { return w.path == scenePath_; });
  watch();
  say(fmt::format("Saved {}", path.string()));
  return path;
}

void Session::savePicture(int width, int height, fs::path path, const std::string& extension) {
  if (empty()) return;
  if (path.empty()) {
    const std::string stem = documentName_.empty() ? "picture" : fs::path(documentName_).stem().string();
    path = freeName(scenePath_.empty() ? fs::current_path() : scenePath_.parent_path(), stem, extension,
                    promised_);
  }
  promised_.insert(path);
  PictureRequest request{.scene = scenePath_.empty() ? state_.scene : sceneForFile(scenePath_),
                         .settings = state_.settings,
                         .png = {.toneMapping = state_.toneMapping},
                         .output = path,
                         .device = device_};
  request.settings.width = width;
  request.settings.height = height;
  pictures_.start(std::move(request));
}

}  // namespace lychnite
