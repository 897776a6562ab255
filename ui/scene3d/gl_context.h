#pragma once
#include <QString>
#include <functional>
#include <memory>

namespace btr::ui {

/// An OpenGL context without a window. Belongs to the thread that makes it.
class GlContext {
 public:
  virtual ~GlContext() = default;
  /// False if the driver refuses, for example after the graphics card was reset.
  virtual bool makeCurrent() = 0;
  virtual void release() = 0;
};

/// Surfaceless EGL (Mesa, no X server needed); where that is missing, a context of Qt's platform on an off-screen
/// surface. Null if the machine has no OpenGL: `problem` then says what was tried.
std::unique_ptr<GlContext> createGlContext(QString& problem);

using GlContextFactory = std::function<std::unique_ptr<GlContext>(QString& problem)>;

}  // namespace btr::ui
