# Gmsh's .inp of second-order triangles as CalculiX wants it: S6 for CPS6, and of the held edge its nodes, not its lines.
# awk -f examples/tutorial/shells.awk part.inp > shells.inp
/^\*/ { lines = /T3D3/ || /ELSET=TRIM/ }
!lines { sub(/type=CPS6/, "type=S6"); print }
