// SPDX-License-Identifier: MIT
#include "io/dicom/dicom.h"

#include <dcmtk/dcmdata/dcuid.h>

#include <algorithm>
#include <string>

#include "io/dicom/dicom_object.h"
#include "io/dicom/rtstruct.h"
#include "io/dicom/seg.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

constexpr std::string_view structure_set = "1.2.840.10008.5.1.4.1.1.481.3";
constexpr std::string_view segmentation = "1.2.840.10008.5.1.4.1.1.66.4";

/// What kind of object it is, as messages say it.
std::string described(const std::string& sop_class, std::string_view modality) {
  if (sop_class.empty())
    return modality.empty() ? "an object of no SOP class" : "of modality " + std::string(modality);
  const char* const words = dcmFindNameOfUID(sop_class.c_str());
  return words != nullptr ? words + (" (" + sop_class + ")") : "of SOP class " + sop_class;
}

}  // namespace

Stack read_dicom(const StackInput& input, const ReadOptions& options) {
  DicomObject object(input.bytes, input.name);
  const std::string sop_class = object.text(object.data_set(), DCM_SOPClassUID);
  const std::string modality = object.text(object.data_set(), DCM_Modality);
  if (sop_class == structure_set || (sop_class.empty() && modality == "RTSTRUCT"))
    return read_structure_set(object, options);
  if (sop_class == segmentation || sop_class == label_map_segmentation ||
      (sop_class.empty() && modality == "SEG"))
    return read_segmentation(object, options);
  throw InputError(input.name + ": is " + described(sop_class, modality) +
                   "; contours are in an RT Structure Set or a Segmentation: name that");
}

}  // namespace loft::io
