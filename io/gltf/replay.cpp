// SPDX-License-Identifier: MIT
#include "io/gltf/replay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "io/bytes/utf8.h"
#include "io/gltf/gltf_model.h"
#include "reconstruct/defect.h"
#include "reconstruct/number_text.h"

namespace loft::io {

namespace {

/// The last picture stays that long, in seconds, before a viewer begins anew.
constexpr double last_seconds = 2;

int add_numbers(Buffer& buffer, std::span<const float> numbers, int type, std::size_t size) {
  buffer.begin(numbers.size() * sizeof(float), 0, TINYGLTF_COMPONENT_TYPE_FLOAT, type,
               numbers.size() / size);
  for (const float number : numbers) buffer.add(number);
  return buffer.last_accessor();
}

/// No eye tells normals apart that differ by so little; rounding alone may change them.
constexpr double visible_difference = 1e-3;

bool look_alike(std::span<const Vec3> a, std::span<const Vec3> b) {
  const auto is_near = [](const Vec3& p, const Vec3& q) {
    return std::ranges::equal(
        p, q, [](double x, double y) { return std::abs(x - y) <= visible_difference; });
  };
  return std::ranges::equal(a, b, is_near);
}

}  // namespace

class Replay::Film {
 public:
  explicit Film(double metres_per_unit) : frame_{{}, metres_per_unit}, buffer_(model_) {}

  void add(double time, const std::string& key, const Snapshot& snapshot, std::size_t i,
           const std::string& label, std::optional<Colour> colour) {
    const std::size_t first = i - std::min<std::size_t>(i, 1);
    const Patch patch = snapshot.patch(first, std::min(i + 2, snapshot.slab_count()));
    ShadedMesh shaded = shade(patch, static_cast<std::uint32_t>(i));
    if (shaded.faces.empty()) return;
    if (const auto found = shown_.find(key); found != shown_.end()) {
      if (look_alike(found->second.normals, shaded.normals)) return;
      remove(time, key);
    }
    std::vector<Vec3> normals = shaded.normals;
    if (scenes_.empty()) frame_.centre = shaded.points.front();  // of all nodes
    const std::string name = label.empty() ? "surface" : json_text(label);
    tinygltf::Mesh mesh;
    mesh.name = name;
    mesh.primitives.push_back(primitive(std::move(shaded), frame_, buffer_, model_));
    mesh.primitives.back().material = material_of(name, colour);
    tinygltf::Node node;
    std::string height;
    append_number(height, snapshot.slab(i).low);
    node.name = name + " z " + height;
    node.mesh = static_cast<int>(model_.meshes.size());
    const Vec3 translation = frame_.translation();
    node.translation.assign(translation.begin(), translation.end());
    model_.meshes.push_back(std::move(mesh));
    shown_[key] = {scenes_.size(), std::move(normals)};
    scenes_.push_back({static_cast<int>(model_.nodes.size()), time, {}});
    model_.nodes.push_back(std::move(node));
    end_ = std::max(end_, time);
  }

  void remove(double time, const std::string& key) {
    const auto found = shown_.find(key);
    if (found == shown_.end()) return;
    scenes_[found->second.scene].goes = time;
    shown_.erase(found);
    end_ = std::max(end_, time);
  }

  void write(std::ostream& out) const {
    if (scenes_.empty()) throw Error("there is nothing to replay: no slab ever appeared");
    tinygltf::Model model = model_;
    model.asset = empty_model().asset;
    model.scenes.resize(1);
    model.defaultScene = 0;
    Buffer buffer(model);
    tinygltf::Animation animation;
    animation.name = "capture";
    for (const Scene& scene : scenes_) {
      model.scenes[0].nodes.push_back(scene.node);
      if (scene.goes) model.nodes[static_cast<std::size_t>(scene.node)].scale = {0, 0, 0};
      add_channel(scene, buffer, model, animation);
    }
    model.animations.push_back(std::move(animation));
    write_model(out, model, true);
  }

 private:
  struct Scene {
    int node;
    double comes;
    std::optional<double> goes;
  };
  struct Shown {
    std::size_t scene;
    std::vector<Vec3> normals;
  };

  int material_of(const std::string& name, std::optional<Colour> colour) {
    const auto [found, is_new] =
        materials_.try_emplace(name, static_cast<int>(model_.materials.size()));
    if (is_new) model_.materials.push_back(material(name, false, colour));
    return found->second;
  }

  /// Not there, there, gone again; the animation lasts a little longer than that.
  void add_channel(const Scene& scene, Buffer& buffer, tinygltf::Model& model,
                   tinygltf::Animation& animation) const {
    std::vector<float> times;
    std::vector<float> scales;
    const auto add = [&](double time, float scale) {
      const auto rounded = static_cast<float>(time);
      if (!times.empty() && rounded <= times.back()) {  // at once: what is last holds
        scales.resize(scales.size() - 3);
        times.pop_back();
      }
      times.push_back(rounded);
      scales.insert(scales.end(), 3, scale);
    };
    add(0, 0);
    add(scene.comes, 1);
    if (scene.goes) add(*scene.goes, 0);
    add(end_ + last_seconds, scene.goes ? 0 : 1);

    tinygltf::AnimationSampler sampler;
    sampler.interpolation = "STEP";
    sampler.input = add_numbers(buffer, times, TINYGLTF_TYPE_SCALAR, 1);
    model.accessors.back().minValues = {static_cast<double>(times.front())};
    model.accessors.back().maxValues = {static_cast<double>(times.back())};
    sampler.output = add_numbers(buffer, scales, TINYGLTF_TYPE_VEC3, 3);
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation.samplers.size());
    channel.target_node = scene.node;
    channel.target_path = "scale";
    animation.samplers.push_back(std::move(sampler));
    animation.channels.push_back(std::move(channel));
  }

  tinygltf::Model model_;
  Frame frame_;
  Buffer buffer_;
  std::map<std::string, int> materials_;
  std::vector<Scene> scenes_;
  std::map<std::string, Shown> shown_;  // what is there now
  double end_ = 0;
};

Replay::Replay(double metres_per_unit) : film_(std::make_unique<Film>(metres_per_unit)) {}
Replay::~Replay() = default;
Replay::Replay(Replay&&) noexcept = default;
Replay& Replay::operator=(Replay&&) noexcept = default;

void Replay::add(double time, const std::string& key, const Snapshot& snapshot, std::size_t i,
                 const std::string& label, std::optional<Colour> colour) {
  film_->add(time, key, snapshot, i, label, colour);
}
void Replay::remove(double time, const std::string& key) { film_->remove(time, key); }
void Replay::write(std::ostream& out) const { film_->write(out); }

}  // namespace loft::io
