"""Checks of the configuration before any job starts."""
