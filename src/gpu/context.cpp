#include "lychnite/gpu/context.h"

#include <epoxy/gl.h>

#include <cassert>
#include <charconv>
#include <utility>

#include "gpu/context_state.h"
#include "gpu/object.h"
#include "lychnite/base/error.h"

namespace lychnite::gpu {
namespace {

thread_local std::shared_ptr<ContextState> currentOnThread;

struct Opened {
  EglContext egl;
  DeviceInfo info;
};

[[noreturn]] void throwNoDevice(const std::string& wanted, const std::string& found) {
  throw Error({.where = "OpenGL",
               .expected = wanted + " with desktop OpenGL 4.5 core through EGL",
               .found = found,
               .todo = "install a driver (Debian, Ubuntu: libegl1 libopengl0 libgl1-mesa-dri); "
                       "`lychnite devices` lists what there is"},
              Error::Kind::kDevice);
}

std::string problemsOf(const std::vector<DeviceInfo>& tried) {
  if (tried.empty()) return "no EGL device and no surfaceless platform (no EGL driver is installed)";
  std::string text;
  for (const DeviceInfo& info : tried) {
    if (!text.empty()) text += ", ";
    text += "device " + std::to_string(info.index) + ": " + (info.usable ? info.renderer : info.problem);
  }
  return text;
}

Opened openIndex(const std::vector<EglCandidate>& all, int index, bool debug) {
  if (all.empty()) throwNoDevice("a device", problemsOf({}));
  if (index < 0 || index >= static_cast<int>(all.size()))
    throw Error({.where = "device",
                 .expected = "an index from 0 to " + std::to_string(all.size() - 1),
                 .found = std::to_string(index),
                 .todo = "`lychnite devices` lists them"},
                Error::Kind::kUsage);
  Opened opened;
  opened.egl = openContext(all[index], debug, opened.info);
  if (!opened.info.usable) throwNoDevice("device " + std::to_string(index), opened.info.problem);
  return opened;
}

/// The first GPU, else (when `software` is allowed) the first software driver; only the latter unless
/// `hardware`.
Opened openBest(const std::vector<EglCandidate>& all, bool hardware, bool software, bool debug) {
  Opened best;
  std::vector<DeviceInfo> tried;
  for (const EglCandidate& candidate : all) {
    Opened opened;
    opened.egl = openContext(candidate, debug, opened.info);
    tried.push_back(opened.info);
    const bool wanted = opened.info.usable && (opened.info.software ? software : hardware);
    if (wanted && (!best.info.usable || (best.info.software && !opened.info.software)))
      std::swap(best, opened);
    opened.egl.close();
    if (best.info.usable && best.info.software == !hardware) break;
  }
  if (!best.info.usable)
    throwNoDevice(!software ? "a GPU" : !hardware ? "a software driver" : "a device", problemsOf(tried));
  return best;
}

Opened openDevice(const std::string& device, bool debug) {
  int index = 0;
  const auto [end, error] = std::from_chars(device.data(), device.data() + device.size(), index);
  const bool isIndex = error == std::errc() && end == device.data() + device.size();
  if (!isIndex && device != "auto" && device != "gpu" && device != "cpu")
    throw Error({.where = "device",
                 .expected = "auto, gpu, cpu or an index",
                 .found = "'" + device + "'",
                 .todo = "`lychnite devices` lists them"},
                Error::Kind::kUsage);
  const std::string missing = missingLibraries();
  if (!missing.empty()) throwNoDevice("a device", missing);
  const CurrentKeeper keeper;  // a failed attempt leaves the caller's context current
  const std::vector<EglCandidate> all = candidates();
  return isIndex ? openIndex(all, index, debug) : openBest(all, device != "cpu", device != "gpu", debug);
}

void onMessage(GLenum source, GLenum type, GLuint, GLenum severity, GLsizei length, const GLchar* text,
               const void* user) {
  auto& state = *static_cast<ContextState*>(const_cast<void*>(user));
  const std::string message = length < 0 ? std::string(text) : std::string(text, static_cast<size_t>(length));
  // What the shader compiler says reaches the user through Program's Error.
  if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return;
  if (type == GL_DEBUG_TYPE_ERROR) {
    if (state.firstError.empty()) state.firstError = message;
  } else if (severity != GL_DEBUG_SEVERITY_NOTIFICATION) {
    logTo(state.log, LogLevel::kDebug, message);
  }
}

const char* errorName(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    case GL_CONTEXT_LOST:
      return "GL_CONTEXT_LOST";
    default:
      return "an unknown OpenGL error";
  }
}

void prepare(ContextState& state) {
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &state.maxTextureSize);
  glGetIntegerv(GL_MAX_SAMPLES, &state.maxSamples);
  glCreateVertexArrays(1, &state.emptyVertexArray);
  if (!state.debug) return;
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(onMessage, &state);
}

}  // namespace

const std::shared_ptr<ContextState>& currentState() {
  assert(currentOnThread && "no gpu::Context is current on this thread");
  return currentOnThread;
}

std::string takeError(ContextState& state) {
  std::string text = std::exchange(state.firstError, {});
  // A lost context may report its error for ever; an intact one has at most a handful of flags.
  for (int i = 0; i < 16; ++i) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) break;
    if (text.empty()) text = errorName(error);
  }
  return text;
}

CurrentGuard::CurrentGuard(const ContextState& state) {
  if (eglGetCurrentContext() == state.egl.context) return;
  before_ = std::make_unique<CurrentKeeper>();
  state.egl.makeCurrent();
}

CurrentGuard::~CurrentGuard() = default;

size_t allocatedBytes() {
  return currentState()->allocatedBytes;
}
int maxTextureSize() {
  return currentState()->maxTextureSize;
}
int maxSamples() {
  return currentState()->maxSamples;
}

std::vector<DeviceInfo> listDevices() {
  std::vector<DeviceInfo> list;
  if (!missingLibraries().empty()) return list;
  const CurrentKeeper keeper;
  for (const EglCandidate& candidate : candidates()) {
    DeviceInfo info;
    openContext(candidate, false, info).close();
    list.push_back(info);
  }
  return list;
}

struct Context::Impl {
  /// The driver's context is ours, a window's, or already wrapped by an older Context.
  enum class Hold { kOwns, kBorrows, kShares };

  void wrapCurrent(const ContextOptions& options, LogSink log);

  std::shared_ptr<ContextState> state = std::make_shared<ContextState>();
  DeviceInfo info;
  Hold hold = Hold::kOwns;
};

void Context::Impl::wrapCurrent(const ContextOptions& options, LogSink log) {
  const std::string missing = missingLibraries();
  if (!missing.empty() || eglGetCurrentContext() == EGL_NO_CONTEXT)
    throwNoDevice("a window", missing.empty() ? "no EGL context that is current" : missing);
  info = describeCurrent();
  if (!info.usable) throwNoDevice("a window", info.problem);
  if (currentOnThread && currentOnThread->alive && currentOnThread->egl.context == eglGetCurrentContext()) {
    state = currentOnThread;
    hold = Hold::kShares;
    return;
  }
  hold = Hold::kBorrows;
  state->egl = {eglGetCurrentDisplay(), eglGetCurrentContext(), eglGetCurrentSurface(EGL_DRAW)};
  state->debug = options.debug;
  state->log = std::move(log);
  currentOnThread = state;
  prepare(*state);
}

Context::Context(const ContextOptions& options, LogSink log) : impl_(std::make_unique<Impl>()) {
  if (options.current) {
    impl_->wrapCurrent(options, std::move(log));
    return;
  }
  Opened opened = openDevice(options.device, options.debug);
  impl_->info = std::move(opened.info);
  impl_->state->egl = opened.egl;
  impl_->state->debug = options.debug;
  impl_->state->log = std::move(log);
  makeCurrent();
  prepare(*impl_->state);
  logTo(impl_->state->log, LogLevel::kInfo,
        "OpenGL " + impl_->info.version + " on " + impl_->info.renderer + " (" + impl_->info.vendor + ")");
}

Context::~Context() {
  if (impl_->hold == Impl::Hold::kShares) return;
  impl_->state->alive = false;
  if (impl_->hold == Impl::Hold::kOwns)
    impl_->state->egl.close();
  else if (eglGetCurrentContext() == impl_->state->egl.context)
    glDebugMessageCallback(nullptr, nullptr);
  if (currentOnThread == impl_->state) currentOnThread.reset();
}

void Context::makeCurrent() {
  // Asking for what is current already would still flush a window's frame.
  const bool already = eglGetCurrentContext() == impl_->state->egl.context;
  if (!already && !impl_->state->egl.makeCurrent())
    throw Error({.where = "OpenGL",
                 .expected = "a context that no other thread uses",
                 .found = "one that cannot be made current",
                 .todo = ""},
                Error::Kind::kDevice);
  currentOnThread = impl_->state;
}

const DeviceInfo& Context::device() const {
  return impl_->info;
}

void Context::finish() {
  const CurrentGuard guard(*impl_->state);
  glFinish();
}

size_t Context::allocatedBytes() const {
  return impl_->state->allocatedBytes;
}

void Context::checkErrors(const char* where) {
  const CurrentGuard guard(*impl_->state);
  if (glGetGraphicsResetStatus() != GL_NO_ERROR)
    throw Error({.where = where,
                 .expected = "",
                 .found = "the graphics device was reset (" + impl_->info.renderer + ")",
                 .todo = "start again; if it stays, try --device cpu"},
                Error::Kind::kDevice);
  const std::string error = takeError(*impl_->state);
  if (!error.empty())
    throw Error({.where = where,
                 .expected = "",
                 .found = "OpenGL reported " + error + " (" + impl_->info.renderer + ")",
                 .todo = ""},
                Error::Kind::kDevice);
}

}  // namespace lychnite::gpu
