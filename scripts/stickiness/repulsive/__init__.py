"""Contact of a rough solid with a hard wall without adhesion.

- `solver`: `solve` and `load_path`, in the caller's units
- `active_set`: iteration of the contact set; `dilute_contact` where few points touch
- `projected_gradients`: slower method where the active set does not settle
- `preconditioner`: conjugate gradients on a given set of contact points
- `half_space`: elastic response of solids, periodic or with free edges
- `convolution`: Fourier transforms, the only module that knows FFTW
- `subpixel`: areas finer than a pixel
- `richardson`: limit of fine grids, with an error
"""

from stickiness.repulsive.solver import Contact, ConvergenceError, load_path, solve

__all__ = ["Contact", "ConvergenceError", "load_path", "solve"]
