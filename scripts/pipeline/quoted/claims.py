"""How the claims came out."""

from pipeline.claims.ledger import NOT, QUALIFIED, REPRODUCED
from pipeline.pages.report import count_grades, describe_claim
from pipeline.quoted.sources import Sources, say_count


def quote_grades(sources: Sources) -> dict[str, str]:
    claims = sources.read("claims/claims")
    grades = count_grades(claims)
    names = {"reproduced": REPRODUCED, "qualified": QUALIFIED, "not": NOT}
    failed = claims.claim[claims.verdict == NOT].values
    return {
        "claims.graded": str(claims.sizes["claim"]),
        "claims.failed": ", ".join(map(str, failed.tolist())),
    } | {f"claims.{name}": say_count(grades[grade]) for name, grade in names.items()}


def quote_threshold(sources: Sources) -> dict[str, str]:
    """Threshold of claim 5 as the report has it."""
    claims = sources.read("claims/claims")
    return {"threshold": describe_claim(claims.sel(claim=5))["measured"]}


NUMBERS = (quote_grades, quote_threshold)
