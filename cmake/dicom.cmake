# SPDX-License-Identifier: MIT
# LOFT_DICOM: whether io reads DICOM. By default where DCMTK is found.
find_package(DCMTK CONFIG QUIET)
find_package(ZLIB QUIET)
set(loft_has_dcmtk OFF)
if(TARGET DCMTK::dcmdata AND TARGET ZLIB::ZLIB)
  set(loft_has_dcmtk ON)
endif()
loft_optional(DICOM ${loft_has_dcmtk} "Read DICOM, RTSTRUCT and SEG" "DICOM (RTSTRUCT, SEG)" DCMTK
  libdcmtk-dev ${DCMTK_VERSION})
