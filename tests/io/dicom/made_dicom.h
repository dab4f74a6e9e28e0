// SPDX-License-Identifier: MIT
// Small DICOM files, written by DCMTK, for tests that are built with it.
#pragma once

#include <dcmtk/config/osconfig.h>
//
#include <dcmtk/dcmdata/dcdeftag.h>
#include <dcmtk/dcmdata/dcfilefo.h>
#include <dcmtk/dcmdata/dcsequen.h>
#include <dcmtk/dcmdata/dcuid.h>
#include <dcmtk/dcmdata/dcvrobow.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/dicom/dicom.h"
#include "mesh/mesh.h"
#include "reconstruct/defect.h"
#include "reconstruct/number_text.h"
#include "tests/io/shapes.h"

namespace loft::io::testing {

struct MadeContour {
  std::string type;
  std::vector<Vec3> points;
};

struct MadeRoi {
  std::string number;
  std::string name;
  std::string kind = "ORGAN";
  std::string colour = "208\\32\\48";
  std::optional<std::vector<MadeContour>> contours = {};  ///< none: no item at all
};

inline std::string decimals(const std::vector<Vec3>& points) {
  std::string text;
  for (const Vec3& point : points)
    for (const double number : point) text += (text.empty() ? "" : "\\") + exact(number);
  return text;
}

inline DcmItem& add_item(DcmItem& to, const DcmTagKey& sequence) {
  DcmItem* item = nullptr;
  static_cast<void>(to.findOrCreateSequenceItem(sequence, item, -2));
  return *item;
}

inline void put(DcmItem& item, const DcmTagKey& tag, const std::string& value) {
  static_cast<void>(item.putAndInsertString(tag, value.c_str()));
}

inline void put_contours(DcmItem& roi, const std::vector<MadeContour>& contours) {
  if (contours.empty()) {
    static_cast<void>(roi.insertEmptyElement(DCM_ContourSequence));
    return;
  }
  // Not through add_item(), which counts all items each time.
  auto sequence = std::make_unique<DcmSequenceOfItems>(DCM_ContourSequence);
  for (const MadeContour& contour : contours) {
    auto item = std::make_unique<DcmItem>();
    put(*item, DCM_ContourGeometricType, contour.type);
    put(*item, DCM_NumberOfContourPoints, std::to_string(contour.points.size()));
    put(*item, DCM_ContourData, decimals(contour.points));
    sequence->append(item.release());
  }
  roi.insert(sequence.release());
}

/// An RT Structure Set.
inline void make_structure_set(DcmDataset& set, const std::vector<MadeRoi>& rois,
                               const std::string& character_set = "ISO_IR 192") {
  if (!character_set.empty()) put(set, DCM_SpecificCharacterSet, character_set);
  put(set, DCM_SOPClassUID, UID_RTStructureSetStorage);
  put(set, DCM_SOPInstanceUID, "1.2.3.4");
  put(set, DCM_Modality, "RTSTRUCT");
  for (const MadeRoi& roi : rois) {
    DcmItem& named = add_item(set, DCM_StructureSetROISequence);
    put(named, DCM_ROINumber, roi.number);
    put(named, DCM_ROIName, roi.name);
    DcmItem& observed = add_item(set, DCM_RTROIObservationsSequence);
    put(observed, DCM_ReferencedROINumber, roi.number);
    put(observed, DCM_RTROIInterpretedType, roi.kind);
    if (!roi.contours) continue;
    DcmItem& drawn = add_item(set, DCM_ROIContourSequence);
    put(drawn, DCM_ReferencedROINumber, roi.number);
    if (!roi.colour.empty()) put(drawn, DCM_ROIDisplayColor, roi.colour);
    put_contours(drawn, *roi.contours);
  }
}

/// What a data set is as a file.
inline std::string bytes_of(DcmDataset& set, E_TransferSyntax syntax = EXS_LittleEndianExplicit,
                            E_EncodingType lengths = EET_UndefinedLength,
                            E_FileWriteMode mode = EWM_createNewMeta) {
  const Folder folder;
  const std::string path = (folder / "made.dcm").string();
  DcmFileFormat file(&set);
  const OFCondition written =
      file.saveFile(path.c_str(), syntax, lengths, EGL_recalcGL, EPD_noChange, 0, 0, mode);
  return written.good() ? content(path) : std::string(written.text());
}

inline std::string structure_set(const std::vector<MadeRoi>& rois,
                                 E_TransferSyntax syntax = EXS_LittleEndianExplicit,
                                 E_EncodingType lengths = EET_UndefinedLength) {
  DcmDataset set;
  make_structure_set(set, rois);
  return bytes_of(set, syntax, lengths);
}

/// A circle of 24 corners in the plane at a height.
inline std::vector<Vec3> circle(double x, double y, double radius, double z) {
  constexpr int corners = 24;
  std::vector<Vec3> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    points.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle), z});
  }
  return points;
}

/// What the library reads of a made file, whose name is made.dcm in its messages.
inline Stack read(std::string_view bytes) { return read_dicom({bytes, "made.dcm"}, {}); }

/// What it says of a bad one; "nothing" if it takes it.
inline std::string problem(std::string_view bytes) {
  return message_of<InputError>([&] { static_cast<void>(read(bytes)); });
}

}  // namespace loft::io::testing
