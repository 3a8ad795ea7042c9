#include "bench/peers/gl_context.h"

#include <array>
#include <cstdlib>

#include <EGL/eglext.h>
#include <GL/gl.h>

namespace scanout::bench {

Result<GlContext> GlContext::create() {
    ::setenv("LP_NUM_THREADS", "0", 1);
    ::setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    ::setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    const auto display_of = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
        eglGetProcAddress("eglGetPlatformDisplayEXT"));
    const EGLDisplay display = display_of == nullptr ? EGL_NO_DISPLAY
                                                     : display_of(EGL_PLATFORM_SURFACELESS_MESA,
                                                                  EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE)
        return fail(Exit::no_display, "there is no EGL display without a surface; install "
                                      "libgl1-mesa-dri");
    eglBindAPI(EGL_OPENGL_API);
    constexpr std::array<EGLint, 7> kWanted = {EGL_CONTEXT_MAJOR_VERSION,
                                               3,
                                               EGL_CONTEXT_MINOR_VERSION,
                                               3,
                                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                               EGL_NONE};
    const EGLContext context =
        eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kWanted.data());
    if (context == EGL_NO_CONTEXT ||
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) == EGL_FALSE)
        return fail(Exit::no_display, "EGL makes no OpenGL 3.3 context (error {:#x})",
                    eglGetError());
    GlContext made(display, context);
    if (made.version().find("llvmpipe") == std::string::npos)
        return fail(Exit::no_display, "this is no llvmpipe but {}", made.version());
    return made;
}

GlContext::GlContext(GlContext&& other) noexcept
    : display_(std::exchange(other.display_, EGL_NO_DISPLAY)), context_(other.context_) {}

GlContext::~GlContext() {
    if (display_ == EGL_NO_DISPLAY) return;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    eglTerminate(display_);
}

std::string GlContext::version() const {
    const auto text = [](GLenum name) {
        const GLubyte* said = glGetString(name);
        return said == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(said));
    };
    return text(GL_RENDERER) + ", " + text(GL_VERSION);
}

} // namespace scanout::bench
