#pragma once
#include <string>
#include <string_view>
#include "run/director.hpp"
#include "publish/lesson_frames.hpp"
#include "draw/page.hpp"
#include "render/svg.hpp"
namespace lantern::live {
class Session { public: std::string ask(std::string_view request); };
}
