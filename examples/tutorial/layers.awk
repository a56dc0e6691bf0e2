# Each section of `weaveform export --format orientation-calculix` as three layers, warp (1/4), weft (1/2), warp (1/4) of its
# thickness: a woven ply whose two yarn directions are those of the formed fabric, whatever the angle between them.
# awk -f examples/tutorial/layers.awk fibres.inp > layers.inp
/^\*SHELL SECTION/ {
  match($0, /ELSET=FIBRE_[0-9]+/)
  set = substr($0, RSTART, RLENGTH)
  number = substr(set, length("ELSET=FIBRE_") + 1)
  print "*SHELL SECTION, COMPOSITE, " set
  getline thickness
  printf "%.6g, , FABRIC, WARP_%d\n", thickness / 4, number
  printf "%.6g, , FABRIC, WEFT_%d\n", thickness / 2, number
  printf "%.6g, , FABRIC, WARP_%d\n", thickness / 4, number
  next
}
{ print }
