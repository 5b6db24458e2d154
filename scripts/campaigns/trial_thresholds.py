"""Works of adhesion at which given shares remain, by states that were simulated on heights."""

import numpy as np
from scipy import optimize

SHARES = {"3": 0.03, "10": 0.1, "30": 0.3, "60": 0.6}  # by the ends of the names of columns
LOWEST = 1e-9  # adhesion lengths over the energy of full contact
HIGHEST = 1e3


def share_on(states, log_length, range_):
    """Share that remains in the deepest of the states."""
    return float(states.share(np.exp([log_length]), np.array([range_]))[0])


def find_log_threshold(states, share, range_):
    """Logarithm of the adhesion length at which a share remains; NaN if it does at any."""
    low, high = np.log([LOWEST, HIGHEST]) + np.log(states.full_contact_energy)

    def find_excess(log_length):
        return share_on(states, log_length, range_) - share

    return optimize.brentq(find_excess, low, high) if find_excess(low) < 0 else np.nan


def find_log_thresholds(states, range_):
    """Thresholds of all shares, by the ends of their columns."""
    return {ending: find_log_threshold(states, share, range_) for ending, share in SHARES.items()}


def describe_thresholds(name, where):
    """Texts of the columns of thresholds, by their names."""
    return {
        f"{name}_{ending}": f"ln of the adhesion length at which {share:.0%} remains {where}; none "
        "where so much remains at any"
        for ending, share in SHARES.items()
    }


def name_columns(name, found):
    """What was found at all shares, by columns whose names begin alike."""
    return {f"{name}_{ending}": number for ending, number in found.items()}
