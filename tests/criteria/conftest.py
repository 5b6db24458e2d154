import pytest
from helpers.analysed import A_V

from criteria import verdicts


@pytest.fixture
def fixed_a_v(monkeypatch):
    """The same for all surfaces, because theory takes its time."""
    monkeypatch.setattr(verdicts, "find_a_v", lambda surface: (A_V, A_V))
