"""Contact of a rough solid with a hard wall without adhesion, by boundary elements.

- `solver`: contact at a prescribed mean pressure, and along a load path
- `active_set`: the iteration behind it
- `projected_gradients`: the iteration that takes over where that one fails on a layer
- `half_space`: compliance of a periodic elastic solid
- `free_edges`: that of a half-space under a surface that does not repeat
- `preconditioner`: approximate inverse of the compliance
- `few_points`: approximate compliance of the few points that touch at small loads
- `conjugate_gradients`: iteration that closes a gap on a set of points
- `convolution`: convolutions with an even kernel, block by block
- `grids`: cell, scale of the heights, fields on coarser and finer grids
- `gaps`: area within a range of the wall, distribution of gaps
- `subpixel`: areas finer than the pixels
- `grid_limit`: limit of fine grids, from two or three of them
"""
