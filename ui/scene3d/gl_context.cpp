#include "ui/scene3d/gl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <cstring>

namespace btr::ui {
namespace {

/// The display stays initialised when a context goes: other contexts of the process share it.
class EglContext final : public GlContext {
 public:
  EglContext(EGLDisplay display, EGLSurface surface, EGLContext context)
      : display_(display), surface_(surface), context_(context) {}
  ~EglContext() override {
    release();
    eglDestroyContext(display_, context_);
    eglDestroySurface(display_, surface_);
  }
  bool makeCurrent() override {
    return eglBindAPI(EGL_OPENGL_API) && eglMakeCurrent(display_, surface_, surface_, context_);
  }
  void release() override { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

 private:
  EGLDisplay display_;
  EGLSurface surface_;
  EGLContext context_;
};

std::unique_ptr<GlContext> createEgl(QString& problem) {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!extensions || !std::strstr(extensions, "EGL_MESA_platform_surfaceless")) {
    problem = "EGL offers no surfaceless display";
    return nullptr;
  }
  const EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API)) {
    problem = "EGL does not start";
    return nullptr;
  }
  const EGLint wanted[] = {EGL_SURFACE_TYPE,
                           EGL_PBUFFER_BIT,
                           EGL_RENDERABLE_TYPE,
                           EGL_OPENGL_BIT,
                           EGL_RED_SIZE,
                           8,
                           EGL_GREEN_SIZE,
                           8,
                           EGL_BLUE_SIZE,
                           8,
                           EGL_DEPTH_SIZE,
                           24,
                           EGL_NONE};
  EGLConfig config = nullptr;
  EGLint found = 0;
  if (!eglChooseConfig(display, wanted, &config, 1, &found) || found == 0) {
    problem = "EGL has no pixel format with 24-bit colour and depth";
    return nullptr;
  }
  const EGLint size[] = {EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
  const EGLSurface surface = eglCreatePbufferSurface(display, config, size);
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, nullptr);
  if (surface == EGL_NO_SURFACE || context == EGL_NO_CONTEXT) {
    if (surface != EGL_NO_SURFACE) eglDestroySurface(display, surface);
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    problem = "EGL makes no OpenGL context";
    return nullptr;
  }
  return std::make_unique<EglContext>(display, surface, context);
}

class QtContext final : public GlContext {
 public:
  bool create() {
    QSurfaceFormat format;
    format.setRenderableType(QSurfaceFormat::OpenGL);
    format.setProfile(QSurfaceFormat::CompatibilityProfile);
    format.setDepthBufferSize(24);
    context_.setFormat(format);
    surface_.setFormat(format);
    surface_.create();
    return surface_.isValid() && context_.create() && context_.isValid();
  }
  bool makeCurrent() override { return context_.makeCurrent(&surface_); }
  void release() override { context_.doneCurrent(); }

 private:
  QOffscreenSurface surface_;
  QOpenGLContext context_;
};

}  // namespace

std::unique_ptr<GlContext> createGlContext(QString& problem) {
  if (auto egl = createEgl(problem)) return egl;
  // (qGuiApp is not null either where there is no window system.)
  if (qobject_cast<QGuiApplication*>(QCoreApplication::instance())) {
    auto context = std::make_unique<QtContext>();
    if (context->create()) return context;
    problem += "; Qt's platform \"" + QGuiApplication::platformName() + "\" makes no OpenGL context either";
  }
  return nullptr;
}

}  // namespace btr::ui
