"""Checks of the configuration before any job starts.

- `checks`: reads the files and checks them; errors name key, value and remedy
- `cross_checks`: what the schema of config.yaml cannot say
- `surface_entries`: what the schemas of materials and real surfaces cannot say
- `messages`: the sentences of the errors
"""
