from functools import cache

import pytest
from helpers.claim_files import files_by_name

from claims import criterion_claims

# Searched for once for all tests of a process.
criterion_claims.find_limits = cache(criterion_claims.find_limits)


@pytest.fixture
def files():
    return files_by_name()
