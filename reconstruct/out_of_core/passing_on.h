// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"
#include "reconstruct/clean/region.h"
#include "reconstruct/origin.h"
#include "reconstruct/out_of_core/part_sizes.h"
#include "reconstruct/sew/sewing.h"
#include "reconstruct/sew/surface_sink.h"
#include "reconstruct/sew/survey.h"

namespace loft {

/// Passes a surface on while it is sewn: the layers of a range as they become final, behind them
/// what sewing has added to these. Counts and measures what it passes on.
class PassingOn {
 public:
  /// Layers from `first` up to `bound`, or up to the top if that is Origin::none. Keeps references.
  PassingOn(Sewing& sewing, SurfaceSink& sink, std::uint32_t first, std::uint32_t bound)
      : sewing_(sewing), sink_(sink), first_(first), bound_(bound) {}

  /// The layers that have become final; the sewing forgets them.
  void pass_on();
  /// What was added, once all layers are passed on. Ends the sink.
  void finish();

  /// Layers below are passed on.
  [[nodiscard]] std::uint32_t passed_bound() const { return passed_bound_; }
  [[nodiscard]] Survey& survey() { return survey_; }

  // Once it is finished:
  [[nodiscard]] const PartSizes& sizes() const { return sizes_; }
  /// The places of the first and the last cut faces among all of their seams.
  [[nodiscard]] std::vector<std::uint32_t> lower_places() const;
  [[nodiscard]] std::vector<std::uint32_t> upper_places() const;

 private:
  /// A face that a midpoint cut off: it comes behind all others.
  struct Cut {
    std::uint32_t place;  // among all that are worked on
    SurfaceFace face;
    std::array<Vec3, 3> places;
  };

  void pass_on_added();
  void note_lower_seam();
  void begin();
  void pass_on_upper_slice();
  void pass_on_vertices(std::span<const SurfaceVertex> vertices);
  void pass_on_vertices_of(std::uint32_t number);
  void add_slice(const Region& region);
  void pass_on_faces_of(std::uint32_t number);
  [[nodiscard]] std::uint32_t first_doubled() const {
    return lower_.doubled - sizes_.lower_doubled;
  }
  [[nodiscard]] SurfaceFace face(HalfEdge first) const;
  [[nodiscard]] std::uint32_t passed(std::uint32_t vertex) const;
  [[nodiscard]] std::array<Vec3, 3> places(HalfEdge first) const;
  [[nodiscard]] bool is_in_lower_seam(const Cut& cut) const { return cut.place < lower_seam_end_; }
  [[nodiscard]] bool is_in_upper_seam(const Cut& cut) const {
    return bound_ != Origin::none && cut.place >= upper_.cuts;
  }

  Sewing& sewing_;
  SurfaceSink& sink_;
  std::uint32_t first_;
  std::uint32_t bound_;
  std::uint32_t passed_bound_ = 0;
  Survey survey_;
  std::vector<Cut> cuts_;
  PartSizes sizes_;                   // so far
  std::uint32_t first_vertex_ = 0;    // that is passed on
  Sewing::Added lower_;               // before the first layer
  Sewing::Added upper_;               // before the one above the last
  std::uint32_t lower_seam_end_ = 0;  // cuts made where the first layer is sewn on

  // Memory that is used again.
  std::vector<SurfaceVertex> vertices_;
  std::vector<SurfaceFace> faces_;
};

}  // namespace loft
