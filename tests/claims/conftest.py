import pytest
from helpers.claim_files import files_by_name


@pytest.fixture
def files():
    return files_by_name()
