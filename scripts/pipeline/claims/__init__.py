"""The claims of the paper, recomputed: one decorated function a claim, in the file of its topic."""

from pipeline.claims import adhesion, contact, criterion, experiments, remaining
from pipeline.claims.ledger import collect

CLAIMS = collect(adhesion, contact, criterion, experiments, remaining)
