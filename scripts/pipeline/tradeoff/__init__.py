"""What accuracy costs: studies of every setting and the error models fitted to them."""
