"""What the shape of the distribution of heights does to the adhesion that remains.

Broad tops hold more than the spectrum tells, sharp peaks less. Where heights cannot be simulated,
their skewness and kurtosis say by which factor the energy ratio w/U_full changes at which Gaussian
heights of the same spectrum would keep the same share.
"""
