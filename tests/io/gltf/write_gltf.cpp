// SPDX-License-Identifier: MIT
// Writes one glTF file of each kind that can come up, into the current folder, for
// validate_gltf.mjs, and a 3MF for check_3mf.py.
#include <fstream>
#include <string>
#include <vector>

#include "io/bytes/zip.h"
#include "io/gltf/meshopt.h"
#include "io/gltf/replay.h"
#include "io/gltf/slab_glb.h"
#include "io/surfaces.h"
#include "reconstruct/reconstruction.h"
#include "tests/io/shapes.h"
#include "tests/reconstruct/stacks.h"

int main() {
  using namespace loft;
  using io::testing::prism;
  const Surface closed = prism(12);
  const Surface open = prism(12, {2, 0, 0}, 1, false);
  const Surface fine = prism(40'000, {}, 1, false);              // more vertices than 16 bits count
  const Surface far = prism(9, {500'000, 5'000'000, 1e3}, 0.5);  // as in UTM
  const Surface tiny = prism(9, {}, 1e-9);
  Surface leaf;  // two faces whose normals cancel at every vertex
  const auto a = leaf.add_vertex({0, 0, 0});
  const auto b = leaf.add_vertex({1, 0, 0});
  const auto c = leaf.add_vertex({0, 1, 0});
  leaf.add_face(a, b, c);
  leaf.add_face(c, b, a);

  io::WriteOptions options;
  options.sources = {"stack.ndjson"};
  options.settings = {{"fill", "evenodd"}, {"cap", "flat"}};
  const auto write = [&](const char* name, const std::vector<io::Part>& parts) {
    io::write(name, parts, options);
  };
  write("closed.glb", {{"", &closed}});
  write("closed.gltf", {{"", &closed}});
  write("open.glb", {{"", &open}});
  write("labels.glb", {{"heart", &closed}, {"lung \"left\" \xc3\xa9", &open}, {"", &tiny}});
  write("fine.glb", {{"", &fine}});
  write("far.glb", {{"", &far}});
  write("leaf.glb", {{"", &leaf}});
  // Smaller, with lines, transparent, hidden.
  io::Part organ{"liver", &closed, Colour{0xd0, 0x20, 0x30}, "3", "ORGAN", "plan.dcm", 2};
  for (const double height : {0.0, 1.0})
    organ.contours.push_back({height, {{0, 0, height}, {1, 0, height}, {0, 1, height}}});
  io::Part body{"BODY", &open, {}, "1", "EXTERNAL"};
  body.is_hidden = true;
  const auto write_as = [&](const std::string& name, io::Compression compression) {
    options.compression = compression;
    write((name + ".glb").c_str(), {organ, body});
    write((name + ".gltf").c_str(), {organ, body});
    write((name + "_fine.glb").c_str(), {{"", &fine}});
    write((name + "_far.glb").c_str(), {{"", &far}});
    write((name + "_leaf.glb").c_str(), {{"", &leaf}});
  };
  write_as("whole", io::Compression::none);
  write_as("quantized", io::Compression::quantize);
  if (io::has_meshopt()) write_as("packed", io::Compression::meshopt);
  options.compression = io::Compression::none;
  // A slab, and how a stack came about.
  Reconstruction live;
  io::Replay replay(0.001);
  for (int i = 0; i < 6; ++i) {
    const double z = i % 4;  // the last two take the place of others
    const SurfaceChange change =
        i < 4 ? live.insert({z, {stacks::circle(20, 5 + z)}})
              : live.replace(z, {z, {stacks::circle(30, 4), stacks::circle(9, 2)}});
    const Snapshot snapshot = live.snapshot();
    for (const std::uint32_t id : change.removed) replay.remove(i, std::to_string(id));
    for (const SlabInfo& slab : change.added)
      replay.add(i, std::to_string(slab.id), snapshot, snapshot.find(slab.id), "heart");
  }
  std::ofstream slab("slab.glb", std::ios::binary);
  slab << io::slab_glb(live.snapshot(), 1, {.label = "lung", .origin = {5, 5, 5}});
  std::ofstream animated("replay.glb", std::ios::binary);
  replay.write(animated);

  if (io::has_zip()) {
    const Surface third = prism(12, {2 + 1.0 / 3 + 0, 0, 0}, 1, false);
    options.metres_per_unit = 1e-6;
    write("parts.3mf",
          {{"liver \"1\" & <2>", &closed, Colour{0xd0, 0x20, 0x30}}, {"lung \xc3\xa9", &third}});
  }
  options.metres_per_unit = 1e-9;
  write("tiny.glb", {{"", &tiny}});
}
