#include "view/window.h"

#include <GLFW/glfw3.h>

#include <utility>

#include "base/error.h"

// GLFW declares this one only after Vulkan's headers, which only engine/vk includes: VkInstance is a pointer,
// VkResult an int, and VkSurfaceKHR has 64 bits.
extern "C" int glfwCreateWindowSurface(void* instance, GLFWwindow* window, const void* allocator,
                                       std::uint64_t* surface);

namespace voxilux {

struct WindowState {
    WindowState() = default;
    WindowState(const WindowState&) = delete;
    WindowState& operator=(const WindowState&) = delete;
    ~WindowState() {
        if (handle != nullptr) glfwDestroyWindow(handle);
        glfwTerminate();
    }

    GLFWwindow* handle = nullptr;
    SurfaceSource surface;
    std::vector<InputEvent> events;
};

namespace {

[[noreturn]] void refuse_display(const std::string& why) {
    throw Error(ExitCode::no_device,
                fmt::format("view: {}; voxilux render makes the same picture without a window", why));
}

std::string last_glfw_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text != nullptr ? text : "no window can be opened";
}

WindowState& state_of(GLFWwindow* window) {
    return *static_cast<WindowState*>(glfwGetWindowUserPointer(window));
}

void on_key(GLFWwindow* window, int key, int, int action, int) {
    if (key != GLFW_KEY_UNKNOWN)
        state_of(window).events.emplace_back(KeyEvent{key, action != GLFW_RELEASE, action == GLFW_REPEAT});
}

void on_text(GLFWwindow* window, unsigned codepoint) {
    state_of(window).events.emplace_back(TextEvent{codepoint});
}

void on_button(GLFWwindow* window, int button, int action, int) {
    if (button <= GLFW_MOUSE_BUTTON_MIDDLE)
        state_of(window).events.emplace_back(
            ButtonEvent{static_cast<MouseButton>(button), action != GLFW_RELEASE});
}

// The pointer in pixels: screen coordinates are coarser on some systems.
void on_move(GLFWwindow* window, double x, double y) {
    glm::ivec2 size(1);
    glm::ivec2 pixels(1);
    glfwGetWindowSize(window, &size.x, &size.y);
    glfwGetFramebufferSize(window, &pixels.x, &pixels.y);
    const glm::dvec2 ratio = glm::dvec2(pixels) / glm::dvec2(glm::max(size, glm::ivec2(1)));
    state_of(window).events.emplace_back(MoveEvent{glm::dvec2(x, y) * ratio});
}

void on_scroll(GLFWwindow* window, double, double steps) {
    state_of(window).events.emplace_back(ScrollEvent{steps});
}

void on_drop(GLFWwindow* window, int count, const char** paths) {
    state_of(window).events.emplace_back(DropEvent{{paths, paths + count}});
}

void on_close(GLFWwindow* window) {
    state_of(window).events.emplace_back(CloseEvent{});
}

void listen(GLFWwindow* window, WindowState& state) {
    glfwSetWindowUserPointer(window, &state);
    glfwSetKeyCallback(window, on_key);
    glfwSetCharCallback(window, on_text);
    glfwSetMouseButtonCallback(window, on_button);
    glfwSetCursorPosCallback(window, on_move);
    glfwSetScrollCallback(window, on_scroll);
    glfwSetDropCallback(window, on_drop);
    glfwSetWindowCloseCallback(window, on_close);
}

SurfaceSource surface_of(GLFWwindow* window) {
    SurfaceSource source;
    std::uint32_t count = 0;
    const char** const names = glfwGetRequiredInstanceExtensions(&count);
    if (names == nullptr) refuse_display("this window system has no Vulkan surface");
    source.instance_extensions.assign(names, names + count);
    source.create = [window](void* instance) {
        std::uint64_t surface = 0;
        if (glfwCreateWindowSurface(instance, window, nullptr, &surface) != 0)
            refuse_display("no Vulkan surface: " + last_glfw_error());
        return surface;
    };
    return source;
}

}  // namespace

Window::Window(const std::string& title, glm::ivec2 size) : state_(std::make_unique<WindowState>()) {
    if (glfwInit() != GLFW_TRUE) refuse_display("no display: " + last_glfw_error());
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    state_->handle = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
    if (state_->handle == nullptr) refuse_display("no window: " + last_glfw_error());
    listen(state_->handle, *state_);
    state_->surface = surface_of(state_->handle);
}

Window::~Window() = default;

const SurfaceSource& Window::surface() const {
    return state_->surface;
}

std::vector<InputEvent> Window::poll(double wait_s) {
    if (wait_s > 0.0)
        glfwWaitEventsTimeout(wait_s);
    else
        glfwPollEvents();
    return std::exchange(state_->events, {});
}

glm::ivec2 Window::size() const {
    glm::ivec2 pixels(0);
    glfwGetFramebufferSize(state_->handle, &pixels.x, &pixels.y);
    if (glfwGetWindowAttrib(state_->handle, GLFW_ICONIFIED) == GLFW_TRUE) return glm::ivec2(0);
    return pixels;
}

float Window::scale() const {
    float x = 1.0f;
    float y = 1.0f;
    glfwGetWindowContentScale(state_->handle, &x, &y);
    return x > 0.0f ? x : 1.0f;
}

void Window::resize(glm::ivec2 size) {
    glfwSetWindowSize(state_->handle, size.x, size.y);
}

void Window::minimise(bool is_minimised) {
    if (is_minimised)
        glfwIconifyWindow(state_->handle);
    else
        glfwRestoreWindow(state_->handle);
}

void Window::set_clipboard(const std::string& text) {
    glfwSetClipboardString(state_->handle, text.c_str());
}

void Window::set_title(const std::string& title) {
    glfwSetWindowTitle(state_->handle, title.c_str());
}

}  // namespace voxilux
