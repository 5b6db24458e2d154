"""Probes of every part of the library at the extremes of its parameters."""
