"""Figure 12: what remains on skewed heights, by every model beside full simulation."""

import numpy as np
from scipy import stats

from common.job import start
from stickiness import datasets
from stickiness.formatting import number
from stickiness.pages import plotting
from stickiness.pages.plotting import BLACK, BLUE, GREY, ORANGE, RED
from stickiness.remaining.trial_states import DEFAULT_SHARE

VARIABLES = ("height", "height_skewness", "theory", "bound", "states", "simulated")
HIGHEST = 6  # of the axes of heights, over h_rms


def main(job):
    compared = datasets.read(job.input.compared, VARIABLES)
    window = datasets.parameters(compared)["window"]
    ratios = {"height_ratios": [1, 2.4], "width_ratios": [1, 1, 1, 0.8] * 2}
    with plotting.open_figure(job.output, "AAAaBBBb;CCCCDDDD", 4.9, **ratios) as panels:
        for names, skewness, text in (("AaC", 1.5, "peaks"), ("BbD", -1.5, "worn")):
            surface = compared.sel(skewness=skewness)
            profile, distribution, shares = (panels[name] for name in names)
            profile.set_title(f"{text}, skewness {number(surface.height_skewness, 2)}")
            draw_profile(profile, surface.height, window)
            draw_distribution(distribution, surface.height)
            draw_shares(shares, surface)
            draw_change(shares, surface)
        panels["C"].legend(loc="upper left")


def draw_profile(ax, height, window):
    """Draw the profile whose skewness is closest to that of the map."""
    skewness = stats.skew(height, axis=1)
    typical = int(np.argmin(abs(skewness - stats.skew(height, axis=None))))
    profile = height.values[typical]
    x = window * np.arange(profile.size) / profile.size
    ax.fill_between(x, -HIGHEST, profile, color=GREY, alpha=0.35, linewidth=0)
    ax.plot(x, profile, color=BLACK, linewidth=0.9)
    ax.set(xlim=(0, window), ylim=(-HIGHEST, HIGHEST))
    ax.set(xlabel="position over longest wavelength", ylabel=r"height $h/h_\mathrm{rms}$")


def draw_distribution(ax, height):
    """Draw the density of the heights, along their axis, beside that of Gaussian heights."""
    density, edges = np.histogram(height, bins=60, density=True)
    ax.stairs(density, edges, orientation="horizontal", fill=True, color=GREY, alpha=0.6)
    gaussian = np.linspace(-HIGHEST, HIGHEST, 200)
    ax.plot(stats.norm.pdf(gaussian), gaussian, color=ORANGE)
    ax.set(ylim=(-HIGHEST, HIGHEST), xlim=(0, None), xlabel="density", xticks=[], yticklabels=[])


def draw_shares(ax, surface):
    """Draw the share that remains by every model against w/U_full, with limits."""
    x = surface.energy_ratio
    names = {"theory": "theory, Gaussian heights", "states": "states with adhesion"}
    for (name, text), colour in zip(names.items(), (ORANGE, BLUE), strict=True):
        low, value, high = surface[name].sel(limit=["low", "value", "high"])
        plotting.draw_band(ax, x, low, high, colour)
        label = f"{text} ({number(surface[f'seconds_{name}'].item(), 1)} s)"
        ax.plot(x, value, color=colour, linewidth=1.8, label=label)
    label = f"contact without adhesion ({number(surface.seconds_bound.item(), 1)} s)"
    ax.plot(x, surface.bound, "--", color=BLACK, label=label)
    seconds = surface.seconds_simulated.item() / surface.sizes["simulated_energy_ratio"]
    label = f"full simulation ({number(seconds, 1)} s a point)"
    ax.plot(
        surface.simulated_energy_ratio, surface.simulated, "o", color=RED, zorder=5, label=label
    )
    ax.axhline(DEFAULT_SHARE, color=GREY, linewidth=0.9, linestyle=":")
    ax.text(x[-1] / 1.05, DEFAULT_SHARE + 0.01, "sticks", color=GREY, fontsize=8, ha="right")
    ax.set(xscale="log", xlim=(x[0], x[-1]), ylim=(-0.01, 1))
    ax.set(xlabel=r"$w/U_\mathrm{full}$", ylabel="share of $w$ that remains")
    plotting.write_ticks(ax.xaxis, [0.1, 0.2, 0.5, 1, 2])


def draw_change(ax, surface):
    """Draw by how much the heights change the adhesion from which a pair sticks."""
    log_ratio = np.log(surface.energy_ratio)
    onset = {
        name: np.exp(np.interp(DEFAULT_SHARE, surface[name].sel(limit="value"), log_ratio))
        for name in ("theory", "states")
    }
    look = {"arrowstyle": "-|>", "color": BLACK, "shrinkA": 0, "shrinkB": 0}
    ends = {"xy": (onset["states"], DEFAULT_SHARE), "xytext": (onset["theory"], DEFAULT_SHARE)}
    ax.annotate("", **ends, arrowprops=look, zorder=6)
    text = rf"{number(onset['states'] / onset['theory'], 2)} $\times$ $w$"
    place = {"ha": "center", "va": "top", "fontsize": 8}
    ax.text(np.sqrt(onset["states"] * onset["theory"]), DEFAULT_SHARE - 0.015, text, **place)


if __name__ == "__main__":
    main(start(globals()))
