"""Published experiments: read from the configuration, predicted, and held against criteria."""
