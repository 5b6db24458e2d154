"""Errors and costs of results, and the settings that an accuracy needs."""
