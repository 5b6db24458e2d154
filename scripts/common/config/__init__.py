"""The configuration: read, checked before any job starts, and documented, by models of pydantic."""
