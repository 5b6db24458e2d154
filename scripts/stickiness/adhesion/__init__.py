"""Adhesive contact: traction laws, solver, loading paths, the DMT limit and the edges of contact.

- `laws`: traction laws
- `solver`: equilibrium at a prescribed mean pressure or mean gap
- `path`: loading and unloading curves with their jumps
- `scaling`: states in the caller's units, and the way to the solver's own and back
- `preconditioner`: of descents, on a coarser grid and next to the edges of contact
- `problem`: one problem in its own units: operators, law, what is prescribed
- `state`: a gap and what follows from it point by point
- `starts`: where a descent starts
- `descent`: projected, preconditioned nonlinear conjugate gradients
- `softening_descent`: faster descent for laws that only soften
- `softening_loops`: its loops over the grid, compiled
- `equilibrium`: stable equilibrium from a start
- `dmt`: attraction over the gaps of a contact without adhesion
- `area_load`: area against load in the DMT limit
- `edge_zone`: lengths at the edge of an adhesive contact
- `equivalent_sphere`: attraction next to the edges, from the DMT to the JKR limit
- `model_choice`: DMT limit or full solution, by the error measured
"""
