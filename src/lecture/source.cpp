#include "lecture/source.hpp"

#include "embedded/lecture_source.hpp"

namespace lantern::lecture {

std::array<SourceFile, 5> own_source() {
  return {{{"quad_tree.hpp", lecture_source::quad_tree_hpp},
           {"physics_system.cpp", lecture_source::physics_system_cpp},
           {"physics_system.hpp", lecture_source::physics_system_hpp},
           {"game_object.cpp", lecture_source::game_object_cpp},
           {"collision_detection.hpp", lecture_source::collision_detection_hpp}}};
}

}  // namespace lantern::lecture
