"""Checks of the configuration before any job starts.

- `checks`: reads the files and checks them; errors name key, value and remedy
- `cross_checks`: what the schema of config.yaml cannot say
- `material_entries`: what the schema of materials cannot say
- `surface_entries`: what the schema of real surfaces cannot say
- `experiment_entries`: what the schema of experiments cannot say
- `measured_contact`: what the schema of contact of measured heights cannot say
- `files`: the files that a configuration names
- `measurements`: the files of a measured surface
- `messages`: the sentences of the errors
"""
