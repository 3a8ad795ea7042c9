// An OpenGL 3.3 core context without a window, on Mesa's software renderer.
#pragma once

#include "base/result.h"

#include <string>

#include <EGL/egl.h>

namespace scanout::bench {

class GlContext {
public:
    // The calling thread then draws by itself: llvmpipe starts no threads of its own. Before any
    // other GL call of the process. Exit::no_display where there is no llvmpipe.
    static Result<GlContext> create();
    GlContext(GlContext&& other) noexcept;
    GlContext& operator=(GlContext&&) = delete;
    GlContext(const GlContext&) = delete;
    ~GlContext();

    // "llvmpipe (LLVM 15.0.6, 256 bits), 3.3 (Core Profile) Mesa 22.3.6"
    std::string version() const;

private:
    GlContext(EGLDisplay display, EGLContext context) : display_(display), context_(context) {}
    EGLDisplay display_;
    EGLContext context_;
};

} // namespace scanout::bench
