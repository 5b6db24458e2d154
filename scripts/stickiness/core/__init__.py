"""What every part shares.

- `arguments`: checks of arguments of public functions
- `plausibility`: warnings of numbers that are probably in another unit
- `units`: values with units as strings
- `compiled`: loops over grids, compiled at their first call
- `statistics`: intervals that cover 90 %
- `datasets`: NetCDF files between the stages
- `budget`: error budgets, source by source
"""
