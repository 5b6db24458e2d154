"""What every part shares: checks of arguments, units, datasets, error budgets."""
