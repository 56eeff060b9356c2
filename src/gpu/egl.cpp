#include "gpu/egl.h"

#include <dlfcn.h>
#include <epoxy/gl.h>

#include <array>
#include <cstdio>
#include <string_view>

namespace lychnite::gpu {
namespace {

bool canLoad(const char* library) {
  void* handle = dlopen(library, RTLD_LAZY | RTLD_LOCAL);
  if (handle) dlclose(handle);
  return handle != nullptr;
}

bool hasExtension(EGLDisplay display, const char* name) {
  const char* all = eglQueryString(display, EGL_EXTENSIONS);
  return all && epoxy_extension_in_string(all, name);
}

std::string eglFailure(const char* call) {
  char code[16];
  std::snprintf(code, sizeof code, "0x%04x", static_cast<unsigned>(eglGetError()));
  return std::string(call) + " failed (" + code + ")";
}

EGLDisplay displayOf(const EglCandidate& candidate) {
  // Asked for by name: epoxy's own check depends on which display is current.
  const auto get =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  return get ? get(candidate.platform, candidate.nativeDisplay, nullptr) : EGL_NO_DISPLAY;
}

EGLConfig pbufferConfig(EGLDisplay display) {
  const std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                     EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display, wanted.data(), &config, 1, &count) || count == 0) return nullptr;
  return config;
}

EGLContext createContext(EGLDisplay display, EGLConfig config, bool egl15, bool debug) {
  std::vector<EGLint> attributes{EGL_CONTEXT_MAJOR_VERSION,       4,
                                 EGL_CONTEXT_MINOR_VERSION,       5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
  if (debug && egl15) attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE});
  if (debug && !egl15)
    attributes.insert(attributes.end(), {EGL_CONTEXT_FLAGS_KHR, EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR});
  std::vector<EGLint> robust = attributes;
  robust.insert(robust.end(), {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET});
  // Without the notification a reset goes unseen, but everything else works.
  for (std::vector<EGLint>* wanted : {&robust, &attributes}) {
    wanted->push_back(EGL_NONE);
    const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, wanted->data());
    if (context != EGL_NO_CONTEXT) return context;
  }
  return EGL_NO_CONTEXT;
}

EGLSurface surfaceFor(EGLDisplay display, EGLConfig config) {
  if (hasExtension(display, "EGL_KHR_surfaceless_context")) return EGL_NO_SURFACE;
  const std::array<EGLint, 5> size{EGL_WIDTH, 1, EGL_HEIGHT, 1, EGL_NONE};
  return eglCreatePbufferSurface(display, config, size.data());
}

std::string glString(GLenum name) {
  const auto* text = reinterpret_cast<const char*>(glGetString(name));
  return text ? text : "";
}

void describe(DeviceInfo& info) {
  info.renderer = glString(GL_RENDERER);
  info.vendor = glString(GL_VENDOR);
  info.version = glString(GL_VERSION);
  for (const std::string_view name : {"llvmpipe", "softpipe", "swrast", "SWR", "Software Rasterizer"})
    info.software |= info.renderer.find(name) != std::string::npos;
  info.usable = epoxy_gl_version() >= 45 && !info.renderer.empty();
  if (!info.usable) info.problem = "only OpenGL " + info.version;
}

/// Everything after eglInitialize; the caller closes `egl` when this gives a problem.
std::string tryOpen(EglContext& egl, bool egl15, bool debug) {
  if (!eglBindAPI(EGL_OPENGL_API)) return "no desktop OpenGL: " + eglFailure("eglBindAPI");
  EGLConfig config = pbufferConfig(egl.display);
  if (!config && !hasExtension(egl.display, "EGL_KHR_no_config_context"))
    return "no configuration for desktop OpenGL";
  egl.context = createContext(egl.display, config, egl15, debug);
  if (egl.context == EGL_NO_CONTEXT) return "no OpenGL 4.5 core context: " + eglFailure("eglCreateContext");
  egl.surface = surfaceFor(egl.display, config);
  if (!egl.makeCurrent()) return eglFailure("eglMakeCurrent");
  return "";
}

}  // namespace

bool EglContext::makeCurrent() const {
  return eglBindAPI(EGL_OPENGL_API) && eglMakeCurrent(display, surface, surface, context);
}

void EglContext::close() {
  // The display stays initialised: eglTerminate would end every other context that lives on it.
  if (context != EGL_NO_CONTEXT) {
    if (eglGetCurrentContext() == context)
      eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
  }
  if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
  *this = {};
}

CurrentKeeper::CurrentKeeper()
    : api_(eglQueryAPI()),
      display_(eglGetCurrentDisplay()),
      context_(eglGetCurrentContext()),
      draw_(eglGetCurrentSurface(EGL_DRAW)),
      read_(eglGetCurrentSurface(EGL_READ)) {}

CurrentKeeper::~CurrentKeeper() {
  const EGLDisplay now = eglGetCurrentDisplay();
  if (context_ != EGL_NO_CONTEXT) {
    eglBindAPI(api_);
    eglMakeCurrent(display_, draw_, read_, context_);
  } else if (now != EGL_NO_DISPLAY) {
    eglMakeCurrent(now, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglBindAPI(api_);
  }
}

std::string missingLibraries() {
  if (!canLoad("libEGL.so.1")) return "libEGL.so.1 cannot be loaded";
  if (!canLoad("libOpenGL.so.0") && !canLoad("libGL.so.1"))
    return "neither libOpenGL.so.0 nor libGL.so.1 can be loaded";
  return "";
}

std::vector<EglCandidate> candidates() {
  std::vector<EglCandidate> found;
  const auto add = [&found](EGLenum platform, void* native) {
    found.push_back({static_cast<int>(found.size()), platform, native});
  };
  const auto query = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  const bool devices = hasExtension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") ||
                       hasExtension(EGL_NO_DISPLAY, "EGL_EXT_device_base");
  std::array<EGLDeviceEXT, 32> list{};
  EGLint count = 0;
  if (query && devices && query(static_cast<EGLint>(list.size()), list.data(), &count))
    for (EGLint i = 0; i < count; ++i) add(EGL_PLATFORM_DEVICE_EXT, list[i]);
  if (hasExtension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
    add(EGL_PLATFORM_SURFACELESS_MESA, reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY));
  return found;
}

EglContext openContext(const EglCandidate& candidate, bool debug, DeviceInfo& info) {
  info = {};
  info.index = candidate.index;
  info.platform = candidate.platform == EGL_PLATFORM_DEVICE_EXT ? "device" : "surfaceless";
  EglContext egl;
  egl.display = displayOf(candidate);
  if (egl.display == EGL_NO_DISPLAY) {
    info.problem = eglFailure("eglGetPlatformDisplay");
    return {};
  }
  EGLint major = 0, minor = 0;
  if (!eglInitialize(egl.display, &major, &minor)) {
    info.problem = eglFailure("eglInitialize");
    return {};
  }
  info.problem = tryOpen(egl, major > 1 || minor >= 5, debug);
  if (info.problem.empty()) describe(info);
  if (!info.usable) egl.close();
  return egl;
}

DeviceInfo describeCurrent() {
  DeviceInfo info;
  info.platform = "window";
  describe(info);
  return info;
}

}  // namespace lychnite::gpu
