#include "scenario/directing.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include <gtest/gtest.h>

#include "base/hash.hpp"

namespace lantern::run {

std::vector<Frame> frames_of(const Scenario& scenario, Pace pace) {
  Work work;
  std::vector<Frame> frames;
  direct(scenario, pace, work, [&](const Frame& frame) {
    frames.push_back(frame);
    return true;
  });
  EXPECT_FALSE(frames.empty()) << "a run without frames";
  if (frames.empty()) frames.emplace_back();
  return frames;
}

std::vector<Frame> frames_of(const std::string& name, Pace pace) {
  return frames_of(shipped(name), pace);
}

Scenario shipped(const std::string& name) {
  return load_scenario(LANTERN_ROOT "/scenarios/" + name + ".toml");
}

namespace {

std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(LANTERN_ROOT "/scenarios/" + folder))
    if (entry.path().extension() == ".toml") names.push_back(folder + entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::vector<std::string> all_scenarios() { return files_in(""); }

std::vector<std::string> all_files() {
  std::vector<std::string> names = all_scenarios();
  std::ranges::copy(files_in("problems/"), std::back_inserter(names));
  return names;
}

std::string test_name_of_file(const testing::TestParamInfo<std::string>& file) {
  std::string name = file.param;
  std::ranges::replace(name, '/', '_');
  return name;
}

const Frame& at(const std::vector<Frame>& frames, const std::string& event) {
  const auto found = std::find_if(frames.begin(), frames.end(),
                                  [&](const Frame& frame) { return frame.event == event; });
  EXPECT_NE(found, frames.end()) << "no frame of event " << event;
  return found == frames.end() ? frames.front() : *found;
}

const FrameNode& node(const Frame& frame, const std::string& label) {
  static const FrameNode kNothing;
  for (const FrameNode& n : frame.nodes)
    if (n.label == label) return n;
  ADD_FAILURE() << "no node " << label;
  return kNothing;
}

const FrameBody& body(const Frame& frame, const std::string& name) {
  static const FrameBody kNobody;
  for (const FrameBody& b : frame.bodies)
    if (b.name == name) return b;
  ADD_FAILURE() << "no body " << name;
  return kNobody;
}

Names bodies_in(const Frame& frame, const std::string& label) {
  const std::vector<std::string> list = names(frame, node(frame, label).bodies);
  return Names(list.begin(), list.end());
}

std::vector<std::string> names(const Frame& frame, const std::vector<BodyId>& ids) {
  std::vector<std::string> list;
  for (const BodyId id : ids)
    for (const FrameBody& b : frame.bodies)
      if (b.id == id) list.push_back(b.name);
  return list;
}

std::uint64_t motion_hash(const Frame& frame) {
  Hash hash;
  hash.add(frame.time);
  for (const FrameBody& b : frame.bodies) {
    hash.add(std::string_view(b.name)).add(std::uint64_t{b.asleep});
    for (int i = 0; i < 3; ++i)
      hash.add(b.position[i]).add(b.velocity[i]).add(b.angular_momentum[i]);
    const auto& q = b.orientation.q;
    hash.add(b.angle).add(q.w).add(q.x).add(q.y).add(q.z);
  }
  return hash.value();
}

std::string world_text(const std::string& keys, const std::string& rest) {
  return "title = \"test\"\n[world]\n" + keys + "\n" + rest;
}

}  // namespace lantern::run
