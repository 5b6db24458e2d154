"""What results err by and what they cost, and the settings that an accuracy needs."""
