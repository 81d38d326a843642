// The rooms' namespaces: each sees the names of those that it may include (src/ARCHITECTURE.md),
// and has its own first. What is in `base` is in `lantern` itself.
#pragma once

namespace lantern {

namespace geometry {}
namespace lecture {
using namespace geometry;
}
namespace spatial {
using namespace geometry;
}
namespace atlas {
using namespace geometry;
}
namespace physics {
using namespace spatial;
}
namespace language {
using namespace physics;
using namespace atlas;
}  // namespace language
namespace frame {
using namespace language;
}
namespace run {
using namespace frame;
}
namespace draw {
using namespace frame;
}
namespace render {
using namespace draw;
}
namespace publish {
using namespace render;
}
namespace live {
using namespace publish;
using namespace run;
}  // namespace live
namespace measure {
using namespace run;
}
namespace peers {
using namespace measure;
}
namespace report {
using namespace measure;
using namespace render;
}  // namespace report
namespace app {
using namespace publish;
using namespace run;
}  // namespace app
namespace lab {
using namespace app;
using namespace report;
}  // namespace lab

}  // namespace lantern
