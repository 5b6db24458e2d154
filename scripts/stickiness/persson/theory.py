"""Persson's theory of purely repulsive contact: area, mean gap and distribution of gaps.

The scale of resolution is measured by m, the profile variance of the gradient from q0 up to that
scale, M for the whole surface. With E* = 1 and p(m) = p/A(m) the area is A = erf(y), m = p^2 T(y).
The mean gap where the contact at m is in sight, and the gap where contact is lost on resolving m,
u1 = d(A ubar)/dA, are integrals from q(m) up that end with a jump of -1/q to zero at q1,

    ubar = (2/sqrt(pi)) int d(-1/q) s kappa(p(m)/s),
    u1   = (2/sqrt(pi)) int d(-1/q) F(p(m)/s) (s + a/(2 s)),   s^2 = m(q) - m,  a = -A/(dA/dm).

All terms are positive, and C(q), which shells do not have, drops out. T, F, kappa: see `kernels`.
"""

from __future__ import annotations

from copy import copy
from typing import Literal, get_args

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray
from scipy.special import erf, erfinv, xlogy

from stickiness.arguments import finite, nonnegative, number, positive
from stickiness.persson import gaps
from stickiness.persson.kernels import CorrectionName, kernels
from stickiness.persson.layered_scales import LayeredScales
from stickiness.persson.scale_quadrature import scale_nodes
from stickiness.plausibility import warn_of_pressure
from stickiness.solids import HALF_SPACE, Solid, check_solid
from stickiness.spectrum.interface import Spectrum, check_spectrum

ENERGY_GAMMA = 0.34  #: of "xu2024", which meets simulated energies best; areas want more
Variant = Literal["afferrante2018", "almqvist2011"]


class Persson:
    """Persson's contact theory for one surface spectrum.

    Parameters
    ----------
    spectrum : Spectrum
        Continuous, tabulated, or the shells of a periodic window. With a direction, its average
        over directions is used; quadrature errs by 1e-6 in the mean gap and 3e-5 in P(u) then.
        Simulated areas over theory's are larger than without a direction by 1, 10 and 17 % at
        ratios of 2, 4 and 8 at small loads.
    variant : {"afferrante2018", "almqvist2011"}
        Width of the Gaussians that P(u) is made of: the rms height h of the roughness that is not
        in sight yet (Almqvist et al. 2011, doi:10.1016/j.jmps.2011.08.004), or h_eff with
        h_eff^-2 = h^-2 + u1^-2 (Afferrante et al. 2018, doi:10.1007/s11249-018-1026-x).
    gamma : float, optional
        Parameter of the correction, in (0, 1]: by default the value of the source, 0.45, 5/9 and
        0.45. 1 switches "yang2008" and "xu2024" off.
    nodes : float
        Multiplies the number of quadrature nodes. 1 errs by less than 1e-9 in the area and the mean
        gap, 5e-7 in P(u) and its integral and 1e-10 in the normalisation, for magnifications from
        1.001 to 1e8; 0.5 by 1e-4 in P(u), 1.5 by 3e-8 and 2 by 1e-8. Next to full contact, in
        spectra broader than about 1e5, P(u) errs by 5e-6, its integral by 2e-7 of the open area. A
        few shells decades apart err by 1e-3 in P(u), 5e-5 in its integral with 1, by 1e-7 with 2.
    correction : {"yang2008", "wang2017", "xu2024"}
        How lost contact slows the diffusion of pressure and lowers the elastic energy:
        `kernels.Yang2008` (doi:10.1088/0953-8984/20/21/215214), `Wang2017` or `Xu2024`.
    solid : solids.HalfSpace, solids.Layer or solids.Skin, optional
        Elastic solid, a half-space by default. On a layer the area, the mean gap and the pressure
        at a mean gap are known, the distribution of gaps is not (NotImplementedError): see
        `layered_scales`.

    Notes
    -----
    Pressures are in units of E*, lengths in the spectrum's. Arrays of pressures and gaps are
    accepted; results have the shape ``p.shape + u.shape``.

    Examples
    --------
    >>> from stickiness.spectrum import SelfAffine
    >>> theory = Persson(SelfAffine(hurst=0.8, q0=1.0, q1=64.0, h_rms=1.0))
    >>> area = theory.area_fraction(0.065)
    >>> bool(abs(theory.gap_cumulative(1e9, 0.065) + area - 1) < 1e-8)
    True
    """

    def __init__(
        self,
        spectrum: Spectrum,
        variant: Variant = "afferrante2018",
        gamma: float | None = None,
        nodes: float = 1.0,
        correction: CorrectionName = "yang2008",
        solid: Solid = HALF_SPACE,
    ):
        check_spectrum(spectrum)
        _check_variant(variant)
        nodes = number("nodes", nodes)
        universal = kernels(gamma, correction)
        self.spectrum = spectrum = spectrum.averaged()
        self.variant = variant
        self.nodes = nodes
        self.correction = correction
        self.gamma = universal.correction.gamma
        self.solid = check_solid(solid)
        self._layered = None
        if solid != HALF_SPACE:
            self._layered = LayeredScales(spectrum, solid, nodes)
        m2 = self._variance_below(spectrum.q1)
        self._setting = gaps.Setting(spectrum, universal, scale_nodes(spectrum, nodes), m2, nodes)

    def with_variant(self, variant: Variant) -> Persson:
        """Return the same theory with another width of the Gaussians.

        What they share is computed once, also later on; ValueError if there is no such variant.
        """
        _check_variant(variant)
        other = copy(self)
        other.variant = variant
        return other

    def area_fraction(self, p: ArrayLike, magnification: float | None = None) -> NDArray:
        """Relative contact area A/A_nom at mean pressures `p` >= 0 over E*, of their shape.

        `magnification`: resolution zeta' >= 1 (q up to zeta' q0) at which the area is seen, the
        finest by default. With a direction, q0 is the wave number of the longest of all waves.
        """
        (p,) = nonnegative(p=finite(p=p)[0])
        warn_of_pressure(float(np.max(p, initial=0.0)), float(np.sqrt(2 * self._setting.m2)))
        m = self._setting.m2
        if magnification is not None:
            if np.ndim(magnification) or not magnification >= 1:
                raise ValueError(
                    f"magnification must be a number of at least 1, got {magnification!r}"
                )
            m = self._variance_below(magnification * self.spectrum.q0)
        if m == 0:  # no wave is seen
            return np.where(p > 0, 1.0, 0.0)[()]
        y = self._setting.kernels.invert_area_scale(m / np.where(p > 0, p, 1.0) ** 2)
        return np.where(p > 0, erf(y), 0.0)[()]

    def pressure_at_area(self, area_fraction: ArrayLike) -> NDArray:
        """Mean pressure over E* at relative contact areas between 0 and 1 (1e-11 at least)."""
        (area,) = positive(area_fraction=area_fraction)
        return np.sqrt(self._setting.m2 / self._setting.kernels.area_scale(erfinv(area)))[()]

    def mean_gap(self, p: ArrayLike) -> NDArray:
        """Mean gap ubar [length] at mean pressure `p` > 0 (array of the shape of `p`).

        Persson 2007 (doi:10.1103/PhysRevLett.99.125502), corrected as in Yang & Persson 2008. Its
        integral over `p` is the elastic energy of full contact.
        """
        (p,) = positive(p=p)
        if self._layered is not None:
            return self._layered.mean_gap(p, self._setting.kernels)
        below, _, weight = self._setting.scales.fine
        s = np.sqrt(below)
        x2 = (p[..., None] / s) ** 2
        kernel = s * np.exp(-x2) * self._setting.kernels.mean_kernel(x2)
        return 2 / np.sqrt(np.pi) * np.sum(weight * kernel, axis=-1)

    def elastic_energy(self, p: ArrayLike) -> NDArray:
        """Elastic energy per nominal area over E* [length] at mean pressures `p` >= 0.

        The integral of A S dm/(2 q), A of the theory without a correction (Yang & Persson 2008).
        Whatever the correction of this theory, S is that of "xu2024" with `ENERGY_GAMMA`: within
        5 % (rms) of simulations at loads from 0.01 E* q0 h_rms on (H = 0.5 to 0.9), where
        "yang2008" with 0.45 is 9 % too high. With S the theory's, it is the integral of -p d(ubar).
        """
        (p,) = nonnegative(p=p)
        universal = kernels(ENERGY_GAMMA, "xu2024")
        if self._layered is not None:
            return self._layered.elastic_energy(p, universal)
        m, _, weight = self._setting.scales.fine
        return 0.5 * np.sum(weight * m * universal.energy_kept(p[..., None], m)[1], axis=-1)

    def elastic_energy_error(self, p: ArrayLike) -> NDArray:
        """Relative error of `elastic_energy`, on half-spaces.

        It covers 90 % of the simulations of H = 0.3 to 0.9, magnifications of 4 to 32 and loads of
        0.01 to 5 E* q0 h_rms in cells of four longest waves and, from 0.1 on, of two. At loads
        above 1 what is left to full contact falls so steeply that a cell may have none of it or
        twice as much.
        """
        share = self.elastic_energy(p) / self.spectrum.elastic_energy(self.solid)
        left = np.maximum(1 - share, 0.0)
        steepness = left - 1.25 * xlogy(left, left)
        return 0.13 * steepness * np.maximum(1.0, np.sqrt(0.02 / share))

    def pressure_at(self, mean_gap: ArrayLike) -> NDArray:
        """Mean pressure over E* at which the mean gap is `mean_gap` > 0 [length].

        ValueError if the gap is so large or so small that the pressure leaves the range of floats.
        """
        (target,) = positive(mean_gap=mean_gap)
        return np.vectorize(self._pressure_at, otypes=[float])(target)[()]

    def gap_density(self, u: ArrayLike, p: ArrayLike) -> NDArray:
        """Density P(u) [1/length] of gaps over the nominal area; its integral is 1 - A/A_nom.

        Parameters
        ----------
        u : array_like
            Gaps [length], u >= 0. P(0) is infinite in the variant of 2018, where P grows as
            1/(u ln^2 u) towards zero.
        p : array_like
            Mean pressure over E*.
        """
        density = self._over_gaps(u, p, gaps.density)
        if self.variant == "afferrante2018":
            density = np.where(np.asarray(u) == 0, np.inf, density)[()]
        return density

    def gap_cumulative(self, u: ArrayLike, p: ArrayLike) -> NDArray:
        """Share of the nominal area with gaps between 0 and `u`, the contact not included.

        The integral of P from 0 to `u`, in closed form under the integral over scales. Also the
        relative attractive area of a traction that acts up to `u`. Arguments as of `gap_density`.
        """
        return self._over_gaps(u, p, gaps.cumulative)

    def _variance_below(self, q: float) -> float:
        """Twice the variance of the pressure in full contact of the waves up to `q` [E*]."""
        if self._layered is not None:
            return self._layered.variance_below(q)
        return 0.5 * float(self.spectrum.variance_below(q, 2))

    def _pressure_at(self, target: float) -> float:
        def excess(log_p: float) -> float:
            return float(np.log(np.maximum(self.mean_gap(np.exp(log_p)), 1e-300) / target))

        root_m2 = np.sqrt(self._setting.m2)
        lowest = -300.0
        highest = float(np.log(24 * root_m2))
        if excess(lowest) < 0 or excess(highest) > 0:
            raise ValueError(
                f"mean_gap must lie between {self.mean_gap(np.exp(highest)):.3g} (full contact to "
                f"rounding) and {self.mean_gap(np.exp(lowest)):.3g}, got {target!r}"
            )
        # A bracket about the pressure at which the gap decays as exp(-2 u/h_rms).
        near = float(np.clip(np.log(root_m2) - 2 * target / self.spectrum.h_rms, -299, None))
        low = near
        high = near
        while excess(low) < 0:
            low = max(low - 2.0, lowest)
        while excess(high) > 0:
            high = min(high + 0.5, highest)
        return float(np.exp(scipy.optimize.brentq(excess, low, high, xtol=1e-13, rtol=1e-13)))

    def _over_gaps(self, u: ArrayLike, p: ArrayLike, function) -> NDArray:
        if self._layered is not None:
            raise NotImplementedError(
                "the distribution of gaps is known for a half-space only: on a layer take "
                "area_fraction, mean_gap and pressure_at, or the gaps of repulsive.solve"
            )
        (p,) = positive(p=p)
        (u,) = nonnegative(u=u)
        largest = float(np.max(u[np.isfinite(u)], initial=0.0)) / self.spectrum.h_rms
        # Gaps up to 10 h_rms, 0.6 of the least reach, are always resolved. Reaches double, so that
        # profiles are shared between calls; the tail P ~ 1/(u ln u)^2 beyond 1024 means nothing.
        doublings = max(0.0, np.ceil(np.log2(max(largest, 1.0) / (0.6 * 17.0))))
        reach = min(17.0 * 2**doublings, 1024.0)
        rows = []
        for load in map(float, p.ravel()):
            profile = gaps.gap_profile(self._setting, self.variant, load, reach)
            rows.append(gaps.over_blocks(function, u.ravel(), profile))
        return np.reshape(rows, p.shape + u.shape)[()]


def _check_variant(variant: str) -> None:
    if variant not in get_args(Variant):
        raise ValueError(f"variant must be one of {get_args(Variant)}, got {variant!r}")
