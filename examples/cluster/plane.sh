# The plane: options of `impact-atlas map`, and the store that every part writes into. Sourced by the other scripts.

IMPACT_ATLAS=${IMPACT_ATLAS:-impact-atlas}
DATA=${DATA:-plane.zarr}
PLANE=${PLANE:-"--x omega=0.2:5:4000 --y delta=0.02:0.8:3000"}
