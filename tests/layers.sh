#!/bin/sh
# SPDX-License-Identifier: MIT
# Checks that layers, and the wings inside them, include each other in one direction only, and that
# the lower ones keep away from the world outside.
#   sh tests/layers.sh [ROOT]
# Prints every #include line that should not be there, and every file that is in no wing; exit code 1
# if there is one.
set -u
cd "${1:-$(dirname "$0")/..}" || exit 2

# One line a wing: its name, where its files are, and the wings that it may include, beside itself.
# A wing named here stands for all that it may include, too. Files in the top folder of a layer are
# listed by name: its values, which its wings know, and its face, which knows its wings.
wings='
cdt           cdt/*
overlay       overlay/*                      cdt
paths         paths/*                        overlay
fields        fields/*                       overlay
mesh          mesh/*                         cdt

values        reconstruct/{contours_by_label,defect,nearest_height,number_text,options,option_names,origin,parallel,progress,slice,stack,surface,usable}  mesh
moved         reconstruct/{check,measure,mesh}                                    values
plane         reconstruct/plane/*            values
fair          reconstruct/fair/*             plane
clean         reconstruct/clean/*            fair
tile          reconstruct/tile/*             clean
registration  reconstruct/registration/*     tile
link          reconstruct/link/*             registration
sew           reconstruct/sew/*              tile
shape         reconstruct/shape/*            link sew
live          reconstruct/live/*             shape
out-of-core   reconstruct/out_of_core/*      shape
reconstruct   reconstruct/{reconstruct,fair,out_of_core,reconstruction,world}                live out-of-core

io-values     io/{unit,version}              reconstruct paths fields
bytes         io/bytes/*                     io-values
read-options  io/stacks/{read_options,stack_format}  io-values
contours      io/contours/*                  bytes read-options
volumes       io/volumes/*                   bytes read-options
images        io/images/*                    volumes
dicom         io/dicom/*                     volumes
stacks        io/stacks/*                    contours images dicom
meshes        io/meshes/*                    bytes
rounding      io/rounding/*                  meshes
gltf          io/gltf/*                      rounding
planar        io/planar/*                    bytes
session       io/session/*                   stacks
io            io/{fields,maps,meshes,points,polylines,precomputed,scenes,stack,stack_file,stack_writer,surfaces,tables,triangulations}     gltf planar session

words         app/{descriptors,exit_code,failure,interrupt,json,memory,overwriting,place,report,stopwatch,table,terminal}  io
capture       app/capture/*                  words
server        app/server/*                   capture
app-live      app/live/*                     server
commands      app/commands/*                 app-live
options       app/options/*                  commands
app           app/main                       options

python        python/binding/*               io
'

# All #include lines of a folder, as file:line:#include "header", without blanks.
includes() {
  grep -rnE '^[[:space:]]*#[[:space:]]*include' --include='*.h' --include='*.cpp' "$@" |
    sed 's/[[:space:]]//g'
}

# forbid FOLDERS HEADERS: no file in them may include what matches HEADERS.
forbid() {
  includes $1 | grep -E "#include[\"<]($2)"
}

# allow FOLDERS HEADERS: no file in them may include with <> what neither is a standard header nor
# matches HEADERS. Our own are named with "", so that arrows() sees them.
allow() {
  includes $1 | grep '#include<' | grep -vE "#include<([a-z_0-9]+|$2)>"
}

# The arrows of the table: reads names of files, then #include lines.
arrows() {
  awk -F '"' -v table="$wings" '
    function wing_of(file,    folder) {
      sub(/\.(h|cpp)$/, "", file)
      if (file in wing) return wing[file]
      folder = file
      sub(/[^\/]*$/, "*", folder)
      return (folder in wing) ? wing[folder] : ""
    }
    function place(pattern, name,    folder, names, count, i) {
      folder = pattern
      sub(/{.*/, "", folder)
      if (folder == pattern) { wing[pattern] = name; return }
      sub(/.*{/, "", pattern)
      sub(/}.*/, "", pattern)
      count = split(pattern, names, ",")
      for (i = 1; i <= count; ++i) wing[folder names[i]] = name
    }
    BEGIN {
      count = split(table, lines, "\n")
      for (i = 1; i <= count; ++i) {
        fields = split(lines[i], field, /[ ]+/)
        if (fields < 2) continue
        name = field[1]
        place(field[2], name)
        knows[name, name] = 1
        for (k = 3; k <= fields; ++k) {
          if (field[k] != "" && !(field[k] in wings))
            print "the table: " name " may include " field[k] ", which is no wing above it"
          for (other in wings)
            if (knows[field[k], other]) knows[name, other] = 1
        }
        wings[name] = 1
        for (k = 3; k <= fields; ++k) knows[name, field[k]] = 1
      }
    }
    NF == 1 {
      if (wing_of($1) == "") print $1 ": in no wing of the table"
      next
    }
    {
      file = $1
      sub(/:.*/, "", file)
      from = wing_of(file)
      to = wing_of($2)
      if (to == "") print $0 ": in no wing of the table"
      else if (!knows[from, to]) print $0 ": " from " may not include " to
    }'
}

offenders=$(
  layers='cdt overlay paths fields mesh reconstruct io app python/binding'
  { find $layers -name '*.h' -o -name '*.hpp' -o -name '*.cpp' -o -name '*.cc'; includes $layers | grep '#include"'; } | arrows

  # The world outside: standard headers (neither slash nor dot in their names), and what a layer is
  # there to hide.
  posix='(arpa|netinet|sys)/.*|(fcntl|netdb|poll|unistd)\.h'
  allow 'cdt overlay paths fields mesh' 'none'
  allow reconstruct 'OpenMesh/.*|tbb/.*|Eigen/.*'
  allow io "$posix|tiny_gltf\.h|sqlite3\.h|dcmtk/.*|zlib\.h|zip\.h|meshoptimizer\.h|csv\.h|tiffio\.h|png\.h"
  allow app "$posix|fnmatch\.h|CLI/.*|httplib\.h|nlohmann/.*"
  allow python/binding 'pybind11/.*|Python\.h|pthread\.h'
  forbid 'cdt overlay paths fields mesh' '(fstream|filesystem|iostream|chrono|thread|mutex|condition_variable|cstdio)>'
  forbid reconstruct '(fstream|filesystem|iostream|chrono)>'
  forbid io 'chrono>'

  # Our own headers are named from the root of the project, so that their layer can be seen.
  includes $layers tests samples bench |
    grep '#include"' | grep -vE '#include"(cdt|overlay|paths|fields|mesh|reconstruct|io|app|python|samples|tests|bench)/'
)
if [ -n "$offenders" ]; then
  echo "These lines include what their wing must not know (the table is in tests/layers.sh):"
  echo "$offenders" | sort -u
  exit 1
fi
echo "The layers are kept."
