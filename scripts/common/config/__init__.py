"""The configuration: read, checked before any job starts, and documented.

- `load`: reads the files and checks them; errors name file, key, value and what would be right
- `fields`: what the models are made of: sections, numbers, values with units
- `models`, `campaigns`: models of config.yaml and of campaigns
- `materials`, `surfaces`, `experiments`: models of the files that config.yaml names
- `reference`: writes docs/configuration.md from the models
- `entries`: how scripts read entries
"""
