"""What every part shares.

- `arguments`: checks of arguments of public functions
- `units`: values with units as strings
- `datasets`: NetCDF files between the stages
- `budget`: error budgets, source by source
"""
