#pragma once

#include <epoxy/egl.h>

#include <string>
#include <vector>

#include "lychnite/gpu/context.h"

namespace lychnite::gpu {

/// The EGL names of one open context. Plain values; whoever opened it closes it.
struct EglContext {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  EGLSurface surface = EGL_NO_SURFACE;  ///< a 1 x 1 pbuffer where the driver cannot do without a surface

  bool makeCurrent() const;
  void close();
};

/// One EGL display that might have OpenGL.
struct EglCandidate {
  int index = 0;
  EGLenum platform = 0;           ///< EGL_PLATFORM_DEVICE_EXT or EGL_PLATFORM_SURFACELESS_MESA
  void* nativeDisplay = nullptr;  ///< the EGLDeviceEXT, or EGL_DEFAULT_DISPLAY
};

/// Puts back, when it goes out of scope, the API, context and surfaces that were current when it was made.
class CurrentKeeper {
 public:
  CurrentKeeper();
  ~CurrentKeeper();
  CurrentKeeper(const CurrentKeeper&) = delete;
  CurrentKeeper& operator=(const CurrentKeeper&) = delete;

 private:
  EGLenum api_;
  EGLDisplay display_;
  EGLContext context_;
  EGLSurface draw_, read_;
};

/// Why EGL or OpenGL cannot even be loaded, "" when they can. Must be asked before any other EGL call: epoxy
/// ends the program when it does not find a library.
std::string missingLibraries();

/// Every display to try, devices first. Needs missingLibraries() == "".
std::vector<EglCandidate> candidates();

/// Opens an OpenGL 4.5 core context there and makes it current. Fills `info`; on failure info.usable is
/// false, info.problem says why, and what was current before is not touched or nothing is current.
EglContext openContext(const EglCandidate& candidate, bool debug, DeviceInfo& info);

/// The context that is current on this thread; `platform` is "window".
DeviceInfo describeCurrent();

}  // namespace lychnite::gpu
