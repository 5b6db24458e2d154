"""The claims of the paper, recomputed: one decorated function a claim, in the file of its topic."""

from claims import adhesion_claims as adhesion
from claims import contact_claims as contact
from claims import criterion_claims as criterion
from claims import experiment_claims as experiments
from claims import remaining_claims as remaining
from claims.ledger import collect

CLAIMS = collect(adhesion, contact, criterion, experiments, remaining)
