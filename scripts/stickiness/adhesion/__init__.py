"""Adhesive contact: traction laws, solver, loading paths, the DMT limit and closed forms."""
