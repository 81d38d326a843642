// Panels and counts are known to who draws and runs; these tests read scenarios, too.
#include "draw/panel.hpp"
#include "run/counters.hpp"

extern const bool kAllIsKnown;
const bool kAllIsKnown = lantern::draw::panels_are_known() && lantern::run::counts_are_known();
